"""The command ``hull1620``.  The module of a subcommand is imported only when that subcommand is called.

How to add a command:

1. ``modern/cli/NAME.py``: define ``main(args)``, which returns the exit code (``OK``, ``DIFFERS`` or ``BAD_INPUT`` of
   ``modern/cli/shared/console.py``) and raises ``UsageError`` for options that are invalid or cannot be combined.  A
   hyphen in the command's name becomes an underscore in the module's name.
2. ``modern/cli/arguments.py``: write a function that adds the arguments, and an entry in ``COMMANDS`` with the line for
   ``--help``.  Import nothing there that only a run needs.
3. ``modern/cli/shared/``: put code here that two or more commands use.  No command imports another command.
4. Give an argument that names a file the type ``InputFile``, ``OutputFile`` or ``Folder`` of
   ``modern/cli/shared/console.py``.  ``check_outputs`` then rejects, before the command runs, an output that cannot be
   written or is also an input.  Print the report of the command with ``print_report``, which uses standard error if
   the data go to standard output.  ``NAMES`` in ``modern/cli/shared/arguments.py`` lists the names of examples that the
   shell completes.
5. ``tests/modern/cli/``: test the exit codes and messages.  The page ``docs/reference/commands.md`` is made from the
   help texts and needs no change.
"""

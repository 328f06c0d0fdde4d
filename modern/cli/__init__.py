"""The command ``hull1620``.  Each subcommand's module is imported only when it is called."""

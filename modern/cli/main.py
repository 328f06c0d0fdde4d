"""The one place where a command is called and where errors become an exit code (modern/cli/exits.py)."""

from __future__ import annotations

import contextlib
import importlib
import os
import sys
from collections.abc import Sequence

from modern.cli.arguments import build_parser
from modern.cli.exits import BAD_INPUT, OK


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit code."""
    args = build_parser().parse_args(arguments)
    if sys.stdout is None:
        _complain("standard output is closed")
        return BAD_INPUT
    try:
        command = importlib.import_module(args.module)
        code: int = command.main(args)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        # The reader of a pipe has gone: not an error of ours, and nothing more can be said to it.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OK
    except KeyboardInterrupt:
        _complain("interrupted")
        return 130
    except MemoryError:
        _complain("there is not enough memory for this")
        return BAD_INPUT
    except OSError as error:
        # What cannot be opened is said where it is known by name; this is an output that fails in mid-writing.
        _complain(f"cannot write: {(error.strerror or str(error)).lower()}")
        return BAD_INPUT
    except Exception as error:
        from emulator.errors import EmulatorError
        from modern.edition.apparatus import ApparatusError

        if isinstance(error, EmulatorError | ApparatusError):
            _complain(str(error))
            return BAD_INPUT
        raise


def _complain(message: str) -> None:
    """One line on standard error, whatever a file's name holds; nothing where there is no standard error."""
    if sys.stderr is not None:
        shown = "".join(c if c.isprintable() else repr(c)[1:-1] for c in message)
        with contextlib.suppress(OSError, ValueError):
            print(f"hull1620: {shown}", file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())

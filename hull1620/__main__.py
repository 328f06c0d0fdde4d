"""``hull1620`` and ``python -m hull1620``: the command.

Until it can end properly, Ctrl-C ends the process without a word.
"""

import signal
import sys

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)

from modern.cli.main import main

if __name__ == "__main__":
    sys.exit(main())

"""The command ``hull1620``, also ``python -m hull1620``.

Ctrl-C ends the process without a traceback even while the modules of the command are being imported.
"""

import atexit
import gc
import signal
import sys

if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)

from modern.cli.main import main

# Python searches for garbage when it exits, unless the objects are frozen; this would take a tenth of a second.
atexit.register(gc.freeze)

if __name__ == "__main__":
    sys.exit(main())

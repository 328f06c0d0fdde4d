"""``python -m hull1620`` is the command ``hull1620``."""

import sys

from modern.cli.main import main

sys.exit(main())

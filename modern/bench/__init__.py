"""Benchmarks of the emulator's engines, compared with each other and with the same program in modern Fortran.

All measurements use one thread, like the programs that are compared. numpy's linear algebra library would start a
second thread, whose busy waiting would count as processor time.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

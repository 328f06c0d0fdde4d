"""Speed of the engines beside each other and beside the same program through a Fortran compiler of today.

Everything is measured with one thread, as the peers have one: numpy's library of linear algebra would else begin a
second, which waits busily, and whose waiting would be counted in the seconds of the processor.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

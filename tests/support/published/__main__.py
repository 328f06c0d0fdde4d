"""Write the published vectors into a folder."""

import sys
from pathlib import Path

from tests.support.published.made import OPERATIONS, counts

if __name__ == "__main__":
    folder = Path(sys.argv[1])
    for operation in OPERATIONS:
        (folder / f"{operation.name}.vectors").write_text(operation.file(), encoding="ascii", newline="\n")
    (folder / "counts.tsv").write_text(counts(), encoding="ascii", newline="\n")

"""Tables as text: columns aligned for a terminal, and CSV."""

import csv
import io
from collections.abc import Iterable, Iterator, Sequence


def aligned(rows: Iterable[Sequence[str]], right: Sequence[bool] | bool = False) -> Iterator[str]:
    """Yield the rows as lines with aligned columns. Columns for which ``right`` is true are aligned to the right."""
    cells = list(rows)
    columns = range(len(cells[0]) if cells else 0)
    widths = [max(len(row[k]) for row in cells) for k in columns]
    to_right = [right] * len(widths) if isinstance(right, bool) else right
    for row in cells:
        yield "  ".join(
            text.rjust(width) if is_right else text.ljust(width)
            for text, width, is_right in zip(row, widths, to_right, strict=True)
        ).rstrip()


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    """Return the rows as CSV text, each ended by a line feed."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()

"""``hull1620 flowchart``: where a program goes, as a picture in the symbols of 1963 or as a table."""

from __future__ import annotations

import argparse

from emulator.files import write_text
from modern.cli.shared.console import OK, UsageError
from modern.cli.shared.machine import layers_of, load_program
from modern.formats.columns import aligned
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.flow import flow


def main(args: argparse.Namespace) -> int:
    """Draw the chart, or print its table."""
    found = flow(load_program(args.program, layers_of(args), args.upcase))
    if args.table:
        rows = (("from", "taken for", "to"), *found.table())
        write_text(args.output, "".join(f"{line}\n" for line in aligned(rows)))
        return OK
    drawn = chart(found)
    if args.page is not None and not 1 <= args.page <= len(drawn.pages):
        raise UsageError(f"--page {args.page}: the chart has pages 1 to {len(drawn.pages)}")
    write_text(args.output, chart_svg(drawn, args.page))
    return OK

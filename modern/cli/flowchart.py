"""``hull1620 flowchart``: draw the flow of control of a program in the symbols of 1963, or print it as a table."""

import argparse

from emulator.files import write_text
from modern.cli.shared.console import OK, UsageError
from modern.cli.shared.programs import load_program
from modern.formats.columns import aligned
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.flow import flow


def main(args: argparse.Namespace) -> int:
    control_flow = flow(load_program(args))
    if args.table:
        rows = (("from", "taken for", "to"), *control_flow.table())
        write_text(args.output, "".join(f"{line}\n" for line in aligned(rows)))
        return OK
    drawn = chart(control_flow)
    if args.page is not None and not 1 <= args.page <= len(drawn.pages):
        raise UsageError(f"--page: expected 1 to {len(drawn.pages)}, found {args.page}")
    write_text(args.output, chart_svg(drawn, args.page))
    return OK

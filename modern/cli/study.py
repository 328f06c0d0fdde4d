"""``hull1620 study``: run a study of many samples, from the plan to the table, the plots and the conclusions."""

import argparse
import inspect
import os
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

from emulator.errors import quoted
from modern.cli.shared.console import BAD_INPUT, OK, print_error


def main(args: argparse.Namespace) -> int:
    # Imported here because these modules take long to import and --help does not need them.
    from modern.study.builtin import names, study
    from modern.study.families import FAMILIES, given
    from modern.study.measures import MEASURES
    from modern.study.plan import SEED, PlanError
    from modern.study.report import terminal_text
    from modern.study.run import cut_lines, run_study
    from modern.study.tomlplan import read_plan

    if args.list:
        for name in names():
            built_in = study(name)
            plan = built_in.plan(built_in.SAMPLES, SEED)
            print(f"{name:<14} {built_in.TITLE}")
            print(
                f"{'':<14} --samples {built_in.SAMPLES} (default): {plan.samples:,} samples in {len(plan.cells)} cells"
            )
        return OK
    if args.families or args.measures:
        families = {**FAMILIES, "file": given.file_family}
        listed = [*(families.items() if args.families else ()), *(MEASURES.items() if args.measures else ())]
        print("\n".join(described(name, function) for name, function in listed))
        return OK
    if args.redraw is not None:
        return redrawn(Path(args.redraw))
    if args.verify is not None:
        return verified(Path(args.verify))
    if args.name is None:
        raise PlanError(
            f"expected a study or a plan file NAME.toml; the studies are {', '.join(names())} (--list describes them)"
        )
    for name, value in (("--samples", args.samples), ("--workers", args.workers)):
        if value is not None and value < 1:
            raise PlanError(f"{name}: expected at least 1, found {value}")
    for name, value in (("--out", args.out), ("--dask", args.dask)):
        if value == "":
            raise PlanError(f"{name}: expected a value, found an empty string")
    if args.resume and args.out and not os.path.exists(args.out):
        raise PlanError(f"--resume: the folder {args.out} does not exist")
    if args.workers is not None and args.dask:
        raise PlanError("--workers and --dask cannot be combined; choose one")
    options = {
        "workers": args.workers or 0,
        "dask": args.dask or "",
        "resume": args.resume,
        "quiet": args.quiet,
        "command": ("hull1620", *sys.argv[1:]),
    }
    try:
        if args.name.endswith(".toml"):
            plan = read_plan(args.name, args.samples, args.seed)
            for line in () if args.quiet else cut_lines(plan):
                print(line, file=sys.stderr)
            report = run_study(plan, args.out or plan.name, **options)
        else:
            try:
                built_in = study(args.name)
            except KeyError:
                raise PlanError(
                    f"unknown study {quoted(args.name)}; expected a plan file NAME.toml or one of {', '.join(names())}"
                ) from None
            plan = built_in.plan(args.samples or built_in.SAMPLES, SEED if args.seed is None else args.seed)
            report = run_study(plan, args.out or plan.name, built_in.report, **options)
    except KeyboardInterrupt:
        print("hull1620: interrupted; finished work is kept, --resume continues the study", file=sys.stderr)
        return 130
    print(terminal_text(report), end="")
    return OK


def described(name: str, function: Callable[..., object]) -> str:
    """Describe a family or measure: its name, its parameters with their defaults, and its docstring."""
    parameters = [
        p.name if p.default is p.empty else f"{p.name} = {p.default!r}"
        for p in inspect.signature(function).parameters.values()
        if p.name not in ("draw", "sample", "run")
    ]
    summary = " ".join((inspect.getdoc(function) or "").replace("``", "").split())
    return "\n".join(
        (f"{name:<14} {', '.join(parameters)}".rstrip(), textwrap.indent(textwrap.fill(summary, 76), "    "))
    )


def redrawn(folder: Path) -> int:
    """Draw the plots of a finished study again, from its charts.json, and return the exit code."""
    from modern.study.chartfile import read_charts
    from modern.study.plots import draw

    for chart in read_charts(folder):
        draw(chart, folder)
        print(f"{folder / chart.name}.svg, .png")
    return OK


def verified(folder: Path) -> int:
    """Compare the rows of a study with their checksums, report each damaged file, and return the exit code."""
    from modern.study.run import verify_study

    plan, intact, messages = verify_study(folder)
    for message in messages:
        print_error(message)
    print(f"{folder}: {intact:,} of {plan.samples:,} rows are present and match their checksums")
    return BAD_INPUT if messages else OK

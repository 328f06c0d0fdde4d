"""``hull1620 study``: a study of many samples, from plan to table, plot and words."""

from __future__ import annotations

import argparse
import sys

from modern.cli.shared.console import OK


def arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument("name", metavar="NAME", nargs="?", help="a study built in, or a plan file NAME.toml")
    parser.add_argument("--list", action="store_true", help="list the studies built in")
    parser.add_argument("--samples", metavar="N", type=int, help="samples (--list: the sets they make)")
    parser.add_argument("--seed", metavar="S", type=int, help="the seed of all samples (default: 1963)")
    parser.add_argument("--workers", metavar="W", type=int, help="processes (default: one a processor)")
    parser.add_argument(
        "--dask", metavar="ADDRESS", help="the scheduler of a dask.distributed cluster, for its workers"
    )
    parser.add_argument("--out", metavar="DIR", help="the study's folder (default: its name)")
    parser.add_argument("--resume", action="store_true", help="go on with the study begun in the folder")
    parser.add_argument("--quiet", action="store_true", help="no progress")


def main(args: argparse.Namespace) -> int:
    """Carry out the study named, or list those there are."""
    # Here, so that its --help need not wait for all that studies import.
    from modern.study.plan import SEED, PlanError
    from modern.study.registry import entries, names, study
    from modern.study.report import spoken
    from modern.study.run import run_study
    from modern.study.tomlplan import is_plan_file, read_plan

    if args.list:
        for entry in entries():
            print(f"{entry.name:<14} {entry.title}")
            print(f"{'':<14} --samples {entry.samples} (default): sets {entry.sets:,}, cells {entry.cells}")
        return OK
    if args.name is None:
        raise PlanError(f"which study? There are {', '.join(names())}, or a plan file; --list says what they are")
    for name, value in (("--samples", args.samples), ("--workers", args.workers)):
        if value is not None and value < 1:
            raise PlanError(f"{name}: {value} is less than 1")
    for name, value in (("--out", args.out), ("--dask", args.dask)):
        if value == "":
            raise PlanError(f"{name} is empty")
    if args.workers is not None and args.dask:
        raise PlanError("--workers and --dask are one or the other")
    options = {
        "workers": args.workers or 0,
        "dask": args.dask or "",
        "resume": args.resume,
        "quiet": args.quiet,
        "command": ("hull1620", *sys.argv[1:]),
    }
    try:
        if is_plan_file(args.name):
            plan = read_plan(args.name, args.samples, args.seed)
            report = run_study(plan, args.out or plan.name, **options)
        else:
            try:
                found = study(args.name)
            except KeyError:
                raise PlanError(
                    f"no study is called {args.name!r}; there are {', '.join(names())}, or a plan file NAME.toml"
                ) from None
            plan = found.plan(args.samples or found.SAMPLES, SEED if args.seed is None else args.seed)
            report = run_study(plan, args.out or plan.name, found.report, **options)
    except KeyboardInterrupt:
        print("hull1620: interrupted; what is done is kept, --resume goes on", file=sys.stderr)
        return 130
    print(spoken(report), end="")
    return OK

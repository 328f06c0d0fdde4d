"""``hull1620 tei``: the edition's texts as TEI P5, their validation, and the way back from a document to its decks."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from xml.etree.ElementTree import Element

from emulator.files import read_bytes, read_text, write_text
from modern.claims.apparatus_checks import texts
from modern.cli.shared.console import DIFFERS, OK, UsageError
from modern.publication import tei_reading as reading
from modern.publication.tei import schema, tei


def main(args: argparse.Namespace) -> int:
    """Write a text, or all; validate them; or read a document back."""
    asked = {"--layers": args.layers is not None, "--witness": args.witness, "--part": args.part is not None}
    for option, given in asked.items():
        if given and not args.read:
            raise UsageError(f"{option} goes with --read")
    if sum(asked.values()) > 1:
        raise UsageError("--layers, --witness and --part are three things to read: choose one")
    if args.text is not None and (args.all or args.schema or args.read):
        raise UsageError(f"{args.text}: no text is named with --all, --schema or --read")
    if args.text is not None and args.text not in texts():
        raise UsageError(f"there is no text {args.text!r}; there are {', '.join(texts())}")
    if args.schema:
        write_text(args.output, schema())
    elif args.read:
        write_text(args.output, _read(args))
    elif args.check is not None:
        return _check(args)
    elif args.all:
        _write_all(Path(args.all))
    elif args.text is None:
        raise UsageError(f"name a text, or a folder with --all; there are {', '.join(texts())}")
    else:
        write_text(args.output, tei(args.text, _version()))
    return OK


def _version() -> str:
    try:
        return version("hull1620")
    except PackageNotFoundError:
        return "(not installed)"


def _write_all(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"{folder}: {(error.strerror or str(error)).lower()}") from None
    for name in texts():
        write_text(str(folder / f"{name}.xml"), tei(name, _version()))


def _read(args: argparse.Namespace) -> str:
    root = reading.parsed(args.read, read_text(args.read))
    try:
        if args.part is not None:
            return reading.part(root, args.part)
        if args.witness:
            return reading.witness(root)
        return reading.corrected(root, None if args.layers is None else _layers(root, args.layers))
    except reading.TeiError as error:
        raise UsageError(f"{args.read}: {error}") from None


def _layers(root: Element, given: str) -> tuple[str, ...]:
    wanted = tuple(name for name in given.split(",") if name)
    strange = [name for name in wanted if name not in reading.layers(root)]
    if strange:
        raise reading.TeiError(f"there is no layer {strange[0]!r}; there are {', '.join(reading.layers(root))}")
    return wanted


def _check(args: argparse.Namespace) -> int:
    try:
        from lxml import etree
    except ImportError:
        raise UsageError("validating needs lxml: pip install 'hull1620[edition]'") from None
    source = args.check or "the project's own schema"
    try:
        relax = etree.RelaxNG(etree.fromstring(read_bytes(args.check) if args.check else schema().encode()))
    except (etree.XMLSyntaxError, etree.RelaxNGParseError) as error:
        raise UsageError(f"{source}: no RELAX NG schema: {error}") from None
    wrong = 0
    for name in (args.text,) if args.text else texts():
        found = next(_faults(relax, etree.fromstring(tei(name, _version()).encode())), "")
        wrong += bool(found)
        print(f"{name}: {found or 'valid'}")
    return DIFFERS if wrong else OK


def _faults(relax: object, document: object) -> Iterator[str]:
    if not relax.validate(document):  # type: ignore[attr-defined]
        for fault in relax.error_log:  # type: ignore[attr-defined]
            yield f"line {fault.line}: {fault.message}"

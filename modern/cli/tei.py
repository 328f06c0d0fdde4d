"""``hull1620 tei``: write the edition's texts as TEI P5, validate them, or read decks back from a document."""

import argparse
from xml.etree.ElementTree import Element

from emulator.errors import quoted
from emulator.files import read_bytes, read_text, write_text
from modern.cli.shared.console import DIFFERS, OK, UsageError, version, write_folder
from modern.publication import tei_reading as reading
from modern.publication.tei import archive, documents, tei
from modern.publication.tei_schema import odd, schema


def main(args: argparse.Namespace) -> int:
    choices = {"--layers": args.layers is not None, "--witness": args.witness, "--part": args.part is not None}
    chosen = [option for option, is_chosen in choices.items() if is_chosen]
    if chosen and not args.read:
        raise UsageError(f"{chosen[0]} needs --read FILE.xml")
    if len(chosen) > 1:
        raise UsageError(f"{' and '.join(chosen)} cannot be combined; choose one")
    if args.text is not None and (args.all or args.schema or args.read):
        raise UsageError(f"{args.text}: --all, --schema and --read do not accept a text")
    if args.text is not None and args.text not in documents():
        raise UsageError(f"unknown text {quoted(args.text)}; expected one of {', '.join(documents())}")
    if args.schema:
        write_text(args.output, schema())
    elif args.read:
        write_text(args.output, _read(args))
    elif args.check is not None:
        return _check(args)
    elif args.all:
        write_folder(args.all, archive(version()))
    elif args.text is None:
        raise UsageError(f"expected a text, or --all with a folder; the texts are {', '.join(documents())}")
    else:
        write_text(args.output, tei(args.text, version()))
    return OK


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


def _layers(root: Element, names: str) -> tuple[str, ...]:
    layers = tuple(name for name in names.split(",") if name)
    unknown = [name for name in layers if name not in reading.layers(root)]
    if unknown:
        raise reading.TeiError(f"unknown layer {quoted(unknown[0])}; expected one of {', '.join(reading.layers(root))}")
    return layers


def _check(args: argparse.Namespace) -> int:
    try:
        from lxml import etree
    except ImportError:
        raise UsageError("validation needs lxml; install it with pip install 'hull1620[edition]'") from None
    source = args.check or "the project's own schema"
    try:
        relax = etree.RelaxNG(etree.fromstring(read_bytes(args.check) if args.check else schema().encode()))
    except (etree.XMLSyntaxError, etree.RelaxNGParseError) as error:
        raise UsageError(f"{source}: not a RELAX NG schema: {error}") from None
    all_valid = True
    files = {name: tei(name, version()) for name in ((args.text,) if args.text else documents())}
    if args.check and not args.text:
        files["hull1620.odd"] = odd()  # valid by the schema of the full TEI, not by the project's own schema
    for name, text in files.items():
        is_valid = relax.validate(etree.fromstring(text.encode()))
        all_valid = all_valid and is_valid
        print(f"{name}: valid" if is_valid else f"{name}: line {relax.error_log[0].line}: {relax.error_log[0].message}")
    return OK if all_valid else DIFFERS

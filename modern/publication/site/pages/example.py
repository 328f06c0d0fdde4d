"""A printed example: verdicts, hull, construction and time, and the printed cards next to OCR text and our run."""

from collections.abc import Iterator

from emulator.machine.endings import Ending
from modern.drawing.draw import draw_svg
from modern.drawing.punched import cards_svg
from modern.drawing.stages import frames, strip
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.edition.programs import program
from modern.edition.reproduce import Report
from modern.formats.points import parse_input
from modern.geometry.mesh import ExportError
from modern.port import convex_hull
from modern.publication.examples import TITLES, VERDICTS, Part, Shown, Source, example, homes, rest
from modern.publication.measured import runs
from modern.publication.site.entries import column, entry, sign, witness_line
from modern.publication.site.made import Made, Target, one_of
from modern.publication.site.made import Part as Section
from modern.publication.site.markup import definitions, details, element, escape, figure, link, marked, table, text

STATES = {"examples": "program 1 in the state that ran the examples", "listing": "program 1 as listed"}


def make(argument: str) -> Made:
    """Return the example of that number; for ``rest``, the rows of chapter 6 that belong to no example."""
    if one_of(argument, ("rest", *map(str, EXAMPLES))) == "rest":
        section = Section(
            "Rows that concern no card", "rest", html="".join(entry(row, (), "examples") for row in rest())
        )
        return Made((section,), tuple(_target(row.id) for row in rest()))
    number = int(argument)
    parts = example(number)
    sections = [Section("Verdict", "verdict", html=_verdicts(parts)), *_pictures(number)]
    targets: list[Target] = []
    for part in parts:
        sections.append(Section(part.title, part.id, html=_part(part)))
        targets.append(Target(part.id, f"example {number} {part.id}", f"example {number}, {part.title.lower()}"))
        targets += [_target(row.id) for row in part.rows if homes()[row.id] == (number, part.id)]
    sections.append(Section("Time on the 1620", "time", html=_time(number)))
    return Made(tuple(sections), tuple(targets))


def _target(row: str) -> Target:
    return Target(row, row, row, f"rows of the apparatus; {row}")


def _verdicts(parts: tuple[Part, ...]) -> str:
    rows = []
    for part in parts:
        if part.reports:
            name = text("a", f"program {part.program}, {TITLES[part.device]}", href=f"#{part.id}")
            rows.append((name, *map(_verdict, part.reports)))
    head = ("printed or stated result", *(STATES[state] for state in sorted(STATES)))
    command = text("code", f"hull1620 reproduce {parts[0].example} --show")
    return table(head, rows, name="Verdicts") + element("p", f"To reproduce this comparison: {command}.")


def _verdict(report: Report) -> str:
    verdict = report.verdict
    result = VERDICTS.get(verdict.kind, verdict.kind)
    counts = f"{verdict.cards} cards, {verdict.numbers} numbers" if report.device == "punch" else "stated, not printed"
    ending = report.ending
    failure = "" if isinstance(ending, Ending) and ending.normal else "; the run did not end normally"
    return f"{text('strong', result + failure)} {text('span', f'({counts})', cls='quiet')}"


def _pictures(number: int) -> Iterator[Section]:
    deck = input_deck(number)
    points = parse_input(deck.text(), f"example{number}").points
    hull = convex_hull(points, "exact", history=True, on_refusal="return")
    caption = "The hull in exact arithmetic. The programs punch the same hull."
    drawn = figure(draw_svg(hull, width=520), f"hull{number}", caption)
    punched = figure(cards_svg(deck, title=f"the input deck of example {number}"), f"deck{number}", "", "punched")
    summary = f"The {len(deck.cards)} cards of the input deck as punched cards"
    yield Section("The hull", "hull", html=drawn + details(summary, punched))
    try:
        stages = frames(hull)
    except ExportError:
        return
    steps = "".join(text("li", "; ".join(filter(None, stage.caption))) for stage in stages)
    caption = "The hulls H1 to Hf, each with the vertex that was added, all from the same direction."
    construction = figure(strip(stages), f"stages{number}", caption) + element("ol", steps, cls="steps")
    yield Section("The construction", "construction", html=construction)


def _part(part: Part) -> str:
    head = ("witness", "corrected print", *(("run",) if part.reports else ()))
    html = text("p", "The thesis describes these lines but does not print them.") if part.stated else ""
    top = element("div", "".join(text("span", name) for name in head), cls="print-head", aria_hidden="true")
    cards = element("ol", "".join(_card(card, part) for card in part.cards), cls="print-cards")
    html += element("div", top + cards, cls=f"print columns-{len(head)}")
    if part.rows:
        shown_here = [row for row in part.rows if homes()[row.id] == (part.example, part.id)]
        rows = "".join(entry(row, (), f"example{part.example}") for row in shown_here)
        shown_elsewhere = [link(f"example{homes()[r.id][0]}", r.id, r.id) for r in part.rows if r not in shown_here]
        if shown_elsewhere:
            rows += element("p", f"And {', '.join(shown_elsewhere)}, which also concern other cards.")
        summary = f"{len(part.rows)} rows of the apparatus correct the OCR text of these cards"
        html += details(summary, rows, cls="rows-of-print")
    return html


def _card(card: Shown, part: Part) -> str:
    note = f"line {', '.join(card.continued)} continued" if card.continued else "" if card.print else "blank"
    witness = "".join(map(_source, card.sources)) or text("span", note, cls="quiet")
    cells = column("Witness", witness) + column("Print", text("code", card.print or " "), "corrected")
    if card.run is not None:
        comparison = sign("\u2260", "differs") if card.differs else sign("=", "the same")
        cells += column("Run", comparison + element("code", marked(card.run or " ", card.differs, "ins")))
    return element("li", cells, id=f"{part.id}-{card.number}")


def _source(source: Source) -> str:
    spans = source.changed if "\t" not in source.text else ()
    code = element("code", marked(source.text.replace("\t", "  "), spans, "del"))
    return witness_line(source.page, source.line, source.at, code)


def _time(number: int) -> str:
    rows = []
    for name in ("program1_examples", "program2", "program3"):
        for run in runs(name):
            if run.example == number:
                times = (f"{run.statements:,}", _seconds(run.seconds), _seconds(run.total))
                rows.append((link(name, "", program(name).source), *times))
    head = ("program", "statements", "processor", "with reader, punch and typewriter, without overlap")
    accuracy = (("how sure", "within ten per cent if IBM states the times; the other times are estimates"),)
    return table(head, rows, name="Time on a 1620 Model 1") + definitions(accuracy, cls="facts")


def _seconds(seconds: float) -> str:
    return escape(f"{seconds:.1f} s" if seconds < 120 else f"{seconds / 60:.1f} min")

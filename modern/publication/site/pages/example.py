"""The page of a printed example: the verdicts on its results, its hull, the construction, the time, and the printed
cards.

Each printed card stands next to the OCR text and the card of our run.
"""

import re
from collections.abc import Iterator

from emulator.machine.endings import Ending
from modern.drawing.draw import Show, draw_svg
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
from modern.publication.site.entries import entry
from modern.publication.site.made import Part as Section
from modern.publication.site.made import one_of
from modern.publication.site.markup import (
    definitions,
    details,
    element,
    escape,
    figure,
    link,
    marked,
    run_link,
    table,
    text,
)

_EXPONENT = re.compile(r"E[+-]\d\d")
STATES = {"examples": "program 1 in the state that ran the examples", "listing": "program 1 as listed"}


def make(argument: str) -> list[Section]:
    """Return the page of an example by its number, or the rows of chapter 6 that belong to no example (``rest``)."""
    if one_of(argument, ("rest", *map(str, EXAMPLES))) == "rest":
        rows = "".join(entry(row, (), "examples") for row in rest())
        return [Section("Rows that concern no card", "rest", html=rows)]
    number = int(argument)
    parts = example(number)
    return [
        Section("Verdict", "verdict", html=_verdicts(parts)),
        *_pictures(number),
        *(Section(part.title, part.id, html=_part(part)) for part in parts),
        Section("Time on the 1620", "time", html=_time(number)),
    ]


def _verdicts(parts: tuple[Part, ...]) -> str:
    rows = []
    for part in parts:
        if part.reports:
            name = text("a", f"program {part.program}, {TITLES[part.device]}", href=f"#{part.id}")
            rows.append((name, *map(_verdict, part.reports)))
    head = ("printed or stated result", *(STATES[state] for state in sorted(STATES)))
    command = text("code", f"hull1620 reproduce {parts[0].example} --show")
    run = run_link("program1_examples", f"example{parts[0].example}", "Run it in the emulator", next="1") + "."
    return table(head, rows, name="Verdicts") + element("p", f"To reproduce this comparison: {command}. {run}")


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
    drawn = figure(draw_svg(hull, width=520, show=Show("input")), f"hull{number}", caption)
    punched = figure(
        cards_svg(deck, title=f"the input deck of example {number}"),
        f"deck{number}",
        "Each hole is a digit or a sign of the input deck.",
        "punched",
    )
    summary = f"The {len(deck.cards)} cards of the input deck as punched cards"
    yield Section("The hull", "hull", html=drawn + details(summary, punched))
    try:
        stages = frames(hull)
    except ExportError:
        return
    steps = "".join(text("li", "; ".join(filter(None, stage.caption))) for stage in stages)
    last = stages[-1].stage.number
    caption = f"The hulls H1 to H{last}, each with the vertex that was added, all from the same direction."
    construction = figure(strip(stages), f"stages{number}", caption, "drawing construction")
    construction += element("ol", steps, cls="stages")
    yield Section("The construction", "construction", html=construction)


def _part(part: Part) -> str:
    if not part.cards:
        return text("p", "According to the thesis, the program types nothing in this run.")
    html = text("p", "The thesis describes these lines but does not print them.") if part.stated else ""
    html += element("ol", "".join(_card(card, part) for card in part.cards), cls="print-cards")
    if part.rows:
        shown_here = [row for row in part.rows if homes()[row.id] == (part.example, part.id)]
        rows = "".join(entry(row, (), f"example{part.example}") for row in shown_here)
        shown_elsewhere = [link(f"example{homes()[r.id][0]}", r.id, r.id) for r in part.rows if r not in shown_here]
        if shown_elsewhere:
            verb = "concerns" if len(shown_elsewhere) == 1 else "concern"
            rows += element("p", f"And {', '.join(shown_elsewhere)}, which also {verb} other cards.")
        count = "1 row corrects" if len(part.rows) == 1 else f"{len(part.rows)} rows correct"
        summary = f"Apparatus: {count} the OCR text of these cards"
        html += details(summary, rows, cls="rows-of-print")
    return html


def _card(card: Shown, part: Part) -> str:
    """Return the lines of a card: the witness, the corrected print and the run. Equal lines are shown only once."""
    is_same_run = card.run is not None and not card.differs
    label = "stated" if part.stated else "print"
    label += " = run" if is_same_run else ""
    if len(card.sources) == 1 and card.sources[0].text == card.print and not card.continued:
        lines = _line("corrected", f"{card.sources[0].line} = {label}", _fields(card.print), _place(card.sources[0]))
    else:
        lines = "".join(
            _line("witness", f"witness {source.line}", _witness(source), _place(source)) for source in card.sources
        )
        lines += _line("corrected", label, _fields(card.print) if card.print else text("span", "blank", cls="quiet"))
        lines += text("p", f"line {', '.join(card.continued)} continued", cls="quiet") if card.continued else ""
    if card.run is not None and card.differs:
        lines += _line("run", "run \u2260", element("code", marked(card.run or " ", card.differs, "ins")))
    return element("li", lines, id=f"{part.id}-{card.number}")


def _line(cls: str, label: str, inner: str, place: str = "") -> str:
    return element("div", text("span", label, cls="line", title=place) + inner, cls=cls)


def _place(source: Source) -> str:
    return f"p. {source.page}, line {source.line} of the witness, {source.at} of the thesis's OCR text"


def _fields(card: str) -> str:
    """Return a card as code in which lines break after a number if the window is narrow."""
    return element("code", _EXPONENT.sub(r"\g<0><wbr>", escape(card)))


def _witness(source: Source) -> str:
    spans = source.changed if "\t" not in source.text else ()
    return element("code", marked(source.text.replace("\t", "  "), spans, "del"))


def _time(number: int) -> str:
    rows = []
    for name in ("program1_examples", "program2", "program3"):
        for run in runs(name):
            if run.example == number:
                times = (str(time).replace(") ", ")\N{NO-BREAK SPACE}") for time in (run.processor, run.total))
                rows.append((link(name, "", program(name).source), f"{run.statements:,}", *times))
    whole = "with reader, punch and typewriter, without overlap"
    head = ("program", "statements", "processor", whole)
    accuracy = (("how sure", "in parentheses: bounds by the ratios to runs on IBM's library of 1962"),)
    return table(head, rows, name="Time on a 1620 Model 1") + definitions(accuracy, cls="facts")

"""The flow charts of the programs, drawn from the compiled control flow, with a table of all transitions."""

from modern.edition import programs
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.facing import facing
from modern.publication.flow import Box, Flow, flow
from modern.publication.site.made import Part, one_of
from modern.publication.site.markup import address, details, element, escape, inline, link, table, text

_ORIGIN = "Drawn from the compiled program. The charts of the thesis are lost."


def make(argument: str) -> list[Part]:
    """Return the flow chart of a built-in program, one figure for each sheet, and a table of its transitions."""
    name = one_of(argument, programs.NAMES)
    control_flow = flow(programs.program(name))
    drawn = chart(control_flow)
    parts: list[Part] = []
    for page, sheet in enumerate(drawn.pages, 1):
        picture = chart_svg(drawn, page, lambda box: address(name, _place(name, box)))
        svg = inline(picture, f"{name}-{page}", "flow", 125)
        first, last = (control_flow.boxes[sheet.boxes[n].box] for n in (0, -1))
        caption = f"Sheet {page} of {len(drawn.pages)}: from {first.name} to {last.name}. {_ORIGIN}"
        html = element("figure", svg + text("figcaption", caption), cls="chart")
        parts.append(Part(f"Sheet {page}", f"sheet-{page}", html=html))
    parts.append(Part("Table of transitions", "ways", html=_transitions(name, control_flow)))
    return parts


def _place(name: str, box: Box) -> str:
    return facing(name).cards[box.cards[0] - 1].place


def _transitions(name: str, control_flow: Flow) -> str:
    def to(box: Box) -> str:
        return link(name, _place(name, box), _place(name, box))

    rows = [
        (to(box), escape(way.taken.replace("-", "\u2212") or "next"), to(control_flow.boxes[way.target]))
        for box in control_flow.boxes
        for way in box.exits
    ]
    transitions = table(("from", "condition", "to"), rows, "Transitions between boxes")
    return details(f"{len(rows)} transitions between boxes", transitions)

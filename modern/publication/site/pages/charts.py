"""The flow charts of the programs, made from the compiled control flow, with a table of every way as text."""

from __future__ import annotations

from modern.edition import programs
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.facing import facing
from modern.publication.flow import Box, Flow, flow
from modern.publication.site.made import Made, Part, Target, one_of
from modern.publication.site.markup import address, element, escape, link, table, text
from modern.publication.site.pictures import inline

_OURS = "Ours, made from the compiled program; the thesis's own charts are lost."


def make(argument: str) -> Made:
    """The flow chart of a built-in program, a figure a page, and its ways as a table."""
    name = one_of(argument, programs.NAMES)
    found = flow(programs.program(name))
    drawn = chart(found)
    parts: list[Part] = []
    for page in range(1, len(drawn.pages) + 1):
        svg = inline(
            chart_svg(drawn, page, lambda box: address(name, _place(name, box))), f"{name}-{page}", "flow", 125
        )
        first, last = (found.boxes[drawn.pages[page - 1].boxes[at].box] for at in (0, -1))
        words = f"Sheet {page} of {len(drawn.pages)}: from {first.name} to {last.name}. {_OURS}"
        html = element("figure", svg + text("figcaption", words), cls="chart")
        parts.append(Part(f"Sheet {page}", f"sheet-{page}", html=html))
    parts.append(Part("Every way as a table", "ways", html=_ways(name, found)))
    targets = [
        Target(f"sheet-{page}", f"chart {name} {page}", f"flow chart of {name}, sheet {page}")
        for page in range(1, len(drawn.pages) + 1)
    ]
    return Made(tuple(parts), tuple(targets))


def _place(name: str, box: Box) -> str:
    return facing(name).cards[box.cards[0] - 1].place


def _ways(name: str, found: Flow) -> str:
    def to(box: Box) -> str:
        return link(name, _place(name, box), _place(name, box))

    rows = [
        (to(box), escape(way.taken.replace("-", "\u2212") or "next"), to(found.boxes[way.target]))
        for box in found.boxes
        for way in box.exits
    ]
    return element(
        "details",
        text("summary", f"{len(rows)} ways from box to box")
        + table(("from", "taken for", "to"), rows, "Ways from box to box"),
    )

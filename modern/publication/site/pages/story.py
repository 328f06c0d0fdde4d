"""The figures of the home page's essay: a punched card, the growing hull, a plane with a rounding error, and the cube.

Every figure is complete without JavaScript. The script ``story.js`` shows the stages one at a time and moves the
slider.
"""

import json

from modern.drawing.draw import draw_svg
from modern.drawing.stages import row, strip
from modern.publication import essay
from modern.publication.site.made import Part, one_of
from modern.publication.site.markup import element, figure, inline, link, preformatted, run_link, table, text

EYE = (1, 1, 2)  # the hull of the example is broad from this direction
XS = range(5, 1000, 5)  # the positions of the slider


def make(argument: str) -> list[Part]:
    """Return a figure of the essay: ``hulls``, ``card``, ``growth``, ``truncation`` or ``cube``."""
    makers = {"hulls": _hulls, "card": _card, "growth": _growth, "truncation": _truncation, "cube": _cube}
    return [Part(html=makers[one_of(argument, makers)]())]


def _hulls() -> str:
    """Return the successive hulls of the example in one row, as the picture at the top of the page."""
    stages = essay.growth(EYE, width=240)
    caption = f"The hull of {_example()} grows: program 3 adds one point in each step."
    return element("figure", inline(row(stages, "four successive hulls"), "hulls") + element("figcaption", caption))


def _example() -> str:
    return link(f"example{essay.EXAMPLE}", "", f"example {essay.EXAMPLE}")


def _card() -> str:
    return figure(essay.card(), "card", f"The first point of example {essay.EXAMPLE} on a punched card.", "punched")


def _growth() -> str:
    stages = essay.growth(EYE, width=480)
    items = "".join(element("li", inline(strip([stage]), f"stage{stage.stage.number}")) for stage in stages)
    caption = f"The hull of {_example()}, in the order of program 3."
    return element("figure", element("ol", items, cls="stepper") + element("figcaption", caption))


def _truncation() -> str:
    rows = [(x, *essay.plane_row(x)) for x in XS]
    shown = [[text("span", str(cell)) for cell in row] for row in rows if row[0] in essay.XS]
    summary = element(
        "p", "Value of the plane at its own three points, of which every one should be zero:", cls="quiet"
    )
    html = summary + table(("x of the first point", *essay.HEAD), shown, "A plane's values at its own points")
    caption = f"{essay.plane_caption()} All values are exact until an intermediate result of D needs more than eight \
digits. The digits dropped there make D too small or too large, and the plane misses its own points."
    box = element("div", html, cls="slider", data_rows=json.dumps(rows))
    return element("figure", box + text("figcaption", caption))


def _cube() -> str:
    run, typed, hull = essay.cube()
    statements = sum(step.result.statements for step in run.steps)
    caption = f"The unit cube. After {statements:,} statements the typewriter of the 1620 has typed:"
    run_it = run_link("program1", "counterexamples/cube", "Run the cube on the machine", next="1")
    why = f"Why: {link('known-faults', 'fault-2', 'known fault 2')}. {run_it}."
    drawn = figure(draw_svg(hull, width=360), "cube", caption)
    return drawn + preformatted(typed, "typewriter") + element("p", why, cls="quiet")

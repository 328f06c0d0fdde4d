"""How the programs use the machine: storage maps to scale, and what 1620 time is made of, each with its table."""

from __future__ import annotations

from collections.abc import Iterator

from emulator.machine.timing import ARITHMETIC, CONTROL, CONVERSION, FIXED, SUBSCRIPTS
from modern.drawing import svg
from modern.drawing.layout import Pixel
from modern.edition.programs import NAMES as PROGRAMS
from modern.edition.programs import program
from modern.publication import core
from modern.publication.core import ARRAY, CORE, CoreMap, Region, core_map
from modern.publication.measured import Run, runs
from modern.publication.site.made import Made, Part, one_of
from modern.publication.site.markup import element, escape, link, table, text
from modern.publication.site.pictures import figure

PER_PIXEL = 50
"""Positions of core to a pixel of the map."""
_LEFT, _WIDE = 42, 104
_TOP, _FOOT = 8, 8
_FONT = f'font-family="{svg.FONT}" font-size="9.5" fill="#000"'
_GREYS = {
    core.SYSTEM: "#b4b4b4",
    core.PROGRAM: "#dcdcdc",
    core.FREE: "#fff",
    core.ARRAY: "#f0f0f0",
    core.SINGLE: "#c8c8c8",
    core.NAMES: "#555",
}
_LINE, _TWO_LINES = 9, 26
"""Pixels of height from which a region has its name within, and from which its size below the name."""

PARTS = {
    "floating point": (ARITHMETIC,),
    "subscripts": (SUBSCRIPTS,),
    "fixed point and control": (FIXED, CONTROL),
    "number conversion": (CONVERSION,),
    "card reader": ("card reader",),
    "card punch": ("card punch",),
    "typewriter": ("typewriter",),
}
"""The parts of a bar, and the causes of the time table they are made of."""
_FILLS = ("#222", "#666", "#999", "#ddd", "url(#rising)", "url(#upright)", "url(#level)")
_PATTERNS = (
    "<defs>"
    '<pattern id="rising" width="5" height="5" patternUnits="userSpaceOnUse"><rect width="5" height="5" fill="#fff"/>'
    '<path d="M-1 1L1-1M0 5L5 0M4 6L6 4" stroke="#000" stroke-width="0.9"/></pattern>'
    '<pattern id="upright" width="4" height="4" patternUnits="userSpaceOnUse"><rect width="4" height="4" fill="#fff"/>'
    '<path d="M2 0V4" stroke="#000" stroke-width="0.9"/></pattern>'
    '<pattern id="level" width="4" height="4" patternUnits="userSpaceOnUse"><rect width="4" height="4" fill="#fff"/>'
    '<path d="M0 2H4" stroke="#000" stroke-width="0.9"/></pattern>'
    "</defs>"
)
_WIDTH, _ROOM = 360, 330
"""Of the picture of times, and of its longest bar."""
_STEP, _BAR = 37, 15
_WORDS = f'font-family="{svg.FONT}" font-size="11" fill="#000"'


def make(argument: str) -> Made:
    """``storage``: the maps and their tables; ``time``: bars of every run of a printed example, and their table."""
    return Made(_storage() if one_of(argument, ("storage", "time")) == "storage" else _time())


def _storage() -> tuple[Part, ...]:
    maps = [core_map(name) for name in PROGRAMS]
    pictures = "".join(
        figure(map_svg(found), f"core-{found.program}", link(found.program, "", _title(found)), words=_told(found))
        for found in maps
    )
    return (
        Part(html=element("div", pictures, cls="maps")),
        Part(html=_sizes(maps)),
        Part(html="".join(map(_addresses, maps))),
    )


def _title(found: CoreMap) -> str:
    words = program(found.program).source.removesuffix(".f").replace("program", "program ")
    return words.replace("_examples", ", as in the examples")


def _told(found: CoreMap) -> str:
    regions = (f"{_named(region)} {region.low:,} to {region.high:,}" for region in found.regions)
    return f"From address 0 up: {'; '.join(regions)}."


def _named(region: Region) -> str:
    return f"array {region.name}" if region.kind == ARRAY else region.kind


def _count(region: Region) -> str:
    return f"{'~' if region.estimated else ''}{region.positions:,}"


def map_svg(found: CoreMap) -> str:
    """A storage map as the text of an SVG file: address 0 below, a pixel to 50 positions.

    A region is a rectangle that says in ``data-low`` and ``data-positions`` what it is.
    """
    height = CORE // PER_PIXEL

    def y(address: int) -> int:
        """The hundredth of a pixel where a position begins."""
        return 100 * (_TOP + height) - address * 100 // PER_PIXEL

    def boxes() -> Iterator[str]:
        for region in found.regions:
            top, tall = svg.number(y(region.high + 1)), svg.number(region.positions * 100 // PER_PIXEL)
            more = f'data-low="{region.low}" data-positions="{region.positions}" fill="{_GREYS[region.kind]}"'
            title = f"<title>{svg.escape(f'{_named(region)}: {region.low:,} to {region.high:,}')}</title>"
            yield f'<rect x="{_LEFT}" y="{top}" width="{_WIDE}" height="{tall}" {more}>{title}</rect>'

    def words() -> Iterator[str]:
        for region in found.regions:
            tall = region.positions // PER_PIXEL
            middle = (y(region.low) + y(region.high + 1)) // 2
            x = 100 * (_LEFT + _WIDE // 2)
            if tall >= _TWO_LINES:
                yield svg.text(Pixel(x, middle - 200), region.name or region.kind)
                yield svg.text(Pixel(x, middle + 1000), _count(region))
            elif tall >= _LINE:
                yield svg.text(Pixel(x, middle + 330), region.name or f"{region.kind} {_count(region)}")

    def addresses() -> Iterator[str]:
        last = 10**9
        for address in _marks(found):
            at = y(address)
            if last - at >= 1000:
                yield svg.text(Pixel(100 * _LEFT - 400, at + (-50 if not address else 330)), f"{address:,}")
                last = at

    items = [
        *svg.group("regions", 'stroke="#000" stroke-width="0.6"', boxes()),
        *svg.group("words", f'{_FONT} text-anchor="middle"', words()),
        *svg.group("addresses", f'{_FONT} text-anchor="end"', addresses()),
    ]
    return svg.page(_LEFT + _WIDE + 4, _TOP + height + _FOOT, f"Storage of {_title(found)}, to scale", items)


def _marks(found: CoreMap) -> Iterator[int]:
    """The addresses said beside the map: where what is no array begins, and the end of core."""
    seen = ""
    for region in found.regions:
        if region.kind in (core.SYSTEM, core.PROGRAM, core.FREE) or seen == core.FREE:
            yield region.low
        seen = region.kind
    yield CORE


def _sizes(maps: list[CoreMap]) -> str:
    rows = []
    for kind in (core.SYSTEM, core.PROGRAM, core.FREE, core.ARRAY, core.SINGLE, core.NAMES):
        mark = "~" if kind in (core.PROGRAM, core.FREE) else ""
        name = f"{kind}s" if kind == ARRAY else kind
        rows.append((escape(name), *(f"{mark}{found.positions(kind):,}" for found in maps)))
    rows.append(("together", *(f"{sum(region.positions for region in found.regions):,}" for found in maps)))
    for size, _ in maps[0].points:
        cells = (dict(found.points)[size] for found in maps)
        rows.append((f"points that fit {size:,}", *(f"~{points}" if points else "does not fit" for points in cells)))
    caption = "Positions of core; ~ estimated"
    return table(("what", *map(_title, maps)), rows, "Storage of the programs", caption)


def _addresses(found: CoreMap) -> str:
    """Every region of the data as a table, to be opened."""
    rows = []
    for region in reversed(found.regions):
        fields = ", ".join(_fields(kind, count) for kind, count in region.fields)
        rows.append((escape(_named(region)), fields, f"{region.high:,}", f"{region.low:,}", _count(region)))
    inner = table(("what", "fields", "from", "down to", "positions"), rows, f"Addresses of {_title(found)}")
    again = element("p", "The same with every variable: " + text("code", f"hull1620 map {found.program}"))
    return element("details", text("summary", f"Addresses of {_title(found)}") + inner + again)


def _fields(kind: str, count: int) -> str:
    plural = {"temporary": "temporaries"}.get(kind, f"{kind}s")
    return f"{count} {plural if count != 1 else kind}"


def example_runs() -> list[Run]:
    """The runs of the printed examples, by example and program, in the state that produced them."""
    names = [name for name in PROGRAMS if name != "program1"]
    return sorted((run for name in names for run in runs(name)), key=lambda run: (run.example, run.program))


def seconds_of(run: Run) -> tuple[float, ...]:
    """The seconds of each of :data:`PARTS`."""
    return tuple(sum(row.seconds for row in run.rows if row.cause in causes) for causes in PARTS.values())


def _time() -> tuple[Part, ...]:
    found = example_runs()
    longest = max(found, key=lambda run: run.total)
    caption = (
        "What the time of each run is made of, one part after the other from left to right in the order of the key; "
        "all bars have one scale."
    )
    words = (
        f"Bars of {len(found)} runs; the longest is example {longest.example}, {_called(longest)}: "
        f"{longest.total:.0f} seconds. The figures are in the table."
    )
    rows = []
    for run in found:
        name = link(f"example{run.example}", "time", f"example {run.example}, {_called(run)}", cls="whole")
        rows.append((name, *(f"{part:.1f}" for part in seconds_of(run)), f"{run.total:.1f}"))
    drawn = figure(time_svg(found), "time", caption, "drawing bars", words)
    return (
        Part(
            html=drawn + table(("run", *PARTS, "all"), rows, "What 1620 time is made of", "Seconds on a 1620 Model 1")
        ),
    )


def _called(run: Run) -> str:
    return f"program {program(run.program).source.removeprefix('program')[0]}"


def time_svg(found: list[Run]) -> str:
    """Stacked bars of runs, on one scale, as the text of an SVG file; ``data-seconds`` of a part says how long."""
    longest = max(run.total for run in found)
    key = 4 * 17 + 14

    def bars() -> Iterator[str]:
        for place, run in enumerate(found):
            x, y = 100 * (_WIDTH - _ROOM) // 2, 100 * (key + place * _STEP + 16)
            for name, fill, seconds in zip(PARTS, _FILLS, seconds_of(run), strict=True):
                wide = round(100 * _ROOM * seconds / longest)
                if wide:
                    size = f'x="{svg.number(x)}" y="{svg.number(y)}" width="{svg.number(wide)}" height="{_BAR}"'
                    title = f"<title>{name}: {seconds:.1f} s</title>"
                    yield f'<rect {size} fill="{fill}" data-seconds="{seconds:.3f}">{title}</rect>'
                x += wide

    def names() -> Iterator[str]:
        for place, run in enumerate(found):
            at = Pixel(100 * (_WIDTH - _ROOM) // 2, 100 * (key + place * _STEP + 11))
            yield svg.text(at, f"example {run.example}, {_called(run)}: {run.total:.0f} s")

    def samples() -> Iterator[str]:
        for place, (name, fill) in enumerate(zip(PARTS, _FILLS, strict=True)):
            x, y = (_WIDTH - _ROOM) // 2 + place // 4 * 175, 6 + place % 4 * 17
            yield f'<rect x="{x}" y="{y}" width="20" height="11" fill="{fill}" stroke="#000" stroke-width="0.6"/>'
            yield svg.text(Pixel(100 * (x + 26), 100 * (y + 10)), name)

    items = [
        _PATTERNS,
        *svg.group("key", _WORDS, samples()),
        *svg.group("names", _WORDS, names()),
        *svg.group("parts", 'stroke="#000" stroke-width="0.6"', bars()),
    ]
    return svg.page(_WIDTH, key + len(found) * _STEP, "What 1620 time is made of", items)

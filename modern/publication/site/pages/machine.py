"""The storage maps, and the division of running times by component, drawn to scale, each with a table."""

from collections.abc import Iterator

from emulator.machine.timing import ARITHMETIC, CONTROL, CONVERSION, FIXED, SUBSCRIPTS, Time
from modern.drawing import svg
from modern.drawing.layout import Pixel
from modern.edition.programs import NAMES as PROGRAMS
from modern.edition.programs import program
from modern.publication import core
from modern.publication.core import ARRAY, CORE, CoreMap, Region, core_map
from modern.publication.measured import Run, runs
from modern.publication.site.made import Part, one_of
from modern.publication.site.markup import details, element, escape, figure, link, table, text

PER_PIXEL = 50  # positions of core storage for each pixel of the map
_LEFT, _WIDE = 42, 104
_TOP, _FOOT = 8, 8
_FONT = f'font-family="{svg.FONT}" font-size="9.5" fill="#000"'
_GREYS = dict(zip(core.KINDS, ("#b4b4b4", "#dcdcdc", "#fff", "#f0f0f0", "#c8c8c8", "#555"), strict=True))
# The least height in pixels of a region that shows its name, and of one that shows name and size on two lines.
_LINE, _TWO_LINES = 9, 26

# The parts of a bar. Each part adds up the times of the named causes in the time table.
PARTS = {
    "floating point": (ARITHMETIC,),
    "subscripts": (SUBSCRIPTS,),
    "fixed point and control": (FIXED, CONTROL),
    "number conversion": (CONVERSION,),
    "card reader": ("card reader",),
    "card punch": ("card punch",),
    "typewriter": ("typewriter",),
}
_FILLS = ("#222", "#666", "#999", "#ddd", "url(#rising)", "url(#upright)", "url(#level)")
_HATCHINGS = (("rising", 5, "M-1 1L1-1M0 5L5 0M4 6L6 4"), ("upright", 4, "M2 0V4"), ("level", 4, "M0 2H4"))
_PATTERNS = "".join(
    f'<pattern id="{id}" width="{side}" height="{side}" patternUnits="userSpaceOnUse">'
    f'<rect width="{side}" height="{side}" fill="#fff"/><path d="{path}" stroke="#000" stroke-width="0.9"/></pattern>'
    for id, side, path in _HATCHINGS
)
# The widths of the picture of times and of its longest bar in pixels.
_WIDTH, _BAR_WIDTH = 360, 330
_STEP, _BAR = 37, 15
_TEXT = f'font-family="{svg.FONT}" font-size="11" fill="#000"'


def make(argument: str) -> list[Part]:
    """Return ``storage``, the storage maps with tables, or ``time``, the times of the printed examples with a table."""
    return _storage() if one_of(argument, ("storage", "time")) == "storage" else _time()


def _storage() -> list[Part]:
    maps = [core_map(name) for name in PROGRAMS]
    pictures = ""
    for storage in maps:
        caption = link(storage.program, "", _title(storage))
        pictures += figure(map_svg(storage), f"core-{storage.program}", caption, description=_description(storage))
    sections = (element("div", pictures, cls="maps"), _sizes(maps), "".join(map(_addresses, maps)))
    return [Part(html=html) for html in sections]


def _title(storage: CoreMap) -> str:
    title = program(storage.program).source.removesuffix(".f").replace("program", "program ")
    return title.replace("_examples", ", state of the examples")


def _description(storage: CoreMap) -> str:
    regions = (f"{_region_name(region)} {region.low:,} to {region.high:,}" for region in storage.regions)
    return f"From address 0 up: {'; '.join(regions)}."


def _region_name(region: Region) -> str:
    return f"array {region.name}" if region.kind == ARRAY else region.kind


def _count(region: Region) -> str:
    return f"{'~' if region.estimated else ''}{region.positions:,}"


def map_svg(storage: CoreMap) -> str:
    """Draw a storage map as SVG, with address 0 at the bottom.

    The attributes ``data-low`` and ``data-positions`` of a rectangle are its lowest address and its number of
    positions.
    """
    height = CORE // PER_PIXEL

    def y(address: int) -> int:
        """Return the vertical coordinate of an address in hundredths of a pixel."""
        return 100 * (_TOP + height) - address * 100 // PER_PIXEL

    def boxes() -> Iterator[str]:
        for region in storage.regions:
            top, tall = svg.number(y(region.high + 1)), svg.number(region.positions * 100 // PER_PIXEL)
            attributes = f'data-low="{region.low}" data-positions="{region.positions}" fill="{_GREYS[region.kind]}"'
            title = f"<title>{svg.escape(f'{_region_name(region)}: {region.low:,} to {region.high:,}')}</title>"
            yield f'<rect x="{_LEFT}" y="{top}" width="{_WIDE}" height="{tall}" {attributes}>{title}</rect>'

    def names() -> Iterator[str]:
        for region in storage.regions:
            tall = region.positions // PER_PIXEL
            middle = (y(region.low) + y(region.high + 1)) // 2
            x = 100 * (_LEFT + _WIDE // 2)
            if tall >= _TWO_LINES:
                yield svg.text(Pixel(x, middle - 200), region.name or region.kind)
                yield svg.text(Pixel(x, middle + 1000), _count(region))
            elif tall >= _LINE:
                # In a box that is hardly higher than the text, smaller letters keep clear of its lines.
                size = 'font-size="8.7"' if tall < 13 else ""
                yield svg.text(Pixel(x, middle + 300), region.name or f"{region.kind} {_count(region)}", size)

    def addresses() -> Iterator[str]:
        last = 10**9
        for address in _labelled_addresses(storage):
            at = y(address)
            # Labels that are closer than ten pixels would overlap.
            if last - at >= 1000:
                yield svg.text(Pixel(100 * _LEFT - 400, at + (-50 if not address else 330)), f"{address:,}")
                last = at

    items = [
        *svg.group("regions", 'stroke="#000" stroke-width="0.6"', boxes()),
        *svg.group("words", f'{_FONT} text-anchor="middle"', names()),
        *svg.group("addresses", f'{_FONT} text-anchor="end"', addresses()),
    ]
    return svg.page(_LEFT + _WIDE + 4, _TOP + height + _FOOT, f"Storage of {_title(storage)}, to scale", items)


def _labelled_addresses(storage: CoreMap) -> Iterator[int]:
    """Yield the addresses printed next to the map: the starts of code, free storage and data, and the end of core."""
    previous = ""
    for region in storage.regions:
        if region.kind in (core.SYSTEM, core.PROGRAM, core.FREE) or previous == core.FREE:
            yield region.low
        previous = region.kind
    yield CORE


def _sizes(maps: list[CoreMap]) -> str:
    rows = []
    for kind in core.KINDS:
        estimate_sign = "~" if kind in (core.PROGRAM, core.FREE) else ""
        name = f"{kind}s" if kind == ARRAY else kind
        rows.append((escape(name), *(f"{estimate_sign}{storage.positions(kind):,}" for storage in maps)))
    rows.append(("total", *(f"{sum(region.positions for region in storage.regions):,}" for storage in maps)))
    for size, _ in maps[0].points:
        most = (dict(storage.points)[size] for storage in maps)
        cells = (f"~{points}" if points else "does not fit" for points in most)
        rows.append((f"points that fit into {size:,}", *cells))
    caption = "Positions of core storage; ~ means estimated"
    return table(("region", *map(_title, maps)), rows, "Storage of the programs", caption)


def _addresses(storage: CoreMap) -> str:
    rows = []
    for region in reversed(storage.regions):
        plurals = ((count, {"temporary": "temporaries"}.get(kind, f"{kind}s"), kind) for kind, count in region.fields)
        fields = ", ".join(f"{count} {plural if count != 1 else kind}" for count, plural, kind in plurals)
        rows.append((escape(_region_name(region)), fields, f"{region.high:,}", f"{region.low:,}", _count(region)))
    inner = table(("region", "fields", "from", "down to", "positions"), rows, f"Addresses of {_title(storage)}")
    command = element("p", "A map with every variable: " + text("code", f"hull1620 map {storage.program}"))
    return details(f"Addresses of {_title(storage)}", inner + command)


def example_runs() -> list[Run]:
    """Return the runs by example and program. Program 1 is in the state of the printed examples."""
    names = [name for name in PROGRAMS if name != "program1"]
    return sorted((run for name in names for run in runs(name)), key=lambda run: (run.example, run.program))


def times_of(run: Run) -> tuple[Time, ...]:
    """Return the time of a run for each part of a bar (:data:`PARTS`)."""
    return tuple(sum((row.time for row in run.rows if row.cause in causes), Time()) for causes in PARTS.values())


_CAPTION = "Time on a 1620 Model 1; in parentheses: the systematic error of the processor's times"


def _time() -> list[Part]:
    all_runs = example_runs()
    longest = max(all_runs, key=lambda run: run.total.seconds)
    caption = (
        "The time of each run by component, from left to right in the order of the key. All bars have the same scale."
    )
    description = (
        f"Bars of {len(all_runs)} runs; the longest is example {longest.example}, {_called(longest)}: "
        f"{longest.total}. The table has the figures."
    )
    rows = []
    for run in all_runs:
        name = link(f"example{run.example}", "time", f"example {run.example}, {_called(run)}", cls="whole")
        rows.append((name, *map(str, times_of(run)), str(run.total)))
    drawn = figure(time_svg(all_runs), "time", caption, "drawing bars", description)
    figures = table(("run", *PARTS, "total"), rows, "Composition of running time", _CAPTION)
    return [Part(html=drawn + figures)]


def _called(run: Run) -> str:
    return f"program {program(run.program).source.removeprefix('program')[0]}"


def time_svg(all_runs: list[Run]) -> str:
    """Draw the times of runs as stacked bars of the same scale. ``data-seconds`` is the time of a part of a bar."""
    longest = max(run.total.seconds for run in all_runs)
    key = 4 * 17 + 14

    def bars() -> Iterator[str]:
        for place, run in enumerate(all_runs):
            x, y = 100 * (_WIDTH - _BAR_WIDTH) // 2, 100 * (key + place * _STEP + 16)
            for name, fill, time in zip(PARTS, _FILLS, times_of(run), strict=True):
                wide = round(100 * _BAR_WIDTH * time.seconds / longest)
                if wide:
                    size = f'x="{svg.number(x)}" y="{svg.number(y)}" width="{svg.number(wide)}" height="{_BAR}"'
                    title = f"<title>{name}: {time}</title>"
                    yield f'<rect {size} fill="{fill}" data-seconds="{time.seconds:.3f}">{title}</rect>'
                x += wide

    def names() -> Iterator[str]:
        for place, run in enumerate(all_runs):
            at = Pixel(100 * (_WIDTH - _BAR_WIDTH) // 2, 100 * (key + place * _STEP + 11))
            yield svg.text(at, f"example {run.example}, {_called(run)}: {run.total}")

    def samples() -> Iterator[str]:
        for place, (name, fill) in enumerate(zip(PARTS, _FILLS, strict=True)):
            x, y = (_WIDTH - _BAR_WIDTH) // 2 + place // 4 * 175, 6 + place % 4 * 17
            yield f'<rect x="{x}" y="{y}" width="20" height="11" fill="{fill}" stroke="#000" stroke-width="0.6"/>'
            yield svg.text(Pixel(100 * (x + 26), 100 * (y + 10)), name)

    items = [
        f"<defs>{_PATTERNS}</defs>",
        *svg.group("key", _TEXT, samples()),
        *svg.group("names", _TEXT, names()),
        *svg.group("parts", 'stroke="#000" stroke-width="0.6"', bars()),
    ]
    return svg.page(_WIDTH, key + len(all_runs) * _STEP, "Composition of running time on the 1620", items)

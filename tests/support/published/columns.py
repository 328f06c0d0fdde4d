"""Lines of the published vectors for card fields: E, F and I fields, read and written."""

from collections.abc import Iterator
from itertools import product

from tests.support.published import fields, operands
from tests.support.published.rows import Row, row
from tests.support.published.specification import LOWEST, Arithmetic, Undecided, decade

READ = (
    *("signs", "no point", "point", "exponent", "exponent without E", "blanks before", "blanks after", "blanks inside"),
    *("blank field", "digits cut", "zeros before", "zero", "minus zero", "top", "bottom", "out of range", "no number"),
)
READ_CARDS: dict[str, tuple[tuple[str, str], ...]] = {
    "signs": (("E14.8", "+.20000000E+01"), ("E14.8", "-.50000000E+01"), ("E14.8", " .20000000E+01"), ("F5.2", "-1.25")),
    "no point": (("F5.2", "12345"), ("E14.8", "     200000000"), ("F4.0", "1234"), ("F6.6", "123456"), ("F3.2", "  5")),
    "point": (
        ("F5.2", "1.234"),
        ("E14.8", "  20000000.0  "),
        ("F8.3", "12.5    "),
        ("F6.0", ".12345"),
        ("F3.2", " 5."),
    ),
    "exponent": (
        *(
            ("E4.0", "1.E4"),
            ("E4.0", ".1E5"),
            ("E3.1", "1E5"),
            ("E3.0", "1E4"),
            ("E3.2", "1E6"),
            ("E10.4", "  125E-02"),
        ),
        *(("E14.8", "  .12345678E-9"), ("E14.8", "   -31.415E+01"), ("E14.8", "      .2E-00  ")),
    ),
    "exponent without E": (("E8.4", "+0512+04"), ("E8.4", "-0512-04"), ("E10.3", "  1.25+02 "), ("E10.0", " 34.5-03")),
    "blanks before": (("E14.8", "           2.0"), ("F7.3", "   -1.5"), ("F7.3", "    -15")),
    "blanks after": (
        *(("E14.8", "2.0           "), ("E14.8", "     2.0      "), ("E14.8", "   .2E1      "), ("F6.1", "12    ")),
        *(("F6.2", "-12   "), ("E8.4", "1+1     "), ("E14.8", "  .5-01       ")),
    ),
    "blanks inside": (("E14.8", " .20000000E 01"), ("F5.1", "1 2 3"), ("F6.0", " 4 5 6"), ("E14.8", "  -.250000E 00")),
    "blank field": (("E14.8", " " * 14), ("F5.2", " " * 5), ("F1.0", " ")),
    "digits cut": (
        *(("E14.8", "  .12345678999"), ("E22.0", "  12345678901234567890"), ("F22.10", "-1234567890.1234567890")),
        *(("F32.0", "9999999999999999999999999999999."), ("E36.0", "-.555555555555555555555555555555E+05")),
        *(("F34.2", "1234567890123456789012345678901234"), ("F32.0", "1000000000000000000000000000005.")),
    ),
    "zeros before": (("E22.0", "    .00000000012345678"), ("F12.0", "000000012345"), ("E14.8", "00012.5E+00000")),
    "zero": (
        ("E14.8", "+.00000000E+00"),
        ("E14.8", " .00000000E-99"),
        ("F3.0", "0  "),
        ("F4.0", " 0.0"),
        ("E6.0", "0.E+50"),
    ),
    "minus zero": (("E14.8", "-.00000000E-99"), ("E14.8", "       -.0E+00"), ("F4.0", " -0."), ("F3.1", "-00")),
    "top": (("E14.8", " .99999999E+99"), ("E14.8", "-.10000000E+99"), ("E14.8", "  9999.9999E95"), ("E6.0", " 1.E98")),
    "bottom": (
        ("E14.8", " .10000000E-99"),
        ("E14.8", "-.99999999E-99"),
        ("E14.8", "    .0001E-096"),
        ("E7.0", "1.E-100"),
    ),
    "out of range": (
        *(("E14.8", " 1.00000000E99"), ("E14.8", "-.10000000E100"), ("E14.8", "      .01E-098"), ("E7.0", "1.E-101")),
        ("E14.8", "   1.E+1234567"),
    ),
    "no number": (
        *(("E14.8", "          1.2."), ("F5.2", "  1A2"), ("F5.2", "    -"), ("F5.2", "  --1"), ("F5.2", "    .")),
        *(("E14.8", "        1.5E+ "), ("E14.8", "           E05"), ("F5.2", "1.5/ "), ("E8.2", "  1.5E.5")),
    ),
}
READ_FIXED = (
    "signs",
    "blanks before",
    "blanks after",
    "blanks inside",
    "blank field",
    "four digits kept",
    "zero",
    "no number",
)
READ_FIXED_CARDS: dict[str, tuple[tuple[str, str], ...]] = {
    "signs": (("I4", "_-12"), ("I4", "_+12"), ("I5", "-9999"), ("I4", "9999"), ("I1", "7")),
    "blanks before": (("I2", "_8"), ("I6", "___-42")),
    "blanks after": (("I4", "12__"), ("I4", "-1__"), ("I3", "_5_")),
    "blanks inside": (("I4", "1_2_"), ("I5", "-1__2"), ("I4", "_1_2")),
    "blank field": (("I4", "____"), ("I1", "_")),
    "four digits kept": (("I5", "12345"), ("I6", "-12345"), ("I5", "10000"), ("I10", "9876543210"), ("I5", "1____")),
    "zero": (("I3", "__0"), ("I4", "__-0"), ("I6", "000000")),
    "no number": (("I4", "1.5_"), ("I4", "___-"), ("I4", "A123"), ("I4", "12E1"), ("I4", "_--1")),
}
WRITE_E = (
    "eight digits",
    "fewer digits",
    "more columns",
    "point moved",
    "too small",
    "exponent out",
    "zeros",
    "top",
    "bottom",
)
WRITE_E_FIELDS = {
    "eight digits": ("E14.8",),
    "fewer digits": ("E13.7", "E10.4", "E8.2", "E7.1"),
    "more columns": ("E16.8", "E20.8"),
    "point moved": ("E14.7", "E16.5", "E20.2", "E14.0", "E12.5", "E10.3", "E9.2"),
    "too small": ("E6.0", "E6.1", "E9.4", "E14.9", "E12.7"),
}
WRITE_F = (
    "plain",
    "fits exactly",
    "below one",
    "no decimals",
    "too small",
    "small",
    "zero",
    "digits beyond",
    "top",
    "bottom",
)
WRITE_F_FIELDS = ("F7.3", "F8.0", "F10.4", "F5.2", "F4.1", "F12.1", "F20.10", "F6.5", "F16.2", "F3.2", "F38.2")
WRITE_FIXED = ("plain", "minus", "fits exactly", "digits lost", "zero")


def read_bounds(by: Arithmetic) -> Iterator[Row]:
    for kind, cards in READ_CARDS.items():
        for field, columns in cards:
            # Columns of the field that are not punched are blank.
            columns = columns.ljust(fields.parts(field)[1])
            number, code = fields.read_floating(field, columns, by)
            yield row(kind, (field, f"'{columns}'"), (number if number is not None else "?", code), by)


def read_fixed_bounds(by: Arithmetic) -> Iterator[Row]:
    for kind, cards in READ_FIXED_CARDS.items():
        for field, written in cards:
            columns = written.replace("_", " ")
            value, code = fields.read_fixed(columns)
            yield row(kind, (field, f"'{columns}'"), (value if value is not None else "?", code), by)


def write_e(by: Arithmetic) -> Iterator[Row]:
    for e, field in ((-97, "E14.5"), (-98, "E20.2"), (-99, "E14.7"), (-98, "E10.2"), (LOWEST, "E12.5")):
        yield from _written("exponent out", field, operands.number(10 ** (by.digits - 1), e, by), by)
    for number in operands.singles(by):
        for kind, names in WRITE_E_FIELDS.items():
            for field in names:
                if not number.size and kind != "too small":
                    kind = "zeros"
                e = decade(number.size) if number.size else 0
                kind = {99: "top", -99: "bottom"}.get(e, kind) if kind != "too small" else kind
                yield from _written(kind, field, number, by)


def write_f(by: Arithmetic) -> Iterator[Row]:
    for number in operands.singles(by):
        for field in WRITE_F_FIELDS:
            _, width, decimals = fields.parts(field)
            e = decade(number.size) if number.size else 0
            if not number.size:
                kind = "zero"
            elif 1 + max(e, 0) + 1 + decimals > width:
                kind = {99: "top"}.get(e, "too small")
            elif e <= -decimals:
                kind = {-99: "bottom"}.get(e, "small")
            elif e > by.digits - decimals:
                kind = "digits beyond"
            elif 1 + max(e, 0) + 1 + decimals == width:
                kind = "fits exactly"
            else:
                kind = "below one" if e <= 0 else "plain" if decimals else "no decimals"
            yield from _written(kind, field, number, by)


def _written(kind: str, field: str, number: operands.Number, by: Arithmetic) -> Iterator[Row]:
    try:
        columns, code = fields.write_floating(field, number, by)
    except Undecided:
        return
    yield row(kind, (field, number), (f"'{columns}'", code), by)


def write_fixed(by: Arithmetic) -> Iterator[Row]:
    values = (0, 7, -7, 42, -42, 123, -123, 9999, -9999, 1005, -1005, 1000, 10, -305)
    for value, width in product(values, (1, 2, 3, 4, 5, 9)):
        try:
            columns = fields.write_fixed(f"I{width}", value)
        except Undecided:
            continue
        length = len(str(value))
        kind = "zero" if not value else "digits lost" if length > width else "fits exactly" if length == width else ""
        yield row(kind or ("minus" if value < 0 else "plain"), (f"I{width}", value), (f"'{columns}'", ""), by)

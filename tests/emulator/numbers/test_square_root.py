"""SQRT with every number of digits, compared with :mod:`decimal`: the exact root, truncated or rounded half up."""

from decimal import ROUND_DOWN, ROUND_HALF_UP, Decimal, localcontext

from hypothesis import given
from hypothesis import strategies as st

from emulator.numbers.arithmetic import profile
from emulator.numbers.functions import function


@given(st.data(), st.integers(2, 28), st.booleans(), st.integers(-99, 99))
def test_square_root(data: st.DataObject, digits: int, rounding: bool, exponent: int) -> None:
    rules = profile(f"{'rounding' if rounding else 'truncating'}:{digits}").rules
    squares = st.integers(1, 10 ** (digits // 2) - 1).map(lambda n: int(str(n * n).ljust(digits, "0")[:digits]))
    size = data.draw(
        st.integers(rules.least, rules.limit - 1) | st.sampled_from([rules.least, rules.limit - 1]) | squares
    )
    with localcontext() as context:
        context.prec = 100
        root = Decimal(size).scaleb(exponent - digits).sqrt()
        place = root.adjusted() + 1
        kept = int(root.scaleb(digits - place).to_integral_value(ROUND_HALF_UP if rounding else ROUND_DOWN))
    if kept == rules.limit:
        kept, place = kept // 10, place + 1
    for mantissa in (size, -size):
        found = function("SQRT", mantissa, exponent, rules)
        assert (found.mantissa, found.exponent, found.code) == (kept, place, "")

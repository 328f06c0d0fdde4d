"""Hypothesis strategies for source decks: mostly valid programs, and programs with a few columns changed."""

from functools import cache

from hypothesis import strategies as st

from emulator.language.cards import CHARACTERS, RECORD_MARKS

SPECS = st.sampled_from(
    ["E14.8", "F8.3", "F6.2", "E10.3", "I4", "I2", "2I3", "3X", "2X,I4", "4HN = ", "1H,", "/", "2(I3,1X)", "3E14.8"]
)
FLOATING_NAMES = st.sampled_from(["A", "B", "Z", "X(I)", "X(J+1)", "X(3)", "Y(I,J)", "Y(2,1)", "A", "B"])
FIXED_NAMES = st.sampled_from(["I", "J", "K", "N", "M(I)", "M(2)", "I", "J"])
FLOATING_CONSTANTS = st.sampled_from(["0.", "1.", "-1.", "2.5", ".3E-5", "1.E60", "9.9E97", "1.E-60", "3.1415926535"])
FIXED_CONSTANTS = st.sampled_from(["0", "1", "2", "3", "7", "9999"])

SHORT_FUNCTIONS = ("SQRT", "SQRTF")
ALL_FUNCTIONS = (*SHORT_FUNCTIONS, "SIN", "COSF", "ATAN", "EXP", "LOGF")


def _sums(parts: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.one_of(
        st.builds("{}{}{}".format, parts, st.sampled_from("+-*/+-*"), parts),
        st.builds("{}{}{}{}{}".format, parts, st.sampled_from("+-*/"), parts, st.sampled_from("+-*/"), parts),
        st.builds("({}-{})".format, parts, parts),
        st.builds("(-{})".format, parts),
    )


# Strategies are kept, because hypothesis takes longer to check a new strategy than to draw from it.
@cache
def floating(functions: tuple[str, ...]) -> st.SearchStrategy[str]:
    def wider(parts: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
        return st.one_of(
            _sums(parts),
            st.builds("{}({})".format, st.sampled_from(functions), parts),
            st.builds("({})**{}".format, parts, st.sampled_from(["2", "3", "J", "(-2)", "0", "1", "(-1)", "K"])),
        )

    return st.recursive(FLOATING_NAMES | FLOATING_CONSTANTS.filter(lambda c: c[0] != "-"), wider, max_leaves=6)


FIXED = st.recursive(FIXED_NAMES | FIXED_CONSTANTS, _sums, max_leaves=5)
_FLOATING_ITEM = FLOATING_NAMES | st.sampled_from(["X", "Y", "(X(K),K=1,3)", "((Y(I,J),I=1,2),J=1,N)", "(A,B,I=1,K)"])
_FIXED_ITEM = FIXED_NAMES | st.sampled_from(["M", "(I,M(I),I=1,N)", "(I,I=1,N,K)", "(J,K=1,4)"])
FLOATING_ITEMS, FIXED_ITEMS = st.lists(_FLOATING_ITEM, max_size=4), st.lists(_FIXED_ITEM, max_size=4)
ITEMS = st.lists(_FLOATING_ITEM | _FIXED_ITEM, max_size=4)


FORMATS = st.lists(SPECS, max_size=4)
BOUNDS = st.sampled_from(["1", "2", "N", "K", "5"])
FORMS = st.sampled_from(["901", "902", "903", "904"])
FORMS_WITH_ITEMS = st.sampled_from([("905", FLOATING_ITEMS), ("906", FIXED_ITEMS)])


@cache
def tested(functions: tuple[str, ...], powers: bool) -> st.SearchStrategy[str]:
    """Return the expressions whose sign an IF tests."""
    values = floating(functions) | FIXED
    if powers:
        values |= st.builds("({})**({})".format, floating(functions), floating(functions))
    return values


@cache
def fixed_or(functions: tuple[str, ...]) -> st.SearchStrategy[str]:
    return FIXED | floating(functions)


@cache
def labels_up_to(count: int) -> st.SearchStrategy[str]:
    return st.integers(1, count).map(lambda n: str(10 * n))


_COLUMNS = 66
"""The columns of a statement on a single card."""
START = ["I=1", "J=2", "N=2", "K=3", "A=1.5", "B=-2.", "Z=0.", "DO 5 I=1,3", "M(I)=I", "5 X(I)=A", "M(4)=0"]
START += ["DO 6 I=1,2", "Y(I,1)=B", "6 Y(I,2)=-Z", "I=2"]


@st.composite
def programs(draw: st.DrawFn, functions: tuple[str, ...] = SHORT_FUNCTIONS, powers: bool = False) -> list[str]:
    """Draw a deck of up to twenty statements, numbered 10, 20, and so on, with FORMATs 901 to 906 and an END."""
    count = draw(st.integers(2, 20))
    labels = labels_up_to(count)
    expressions = floating(functions)
    assigned, values = fixed_or(functions), tested(functions, powers)
    cards = ["DIMENSION X(3),Y(2,2),M(4)"]
    cards += START[: draw(st.sampled_from([len(START)] * 6 + [0, 3, 6]))]
    for n in range(1, count + 1):
        later = str(10 * draw(st.integers(min(n + 1, count), count)))
        form, items = draw(FORMS), ITEMS
        if draw(st.integers(0, 3)):
            form, items = draw(FORMS_WITH_ITEMS)
        kind = draw(st.integers(0, 11))
        if kind <= 3:
            body = f"{draw(FLOATING_NAMES)}={draw(expressions)}"
        elif kind <= 5:
            body = f"{draw(FIXED_NAMES)}={draw(assigned)}"
        elif kind == 6:
            body = f"IF({draw(values)}){draw(labels)},{draw(labels)},{draw(labels)}"
        elif kind == 7:
            end = later if draw(st.integers(0, 3)) == 0 else str(10 * n + 5)
            body = f"DO {end} {draw(st.sampled_from('IJK'))}={draw(BOUNDS)},{draw(BOUNDS)}"
        elif kind == 8:
            switch = f"IF(SENSE SWITCH {draw(st.integers(1, 4))}){draw(labels)},{draw(labels)}"
            body = draw(st.sampled_from([f"GO TO {later}", f"GO TO({later},{later}),J", switch, "PAUSE", "STOP"]))
        elif kind == 9:
            body = ",".join([f"{draw(st.sampled_from(['READ', 'ACCEPT']))} {form}", *draw(items)])
        elif kind == 10:
            body = ",".join([f"{draw(st.sampled_from(['PUNCH', 'PRINT', 'TYPE']))} {form}", *draw(items)])
        else:
            body = "CONTINUE"
        if len(body) > _COLUMNS:
            body = "CONTINUE"
        cards.append(f"{10 * n} {body}")
        if body.startswith(f"DO {10 * n + 5} "):
            cards.append(f"{10 * n + 5} {draw(FLOATING_NAMES)}={draw(expressions)}")
    for n in range(901, 905):
        cards.append(f"{n} FORMAT({','.join(draw(FORMATS))})")
    return [*cards, "905 FORMAT(3E14.8)", "906 FORMAT(2HI=,5I4)", "END"]


CARD_TEXT = st.text(st.sampled_from(sorted(CHARACTERS)), max_size=80)
WORDS = st.sampled_from(
    "DO 10 I=1, GO TO ( IF( IF(SENSE SWITCH READ PUNCH TYPE FORMAT( DIMENSION X( E14.8 3H ,I4) CONTINUE END = A B(I) "
    "5 , ** * / ) ( 1. .5E2 C 1234567890".split(" ")
)
CARD_OF_WORDS = st.lists(WORDS | CARD_TEXT.map(lambda t: t[:3]), max_size=12).map(lambda w: " ".join(w)[:80])
CARD = st.one_of(CARD_TEXT, CARD_OF_WORDS, CARD_OF_WORDS.map(lambda t: ("     1" + t)[:80]))


@st.composite
def spoilt_programs(draw: st.DrawFn) -> list[str]:
    """Draw a valid program in which some columns and cards are changed, inserted, removed or repeated."""
    cards = draw(programs())
    for _ in range(draw(st.integers(1, 4))):
        n = draw(st.integers(0, len(cards) - 1))
        column = draw(st.integers(0, len(cards[n])))
        char = draw(st.sampled_from(sorted(CHARACTERS)))
        change = draw(st.integers(0, 4))
        if change <= 2:
            cards[n] = (cards[n][:column] + char * (change > 0) + cards[n][column + (change < 2) :])[:80]
        elif change == 3 and len(cards) > 1:
            del cards[n]
        else:
            cards.insert(n, cards[n])
    return cards


NUMBERS = st.sampled_from(
    [" .20000000E+01", "-.00000000E-99", "   5", "   2  3", "1.5", "-7", "", "1E99", ".5 E 1", "9999"]
)
DATA_TEXT = st.text(st.sampled_from(sorted(CHARACTERS.difference(RECORD_MARKS))), max_size=80)
"""Text without record marks. A deck with a record mark runs only in the interpreter."""
DATA = st.lists(st.one_of(NUMBERS, st.lists(NUMBERS, max_size=5).map("".join), DATA_TEXT), max_size=12)

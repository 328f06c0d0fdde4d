"""Programs and decks for tests of the console: inputs for its page, its desk and the command, and their output."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from modern.publication.desk import Answer, Desk
from tests.support.paths import DATA

PERIOD = DATA / "period"
LOOP = "      I=1\n    1 I=I+1\n      IF(I-5000)2,3,3\n    2 GO TO 1\n    3 GO TO 1\n      END\n"
COUNTED = "      READ 6,I\n      J=I*I\n      PUNCH 6,J\n      STOP\n    6 FORMAT(I3)\n      END\n"
PAUSED = "      PAUSE 7\n      PRINT 1\n      STOP\n    1 FORMAT(5HAFTER)\n      END\n"
BAD = "      GO TO 9\n      I=\n      END\n"


@dataclass(frozen=True)
class Pair:
    """A program and a deck, the operator's actions, and the expected output.

    Both are texts, or names that the page offers.
    """

    name: str
    program: str
    deck: str
    source: str = ""
    cards: str = ""
    operator: tuple[str, ...] = ()
    shows: str = ""
    limit: int = 5_000_000
    upcase: bool = False

    @property
    def request(self) -> dict[str, Any]:
        """Return the input of the desk."""
        program = [self.program, self.source] if self.source else self.program
        deck = [self.deck, self.cards] if self.cards else self.deck
        return {"program": program, "deck": deck, "limit": self.limit, "upcase": self.upcase}

    def command(self, room: Path) -> list[str]:
        """Return the command line for the same run, writing its files into ``room``, the working folder."""
        program, deck = self.program, self.deck
        if self.source:
            (room / program).write_text(self.source)
        if self.cards:
            (room / deck).write_text(self.cards)
        (room / "done").write_text("".join(line + "\n" for line in self.operator))
        arguments = ["run", program, *([deck] if deck else []), "--punch", "-", "--typewriter", "typed"]
        arguments += ["--limit", str(self.limit), *(["--upcase"] if self.upcase else [])]
        return [*arguments, *(["--operator=done"] if self.operator else [])]


@dataclass
class Played:
    """The output of a run: cards, typed lines and messages. ``loaded`` is False if the desk rejected the input."""

    loaded: bool = True
    punched: list[str] = field(default_factory=list)
    typed: list[str] = field(default_factory=list)
    messages: list[str] = field(default_factory=list)

    def see(self, answer: Answer) -> None:
        """Collect the answer of a slice."""
        self.punched += [text for what, text in answer["events"] if what == "punch"]
        self.typed += [text for what, text in answer["events"] if what == "type"]
        self.messages += answer.get("messages", [])


def played(desk: Desk, pair: Pair) -> Played:
    """Load and run a pair at a desk, performing an action of its operator at each halt."""
    run = Played()
    answer = desk.load(pair.request)
    if "refused" in answer:
        return Played(False, messages=["hull1620: " + answer["refused"][0], *answer["refused"][1:]])
    desk.run(1)
    actions = [line for line in pair.operator if not line.startswith("*")]
    while actions and actions[0].startswith("SWITCH"):
        desk.act(actions.pop(0))
    desk.act("START")
    while True:
        answer = desk.run(1000)
        run.see(answer)
        if answer["ended"]:
            return run
        if answer["waits"]:
            desk.act(actions.pop(0) if actions else "START")


def _period(name: str, operator: bool = False, deck: bool = True, upcase: bool = False, shows: str = "") -> Pair:
    did = (PERIOD / f"{name}.operator").read_text().splitlines() if operator else []
    cards = (PERIOD / f"{name}.deck").read_text() if deck else ""
    return Pair(
        name,
        f"{name}.f",
        f"{name}.deck" if deck else "",
        (PERIOD / f"{name}.f").read_text(),
        cards,
        tuple(did),
        shows,
        upcase=upcase,
    )


PAIRS = (
    *(Pair(f"program1 example{n}", "program1", f"example{n}") for n in range(1, 7)),
    *(Pair(f"examples' program1 example{n}", "program1_examples", f"example{n}") for n in range(1, 7)),
    _period("table"),
    _period("fibon"),
    _period("stats"),
    _period("pi", upcase=True),
    _period("tictac", operator=True, shows="game"),
    _period("job", operator=True),
    Pair("a loop", "loop.f", "", LOOP, limit=100_000, shows="endless"),
    Pair("a square", "square.f", "one.deck", COUNTED, " 12\n"),
    Pair("a bad card", "square.f", "bad.deck", COUNTED, "1X2\n", shows="bad card"),
    Pair("a pause", "pause.f", "", PAUSED, operator=("START",), shows="pause"),
    Pair("a bad source", "bad.f", "", BAD, shows="bad source"),
    Pair("no card", "square.f", "", COUNTED),
)

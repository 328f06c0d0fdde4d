"""Render the proof sheets (:mod:`modern.edition.sheets`) as HTML forms, as PDF, and as CSV tables to fill in.

The template of the form is ``proof_sheet.html``, and the template of the printed sheet is ``proof_sheet.typ``. A script
in the form writes the answers as the CSV table that ``hull1620 apparatus --sheet`` reads.
"""

import tempfile
from collections.abc import Iterator
from html import escape
from importlib.resources import files as package_files
from pathlib import Path

from modern.edition.page_answers import blank_table
from modern.edition.sheets import DEPENDS, Item, Question, Sheet
from modern.publication.building import fill

_INTRODUCTION = (
    "This sheet belongs to page {page} of Karen Jensen Butler, An Algorithm for Determining the Convex Hull of N "
    "Points in 3-Space, Oregon State University, 1963. Our text was restored from a transcription of unknown origin. "
    "Nobody who worked on it has seen the page. If you have the page, you can settle what is asked below."
)
_STEPS = (
    "Find each marked piece on the page, and tick the box with the reading of the page. The first box is our reading. "
    "Tick nothing if you are not sure. If the page has something else, copy the whole line after “other”. "
    "If it cannot be read, tick “unreadable”. Blanks do not matter, and all other lines need no check."
)
_STEPS_OF_QUESTIONS = (
    "Tick the box with the answer of the page. Tick nothing if you are not sure. If no box fits, copy the whole "
    "sentence after “other”. If the page cannot be read, tick “unreadable”."
)


def files(sheet: Sheet) -> dict[str, str]:
    """Return the text files of a proof sheet by name: the HTML form and the CSV table."""
    stem = f"page-{int(sheet.page):03}"
    return {f"{stem}.html": html(sheet), f"{stem}.csv": table(sheet)}


def table(sheet: Sheet) -> str:
    """Return the CSV table of a proof sheet."""
    entries: tuple[Item | Question, ...] = (*sheet.items, *sheet.questions)
    return blank_table(
        [
            {
                "item": entry.id,
                "page": sheet.page,
                "card": entry.text.strip() if isinstance(entry, Item) else "",
                "question": _question(entry),
                "choices": "; ".join(f"{choice.letter}: {_token(choice.token)}" for choice in entry.choices),
            }
            for entry in entries
        ]
    )


def _steps(sheet: Sheet) -> str:
    return _STEPS if sheet.items else _STEPS_OF_QUESTIONS


def _token(text: str) -> str:
    return text.strip() or "no such line"


def _question(entry: Item | Question) -> str:
    if isinstance(entry, Question):
        return entry.ask
    if entry.how == "card":
        return "Does the page have this line?"
    return f"Is “{entry.text[entry.first : entry.last]}” right (from column {entry.first + 1})?"


def _depends(entry: Item | Question) -> str:
    return entry.depends if isinstance(entry, Question) else f"The answer decides {DEPENDS[entry.how]}."


def _split(item: Item) -> tuple[str, str, str]:
    """Return the text of a card before the token that the item asks about, the token, and the text after it."""
    return item.text[: item.first], item.text[item.first : item.last], item.text[item.last :]


def _frame(name: str) -> str:
    return package_files("modern").joinpath("publication", name).read_text(encoding="utf-8")


def html(sheet: Sheet) -> str:
    """Return a proof sheet as an HTML form, which saves its answers as a file without a server."""
    return fill(
        _frame("proof_sheet.html"),
        TITLE=f"Proof sheet for page {sheet.page}",
        INTRODUCTION=escape(_INTRODUCTION.format(page=sheet.page)),
        STEPS=escape(_steps(sheet)),
        QUESTIONS="".join(_html_cards(sheet)) + "".join(map(_html_question, sheet.questions)),
    )


def _html_cards(sheet: Sheet) -> Iterator[str]:
    for card in sheet.cards:
        asked = ""
        for item in sheet.items:
            if item.card == card.number:
                before, token, after = (escape(part, quote=False) for part in _split(item))
                asked += f"<pre>{before}<b>{token}</b>{after}</pre>\n{_html_choices(item)}"
        yield f'<div class="card">{asked}</div>\n' if asked else f"<pre>{escape(card.text)}</pre>\n"


def _html_question(question: Question) -> str:
    return f'<div class="card"><p>{escape(question.ask)}</p>\n{_html_choices(question)}</div>\n'


def _html_choices(entry: Item | Question) -> str:
    boxes = "".join(
        f'<label><input type="radio" name="{entry.id}" value="{choice.letter}"> <code>{escape(_token(choice.token))}'
        "</code></label>"
        for choice in entry.choices
    )
    return f"""<fieldset><legend>{entry.id}. <small>{escape(_depends(entry))}</small></legend>{boxes}
<label><input type="radio" name="{entry.id}" value="?"> unreadable</label>
<label class="other"><input type="radio" name="{entry.id}" value="="> other:
<input type="text" name="{entry.id} other" aria-label="the whole line of the page"></label></fieldset>
"""


def typst(sheet: Sheet) -> str:
    """Return a proof sheet as Typst markup for printing."""
    return fill(
        _frame("proof_sheet.typ"),
        PAGE=sheet.page,
        INTRODUCTION=_say(_INTRODUCTION.format(page=sheet.page)),
        STEPS=_say(_steps(sheet)),
        QUESTIONS="".join(_typst_cards(sheet)) + "".join(map(_typst_question, sheet.questions)),
    )


def _typst_cards(sheet: Sheet) -> Iterator[str]:
    for card in sheet.cards:
        asked = ""
        for item in sheet.items:
            if item.card == card.number:
                before, token, after = map(_string, _split(item))
                asked += f"#item[#mono[#{before}#mark({token})#{after}]\\\n{_typst_choices(item)}]"
        yield f"#asked[{asked}]\n" if asked else f"#plain({_string(card.text)})\n"


def _typst_question(question: Question) -> str:
    return f"#asked[#item[{_say(question.ask)}\\\n{_typst_choices(question)}]]\n"


def _typst_choices(entry: Item | Question) -> str:
    boxes = "".join(f"#tick({_string(_token(choice.token))})" for choice in entry.choices)
    last = '#tick("unreadable")#box[#tick("other:")#blank(90mm)]'
    return f"#text(size: 7.5pt, fill: luma(90))[{entry.id}. {_say(_depends(entry))}]\\\n{boxes}{last}\n\n"


def _string(text: str) -> str:
    """Return a text as a string of Typst whose blanks are kept."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace(" ", "\u00a0") + '"'


def _say(text: str) -> str:
    return '#"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def pdf(sheet: Sheet) -> bytes:
    """Return a proof sheet as PDF. Raise ImportError outside a checkout, and BuildError without Typst."""
    from modern.publication.book.build import pdf as typeset  # the book is not part of the wheel

    with tempfile.TemporaryDirectory(prefix="sheet-") as folder:
        return typeset(typst(sheet), Path(folder))

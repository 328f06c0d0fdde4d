"""Render the proof sheets (:mod:`modern.edition.sheets`) as HTML forms, as PDF, and as CSV tables to fill."""

import tempfile
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path

from modern.edition.page_answers import blank_table
from modern.edition.sheets import DEPENDS, Item, Question, Sheet

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
_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 52rem; margin: 2rem auto; padding: 0 1rem }
body { color: #211e19; background: #fffdf8 }
pre { font: 15px/1.45 ui-monospace, monospace; margin: .15rem 0; white-space: pre-wrap; overflow-wrap: anywhere }
pre { color: #5d564b }
.card { border-left: 3px solid #8a2c17; padding: .1rem 0 .4rem .8rem; margin: .8rem 0 }
.card pre { color: inherit } b { background: #f3e3b3; font-weight: 700 }
fieldset { border: 0; padding: 0; margin: .3rem 0 } legend, small { color: #5d564b }
label { display: inline-block; margin-right: 1rem } label code { font-size: 1rem }
input { font: inherit } input[name=reader] { width: 16rem }
.other input[type=text] { width: min(60vw, 14rem) }
button { font: inherit; padding: .4rem 1rem }
@media (prefers-color-scheme: dark) {
  body { color: #ece6da; background: #1b1915 } pre, legend, small { color: #b3aa9b } b { background: #5a4a17 }
}
@media print { button, .other input { display: none } .card { break-inside: avoid } }
"""
# The script writes the answers as the CSV table that `hull1620 apparatus --sheet` reads.
_SCRIPT = """
const form = document.forms[0], cell = text => '"' + text.replaceAll('"', '""') + '"';
form.addEventListener('submit', event => {
  event.preventDefault();
  const data = new FormData(form), rows = ['item,page,card,question,choices,answer'];
  for (const name of new Set(data.keys())) {
    if (name.endsWith(' other')) continue;
    const own = data.get(name + ' other') || '';
    const answer = data.get(name) === '=' ? own.trim() && '=' + own : data.get(name);
    if (answer) rows.push([name, '', '', '', '', answer].map(cell).join(','));
  }
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([rows.join('\\r\\n') + '\\r\\n'], {type: 'text/csv'}));
  link.download = document.title.replace(/\\W+/g, '-').toLowerCase() + '.csv';
  link.click();
});
"""


def files(sheet: Sheet) -> dict[str, str]:
    """Return the text files of a proof sheet by name: the HTML form, and the table to fill in."""
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


def _marked(item: Item, mark: tuple[str, str], quote: Mapping[str, str]) -> str:
    """Return the text of a card with its token between the two strings of ``mark``."""
    parts = (item.text[: item.first], item.text[item.first : item.last], item.text[item.last :])
    before, token, after = ("".join(quote.get(c, c) for c in part) for part in parts)
    return f"{before}{mark[0]}{token}{mark[1]}{after}"


def _depends(entry: Item | Question) -> str:
    return entry.depends if isinstance(entry, Question) else f"The answer decides {DEPENDS[entry.how]}."


def html(sheet: Sheet) -> str:
    """Return a proof sheet as an HTML form, which saves its answers as a file without a server."""
    title = f"Proof sheet for page {sheet.page}"
    body = "".join(_html_cards(sheet)) + "".join(map(_html_question, sheet.questions))
    introduction = escape(_INTRODUCTION.format(page=sheet.page))
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{title}</title>
<style>{_STYLE}</style></head>
<body>
<h1>{title}</h1>
<p>{introduction}</p>
<p>{escape(_steps(sheet))}</p>
<form>
<p><label>Your name <input type="text" name="reader" required></label> <label>Date
<input type="date" name="date" required></label></p>
{body}
<p><button>Save the answers as a file</button></p>
<p><small>Send the file to whoever gave you this sheet. To read it: <code>hull1620 apparatus --sheet FILE --state
FOLDER</code>.</small></p>
</form>
<script>{_SCRIPT}</script>
</body>
</html>
"""


def _html_cards(sheet: Sheet) -> Iterator[str]:
    quote = {"&": "&amp;", "<": "&lt;", ">": "&gt;"}
    for card in sheet.cards:
        items = [item for item in sheet.items if item.card == card.number]
        if not items:
            yield f"<pre>{escape(card.text)}</pre>\n"
            continue
        asked = "".join(f"<pre>{_marked(item, ('<b>', '</b>'), quote)}</pre>\n{_html_choices(item)}" for item in items)
        yield f'<div class="card">{asked}</div>\n'


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
    cards = "".join(_typst_cards(sheet)) + "".join(_typst_question(question) for question in sheet.questions)
    return f"""#let blank(width) = box(width: width, line(length: 100%, stroke: 0.4pt))
#set page(paper: "a4", margin: (x: 20mm, y: 18mm), numbering: "1 / 1",
  header: text(size: 8pt)[Proof sheet for page {sheet.page} #h(1fr) Name: #blank(45mm) Date: #blank(25mm)])
#set text(font: ("IBM Plex Sans", "Libertinus Serif"), size: 9pt, lang: "en")
#set document(title: "Proof sheet for page {sheet.page}")
#let mono(body) = text(font: ("IBM Plex Mono", "DejaVu Sans Mono"), body)
#let tick(body) = box[#box(width: 0.8em, height: 0.8em, baseline: 0.08em, stroke: 0.5pt)~#mono(body)#h(1em)]
#let mark(body) = highlight(fill: rgb("#f3e3b3"), strong(body))
#let plain(body) = block(inset: (left: 8pt), above: 0.55em, below: 0.55em, text(fill: luma(90), mono(body)))
#let asked(body) = block(inset: (left: 8pt), stroke: (left: 1.5pt + rgb("#8a2c17")), above: 1em, below: 1em, body)
// A card and its boxes stay on one sheet of paper.
#let item(body) = block(breakable: false, above: 0.8em, below: 0.8em, body)
= Proof sheet for page {sheet.page}
{_say(_INTRODUCTION.format(page=sheet.page))}

{_say(_steps(sheet))}
#v(0.6em)
{cards}"""


def _typst_cards(sheet: Sheet) -> Iterator[str]:
    for card in sheet.cards:
        items = [item for item in sheet.items if item.card == card.number]
        asked = "".join(f"#item[#mono[{_typst_marked(item)}]\\\n{_typst_choices(item)}]" for item in items)
        yield f"#asked[{asked}]\n" if items else f"#plain({_string(card.text)})\n"


def _typst_marked(item: Item) -> str:
    before, token, after = (
        _string(part) for part in (item.text[: item.first], item.text[item.first : item.last], item.text[item.last :])
    )
    return f"#{before}#mark({token})#{after}"


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

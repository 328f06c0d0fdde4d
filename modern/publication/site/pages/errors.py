"""Every error number of the compiler and every code of the machine, with an example that gives it."""

from __future__ import annotations

from emulator.errors import explanations
from modern.publication.site.made import Made, Part, Target
from modern.publication.site.markup import definitions, element, escape, text


def make(argument: str) -> Made:
    """All of them, a section each."""
    parts, targets = [], []
    for number, found in explanations().items():
        example = element(
            "pre", escape("\n".join(found.example)), tabindex="0", aria_label=f"example of error {number}"
        )
        rest = definitions((("to mend it", escape(found.mend)), ("source", escape(found.source))), cls="facts")
        html = text("p", found.meaning) + example + rest
        parts.append(Part(f"Error {number}: {found.title}", f"error-{number}", html=html))
        targets.append(Target(f"error-{number}", f"error {number}", f"error {number}", f"error {number}"))
    return Made(tuple(parts), tuple(targets))

"""The error numbers of the compiler and the error codes of the machine, each with an example that causes it."""

from emulator.errors import explanations
from modern.publication.site.made import Made, Part, Target
from modern.publication.site.markup import definitions, escape, preformatted, text


def make(argument: str) -> Made:
    """Return a section for each number and code."""
    parts, targets = [], []
    for number, explanation in explanations().items():
        example = preformatted("\n".join(explanation.example), f"example of error {number}")
        facts = (("remedy", escape(explanation.remedy)), ("source", escape(explanation.source)))
        html = text("p", explanation.meaning) + example + definitions(facts, cls="facts")
        parts.append(Part(f"Error {number}: {explanation.title}", f"error-{number}", html=html))
        targets.append(Target(f"error-{number}", f"error {number}", f"error {number}", f"error {number}"))
    return Made(tuple(parts), tuple(targets))

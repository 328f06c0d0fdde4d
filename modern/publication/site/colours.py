"""The colours of the site by role, for the light and the dark theme; docs/_static/edition.css has the other styles.

Text has a contrast of at least 4.5 to 1 with its background, which axe checks in both themes.  Colour is never the only
sign: coloured text is also underlined, marked with a sign or labelled.
"""

from __future__ import annotations

from collections.abc import Mapping

ROLES = {
    "paper": ("#fdfcf8", "#17181a"),
    "desk": ("#f6f3ea", "#1e1f21"),
    "ink": ("#211e19", "#e8e3d8"),
    "quiet": ("#5d564b", "#b3ab9c"),
    "rule": ("#d8d1c1", "#3f3c35"),
    "link": ("#8a2c17", "#f2a88f"),
    "visited": ("#6b3a54", "#d7a9c4"),
    "card": ("#f6edd6", "#2a261c"),
    "card-rule": ("#dccb9f", "#4c442f"),
    "lost": ("#f7d8cd", "#5a2c20"),
    "given": ("#dbe7c8", "#36452a"),
    "ours": ("#e4dcf0", "#40355a"),
    "shade-1": ("#6e675b", "#8d8577"),
    "shade-2": ("#93866b", "#a2957a"),
    "shade-3": ("#b9a982", "#75694e"),
    "shade-4": ("#d9cba8", "#544b37"),
    "alarm": ("#a3321a", "#ff9d80"),
}
"""Each role with its colour in the light and in the dark theme."""

_FURO = {
    "color-background-primary": "paper",
    "color-background-secondary": "desk",
    "color-background-hover": "card",
    "color-background-hover--transparent": "card",
    "color-background-border": "rule",
    "color-background-item": "desk",
    "color-foreground-primary": "ink",
    "color-foreground-secondary": "quiet",
    "color-foreground-muted": "quiet",
    "color-foreground-border": "rule",
    "color-brand-primary": "link",
    "color-brand-content": "link",
    "color-brand-visited": "visited",
    "color-content-foreground": "ink",
    "color-code-background": "desk",
    "color-code-foreground": "ink",
    "color-inline-code-background": "desk",
    "color-sidebar-link-text--top-level": "ink",
    "color-sidebar-caption-text": "quiet",
    "color-sidebar-search-background": "paper",
    "color-highlight-on-target": "card",
    "color-admonition-background": "desk",
    "color-announcement-background": "desk",
}
"""The names of the theme's CSS variables, each with the role of its colour."""


def _variables(theme: int) -> Mapping[str, str]:
    variables = {f"e-{role}": colours[theme] for role, colours in ROLES.items()}
    variables["e-turned"] = str(theme)
    return variables | {name: ROLES[role][theme] for name, role in _FURO.items()}


LIGHT, DARK = dict(_variables(0)), dict(_variables(1))
"""The CSS variables of the light and of the dark theme, named without the two dashes."""

"""The colours of the edition by the part they play, light and dark; the rest of the style is docs/_static/edition.css.

Every pair that carries text has a contrast of 4.5 to 1 at least (tests/modern/publication/test_site_pages.py), and
nothing is told by colour alone: what is coloured is also underlined, signed or named.
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
"""A part, and its colour on light and on dark ground."""

TEXT_ON = (
    *(("ink", ground) for ground in ("paper", "desk", "card", "lost", "given", "ours")),
    *(("quiet", ground) for ground in ("paper", "desk", "card")),
    *(("link", ground) for ground in ("paper", "desk", "card")),
    *(("visited", ground) for ground in ("paper", "desk")),
    ("alarm", "paper"),
)
"""What is written on what."""

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
"""The theme's own names, and the part each plays."""


def _variables(place: int) -> Mapping[str, str]:
    own = {f"e-{role}": colours[place] for role, colours in ROLES.items()}
    own["e-turned"] = str(place)
    return own | {name: ROLES[role][place] for name, role in _FURO.items()}


LIGHT, DARK = dict(_variables(0)), dict(_variables(1))
"""CSS variables as the theme takes them, without the two dashes."""


def contrast(one: str, other: str) -> float:
    """The contrast of two colours as ``#rrggbb``, from 1 to 21 (WCAG 2.2, relative luminance)."""
    light, dark = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(colour: str) -> float:
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

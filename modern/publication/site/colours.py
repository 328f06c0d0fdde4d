"""The colours of the site by role, for the light and the dark theme.  docs/_static/edition.css has the other styles.

Text has a contrast of at least 4.5 to 1 with its background, which the tool axe checks in both themes.  Colour never
carries a meaning alone: coloured text is also underlined, marked with a sign or labelled.
"""

# Each role with its colour in the light and in the dark theme.
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

# For each role, the CSS variables of the theme Furo that have its colour, without "color-".
_FURO = {
    "paper": "background-primary sidebar-search-background",
    "desk": "background-secondary background-item code-background inline-code-background admonition-background "
    "announcement-background",
    "card": "background-hover background-hover--transparent highlight-on-target",
    "rule": "background-border foreground-border",
    "ink": "foreground-primary content-foreground code-foreground sidebar-link-text--top-level",
    "quiet": "foreground-secondary foreground-muted sidebar-caption-text",
    "link": "brand-primary brand-content",
    "visited": "brand-visited",
}


def _variables(theme: int) -> dict[str, str]:
    variables = {f"e-{role}": colours[theme] for role, colours in ROLES.items()}
    variables["e-turned"] = str(theme)
    return variables | {f"color-{name}": ROLES[role][theme] for role, names in _FURO.items() for name in names.split()}


# The CSS variables of the light and of the dark theme, named without the two dashes.
LIGHT, DARK = _variables(0), _variables(1)

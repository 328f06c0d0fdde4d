"""Generators of page content. The directive ``:::{made} NAME ARGUMENT`` calls ``make(ARGUMENT)`` of the module NAME.

The function ``make`` returns a :class:`~modern.publication.site.made.Made`. It raises ValueError for an unknown
argument.
"""

"""Generators of page content. The directive ``:::{made} NAME ARGUMENT`` calls ``make(ARGUMENT)`` of the module NAME.

The function ``make`` returns the parts of the content in order. It raises ValueError for an unknown argument.
"""

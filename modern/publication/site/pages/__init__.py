"""Generators of pages: the module NAME provides ``:::{made} NAME``, as :mod:`modern.publication.site` explains."""

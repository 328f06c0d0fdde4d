"""The edition as a site: how a page comes about, and how another is added.

``make edition`` runs Sphinx over ``docs/``.  Prose is MyST, a file a page.  What is made from data stands in it as

    :::{made} NAME ARGUMENT
    :::

which is replaced by what ``make(ARGUMENT)`` of the module ``modern/publication/site/pages/NAME.py`` returns: a
:class:`~modern.publication.site.made.Made`, that is headings with HTML or MyST below them, the addresses among it that
others may point at, and what the general index says of them.  So to add a page of data:

1. Facts: frozen dataclasses in ``modern/publication/``, without HTML; the book takes the same.
2. ``pages/NAME.py`` with ``make``; it is named nowhere else, a file there is a maker.  Escape with
   :mod:`~modern.publication.site.markup`, link with ``markup.address("program3", "147+2")``.
3. ``docs/PAGE.md``: its title, a paragraph that says what the page is for, the directive; ``PAGE`` in a toctree of
   ``docs/index.md``.  A page of wide tables has ``hide-toc: true`` in its head.

Prose points at data by roles, which fail the build where nothing stands: ``{card}`program3 147+2```, ``{row}`P1-039```,
``{name}`program3 KELEQ```, ``{error}`5```; any other address by its label, ``{at}`words <label>```.  A link to a file
of the project that is no page, as ``[README](../fortran_src/README.md)``, becomes the page that holds it, or words.
A figure of a committed result is written between double braces (:mod:`modern.publication.figures`).

Addresses are promises: an id is made from what the thesis or the data call a thing, never from a count of ours.
"""

"""The edition as a website, built by Sphinx from ``docs/`` (``make edition``).

A page of prose is a MyST file in ``docs/``.  Content that is generated from data stands in such a file as the directive

    :::{made} NAME ARGUMENT
    :::

Sphinx replaces the directive with the result of ``make(ARGUMENT)`` in ``modern/publication/site/pages/NAME.py``, a list
of :class:`~modern.publication.site.made.Part`: sections of HTML or MyST.

To add a page of prose:

1. Write ``docs/PAGE.md`` and add ``PAGE`` to a toctree, for example that of ``docs/index.md``.
2. For wide tables, put ``hide-toc: true`` into the head of the file.

To add a page made from data:

1. Put the facts into frozen dataclasses in ``modern/publication/``, without HTML, so that the book can use them too.
2. Write ``pages/NAME.py`` with a function ``make``.  The directive finds every file there, so no list needs a new
   entry.  Escape text with :mod:`~modern.publication.site.markup` and link with ``markup.link("program3", "147+2",
   TEXT)``.
3. Write ``docs/PAGE.md`` with a title, a paragraph that says what the page is for, and the directive.  Add ``PAGE`` to
   a toctree.
4. Add tests to ``tests/modern/publication/``.  The tests of links, HTML and accessibility cover the page already.

A link to a file that is no page, such as ``[README](../fortran_src/README.md)``, becomes a link to the page that
contains the file, or plain text.  ``:::{whole} FILE`` includes a file.  A result is quoted by its name between double
braces (:mod:`modern.publication.figures`).

The index page of a folder lists the pages of the folder with their first sentences (``:::{made} hub FOLDER/index``).
The file ``docs/subjects.csv`` holds the subjects of the page Index, which the search shows first.

Addresses are permanent: derive an id from a name in the thesis or in the data, never from a running number.
"""

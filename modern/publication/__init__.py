"""Everything that the project publishes about its programs: a website, a book, TEI documents and a deposit.

``site`` makes the website; its docstring explains how to add a page. ``book`` makes the book. ``tei``, ``tei_*`` and
``hull1620.odd`` make the TEI documents. ``building``, ``deposit``, ``metadata``, ``tables``, ``vendored`` and ``pyz``
make the deposit. ``flow``, ``chart`` and ``chart_svg`` draw flow charts. ``console``, ``desk``, ``panel``, ``parting``,
``verdict`` and ``decks`` are the emulator in the browser.

The other modules collect the facts that pages show, as frozen dataclasses without HTML: ``facing``, ``commentary``,
``moments``, ``uses``, ``measured`` and ``core`` about the programs, ``examples`` about the printed examples,
``numbered`` about numbered lists in documents, ``steps`` about the pictures of papers, ``essay`` about the pictures
of the home page, and ``figures`` about the results that documents quote.
"""

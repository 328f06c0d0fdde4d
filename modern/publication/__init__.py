"""Everything that the project publishes about its programs: a website, a book, TEI documents and a deposit.

``site`` makes the website. The docstring of ``site`` explains how to add a page. ``book`` makes the book. ``tei``,
``tei_*`` and ``hull1620.odd`` make the TEI documents. ``building``, ``deposit``, ``metadata``, ``tables``, ``vendored``
and ``pyz`` make the deposit. ``flow``, ``chart`` and ``chart_svg`` draw flow charts. ``console``, ``desk``, ``panel``,
``parting``, ``verdict`` and ``decks`` are the emulator in the browser.

The other modules collect the facts that pages show, as frozen dataclasses without HTML. ``facing``, ``commentary``,
``moments``, ``uses``, ``measured`` and ``core`` describe the programs, and ``examples`` describes the printed examples.
``numbered`` reads the numbered lists in documents, ``steps`` computes what the pictures of three papers show, ``essay``
computes what the figures of the home page show, and ``figures`` collects the results that documents quote.
"""

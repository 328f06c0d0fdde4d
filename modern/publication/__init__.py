"""The edition: everything the project publishes about its programs, as a site, a book, TEI documents and a deposit.

``building``, ``deposit``, ``metadata``: the builds.  ``site/``: the website; its docstring explains how to add a page.
``book/``: the book.  ``tei``, ``tei_*``, ``hull1620.odd``: the TEI documents.  ``flow``,
``chart``, ``chart_svg``: flow charts.
``console``, ``desk``, ``parting``: the emulator in the browser.  The other modules collect the facts that pages show,
as frozen dataclasses without HTML: ``facing``, ``uses``, ``measured`` and ``core`` about the programs, ``examples``,
``numbered`` (numbered lists in documents), ``steps`` (pictures of papers), ``figures`` (results quoted in documents).
"""

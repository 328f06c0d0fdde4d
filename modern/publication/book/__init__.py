"""The edition as a book: Typst typesets the documents and the data of the site as PDF/A.

``build`` has the list of chapters, ``parts`` makes the chapters generated from data, and ``markup`` translates Markdown
to Typst.  To add a chapter, add a row to ``CHAPTERS`` in ``build``.
"""

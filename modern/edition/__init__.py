"""The texts of the edition: witnesses, emendations, the decks built from them, and the evidence for each emendation.

To add an emendation:

1. Add a row to ``fortran_src/apparatus/PROGRAM.toml`` (listings) or ``transcripts/chapter6/chapter6.toml`` (printed
   results), after its neighbours on the page.  ``fortran_src/README.md`` and ``transcripts/README.md`` describe the
   fields.  A witness is never changed.
2. Give the row a ground: a check that fails if the row is removed.  :mod:`modern.edition.grounds` and
   :mod:`modern.edition.chapter6_grounds` list the kinds.  The deck of a ground of kind ``deck`` is a file in
   ``fortran_src/grounds/``, whose hash is in ``fortran_src/SOURCES.toml``.
3. If the row exchanges a pair of characters for the first time, add the pair to
   ``fortran_src/apparatus/confusables.toml`` (:mod:`modern.edition.readings`).
4. If a committed deck is built with the layer of the row, build the deck again and commit it: ``built(NAME).text()`` of
   :mod:`modern.edition.programs` returns its text.  For chapter 6, ``python -m modern.edition.chapter6_checks --write``
   writes the device files.  Read the differences.
5. Run ``hull1620 apparatus --program N --check`` and the tests in ``tests/modern/edition/``.
"""

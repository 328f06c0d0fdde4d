"""Pictures of hulls, of their construction and of punched cards, as the text of SVG files.

:mod:`~modern.drawing.draw` draws a hull. :mod:`~modern.drawing.view` chooses the direction of view and projects points,
:mod:`~modern.drawing.scene` and :mod:`~modern.drawing.visible` find the hidden edges, :mod:`~modern.drawing.layout`
converts positions to pixels, :mod:`~modern.drawing.labels` and :mod:`~modern.drawing.legend` place texts, and
:mod:`~modern.drawing.svg` writes SVG elements.
"""

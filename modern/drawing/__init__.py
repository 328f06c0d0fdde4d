"""Pictures of hulls, of their construction and of punched cards, as the text of SVG files.

:mod:`~modern.drawing.draw` draws a hull. It joins :mod:`~modern.drawing.view` (the direction of view),
:mod:`~modern.drawing.scene` and :mod:`~modern.drawing.visible` (hidden edges), :mod:`~modern.drawing.layout` (pixels),
:mod:`~modern.drawing.labels` and :mod:`~modern.drawing.legend`. :mod:`~modern.drawing.svg` writes the elements.
"""

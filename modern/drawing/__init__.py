"""Parts of ``modern.drawing.draw``: the direction of view, what is hidden, the places of labels, the SVG text."""

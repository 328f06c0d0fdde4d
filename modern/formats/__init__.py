"""The formats of files, a module for each: decks, CSV, OFF, OBJ, PLY, STL, JSON.

Here are their names only: the command line shows them in its help before it needs to read or write one.
"""

MESHES = ("off", "obj", "ply", "stl")
"""Formats of a surface: each is a module here with ``write(mesh, digits)``, and the ending of a file's name."""

HULLS = (*MESHES, "json", "html")
"""Formats of a hull: the surfaces, all of its data, and a page that turns it."""

POINTS = {
    "deck": "a data deck",
    "csv": "a list (x,y,z a line, or with blanks, tabs, semicolons)",
    "off": "OFF",
    "obj": "OBJ",
    "ply": "PLY",
    "stl": "STL",
    "json": "JSON",
    "npy": "NPY",
}
"""Formats points are read from, and what help calls them; each has a reader in modern/formats/points.py."""

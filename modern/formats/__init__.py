"""File formats of points and hulls, one module for each: decks, CSV, OFF, OBJ, PLY, STL, JSON, HTML.

This module only names the formats, so that the help of the commands can list them without importing their modules.

How to add a format in which hulls are written:

1. Write ``modern/formats/NAME.py`` with a function ``write(mesh, digits)`` that returns the text of the file
   (``off.py`` is a short example).
2. Add NAME to ``MESHES`` below.  ``export --format``, its help and ``Hull.save`` then know the format.  NAME is also
   the extension of the files.
3. Formats in ``MESHES`` are also read, so follow the two recipes below, too.  For a format that is only written, add
   NAME to ``HULLS`` instead, and a case to ``export_text`` in ``export.py``.

How to add a format from which points are read:

1. Write the reader in ``modern/formats/NAME.py``.  The reader returns the points as decimal text, and the position of
   each point in the file (for example its line).
2. Add NAME to ``POINTS`` below.
3. In ``points.py`` extend ``recognise`` so that it detects the beginning of such a file, and call the reader in
   ``parse_input``.  For a binary format extend ``_binary_kind`` and ``parse_bytes`` instead.  Every command that
   accepts points then accepts the format.

How to add a format from which faces are read (for ``hidden-line``, ``appel-will`` and scenes):

1. Add the format to those from which points are read, with a reader that returns a ``FileMesh`` (``tokens.py``).
2. Add NAME to ``MESHES`` below, because ``surface_kind`` in ``points.py`` recognises only these formats.  A format in
   ``MESHES`` is also offered for writing, so its module needs the function ``write`` of the first recipe.
3. Call the reader in ``parse_mesh`` in ``points.py``.
4. Name the format in the texts that list the formats of faces: the docstring and the message of ``parse_mesh``, the
   message in ``modern/digital/volumes.py``, and the help in ``modern/cli/shared/point_arguments.py``.

A format of voxels belongs to ``modern/digital/volumes.py`` (``nrrd.py`` there is an example).

Tests: ``tests/modern/formats/test_export.py`` reads written files back with separate readers.  ``test_points.py`` needs
a case for each kind of valid file and for each way in which a file can be invalid.  ``tests/modern/cli/
test_fuzz_readers.py`` damages files at random.  Documentation: ``docs/reference/files.md``.
"""

# Formats of a surface, written and read. Each name is both a module of this package and the extension of the files.
MESHES = ("off", "obj", "ply", "stl")

# Formats of a hull: its surface, its complete data (JSON), or a page on which it can be turned (HTML).
HULLS = (*MESHES, "json", "html")

# Formats from which points are read, each with its name in help and messages.  ``points.py`` calls their readers.
POINTS = {
    "deck": "a data deck",
    "csv": "a list of points (x,y,z on each line, or with blanks, tabs or semicolons)",
    "off": "OFF",
    "obj": "OBJ",
    "ply": "PLY",
    "stl": "STL",
    "json": "JSON",
    "npy": "NPY",
}

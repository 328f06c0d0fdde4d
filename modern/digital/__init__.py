"""Voxel solids: reading volumes from files, their exact digital hulls, and measures in physical coordinates.

:mod:`~modern.digital.solids` defines a volume and :mod:`~modern.digital.world` its position in physical coordinates.
:mod:`~modern.digital.volumes` reads files and :mod:`~modern.digital.scans` selects voxels by value.
:mod:`~modern.digital.hull` computes the digital hull with :mod:`~modern.digital.intervals`, and
:mod:`~modern.digital.measures` computes volumes and areas.

To add a file format:

1. Write a reader in a module of this package that returns a :class:`modern.digital.scans.Scan`: the values and their
   position. ``nrrd.py`` is an example. Raise VolumeError for invalid data, with a message that names the file and the
   place.
2. Call the reader in ``_parsed`` in ``volumes.py`` for files that begin with the first bytes of the format. If
   SimpleITK reads the format, add its file name extension to ``KINDS`` in ``itk.py`` instead. SimpleITK then reads the
   file, and no reader is needed.
3. To write the format, add its file name extension to ``ARRAYS`` and a case to ``write_array``, both in ``volumes.py``.
4. Test the reader with valid files in ``tests/modern/digital/test_volumes.py``, and with damaged files in
   ``test_damaged_volumes.py`` in the same folder.
5. Describe the format in ``docs/reference/files.md`` and ``docs/how-to/voxels.md``.
"""

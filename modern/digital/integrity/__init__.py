"""Checks of medical and microscopy files for damage, before SimpleITK reads them.

SimpleITK fills missing data with zeros or with uninitialised memory, and it ignores most checksums. Each module checks
one format against its definition: the header, the length of the data, and the checksum of compressed data. Data that
are compressed without a checksum (TIFF with LZW, DICOM with JPEG, and others) are rejected, because damage in them
cannot be recognised. :mod:`~modern.digital.integrity.streams` has the functions that the formats share.

Each check raises VolumeError with a one-line message, or returns the number of voxels along each axis, which ``itk.py``
compares with the array that SimpleITK returns. To check another format, write a module like ``tiff.py`` and call its
function in ``_checked`` of ``itk.py``.
"""

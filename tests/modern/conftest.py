"""Here so that the folders below find ``judged``, the families of point sets beside these tests."""

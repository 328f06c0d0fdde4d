"""The language: a source deck becomes object code.  Nothing here runs a program."""

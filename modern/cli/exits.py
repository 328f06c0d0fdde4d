"""Exit codes.

OK: the run ended normally.  DIFFERS: a program typed DATA NOT ACCEPTABLE or ERROR IN PROGRAM and stopped there, ran
into the statement limit or out of bounds, or a result differs.  BAD_INPUT: said in one line.
"""

OK, DIFFERS, BAD_INPUT = 0, 1, 2

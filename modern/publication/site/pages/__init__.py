"""The makers: a file here makes what ``:::{made} NAME ARGUMENT`` stands for (:mod:`modern.publication.site`)."""

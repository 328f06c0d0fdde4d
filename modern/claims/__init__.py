"""The register of statements of the five documents, and the functions that compute the verdict of each statement."""

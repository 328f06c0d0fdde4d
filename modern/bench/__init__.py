"""Speed of the engines beside each other and beside the same program through a Fortran compiler of today."""

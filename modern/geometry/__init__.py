"""The data of a hull, its surface as a mesh, and exact numbers and vectors."""

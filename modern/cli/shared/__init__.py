"""Functions and arguments that several commands use."""

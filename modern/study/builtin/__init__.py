"""The built-in studies, one module each.  :class:`modern.study.registry.Study` describes what a module defines."""

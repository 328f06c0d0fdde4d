"""The port as tests of its statuses call it: a refusal is a result like any other."""

from __future__ import annotations

from functools import partial

from modern import port

convex_hull = partial(port.convex_hull, on_refusal="return")

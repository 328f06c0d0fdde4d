"""The port's ``convex_hull`` with refusals returned as results, for tests of statuses."""

from functools import partial

from modern import port

convex_hull = partial(port.convex_hull, on_refusal="return")

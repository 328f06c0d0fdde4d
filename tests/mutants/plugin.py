"""A plugin of pytest for runs on mutants: quick tests first, no search for smaller examples, limits.

Loaded by ``-p tests.mutants.plugin`` and set up by the environment.  MUTANT_LOG names a file to write: the seconds of
each test, the files of the modules loaded, the processor time of the run.  MUTANT_ORDER names such a file, by which the
tests are ordered.  MUTANT_SECONDS limits the processor time and MUTANT_BYTES the memory, so that a mutant that loops or
grows without end is stopped, and a busy machine stops none.
"""

from __future__ import annotations

import json
import os
import resource
import sys
import time
from collections import defaultdict
from pathlib import Path

import pytest
from hypothesis import Phase, settings

_seconds: defaultdict[str, float] = defaultdict(float)

if _limit := int(os.environ.get("MUTANT_SECONDS", "0")):
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (_limit, _limit + 5))
if _bytes := int(os.environ.get("MUTANT_BYTES", "0")):
    resource.setrlimit(resource.RLIMIT_AS, (_bytes, _bytes))


def pytest_configure() -> None:
    """The profile of hypothesis that conftest.py has loaded, but ending at the first failure."""
    settings.register_profile(
        "mutants", settings(settings(), derandomize=True, database=None, phases=(Phase.explicit, Phase.generate))
    )
    settings.load_profile("mutants")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    if order := os.environ.get("MUTANT_ORDER"):
        seconds = json.loads(Path(order).read_text(encoding="utf-8"))["seconds"]
        items.sort(key=lambda item: seconds.get(item.nodeid, 0))


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    _seconds[report.nodeid] += report.duration


def pytest_sessionfinish() -> None:
    if log := os.environ.get("MUTANT_LOG"):
        files = sorted({file for module in list(sys.modules.values()) if (file := getattr(module, "__file__", None))})
        found = {"seconds": _seconds, "files": files, "processor": time.process_time()}
        Path(log).write_text(json.dumps(found), encoding="utf-8")

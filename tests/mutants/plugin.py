"""A plugin of pytest for runs on mutants: quick tests first, no search for smaller examples, limits.

``-p tests.mutants.plugin`` loads it, and the environment sets it up. MUTANT_LOG names a file for the seconds of each
test, the files of the loaded modules and the processor time. MUTANT_ORDER names such a file, whose times order the
tests. MUTANT_SECONDS limits the processor time and MUTANT_BYTES the memory, which stops a mutant that loops or grows
without end but not one on a busy machine.
"""

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
    """Change the profile of hypothesis so that it ends at the first failure."""
    phases = (Phase.explicit, Phase.generate)
    settings.register_profile("mutants", settings(settings(), derandomize=True, database=None, phases=phases))
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
        document = {"seconds": _seconds, "files": files, "processor": time.process_time()}
        Path(log).write_text(json.dumps(document), encoding="utf-8")

"""Profiles of hypothesis, the locale, and the settings of the garbage collector for all tests.

The profile ``ci`` always draws the same examples, ``dev`` new ones each time; the variable ``CI`` selects it.
"""

import gc
import locale
import os
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

_CALM = (HealthCheck.too_slow, HealthCheck.function_scoped_fixture)

settings.register_profile("ci", derandomize=True, max_examples=60, deadline=None, suppress_health_check=_CALM)
settings.register_profile("dev", max_examples=60, deadline=None, suppress_health_check=_CALM)
settings.load_profile("ci" if os.environ.get("CI") else "dev")

# With the default thresholds, a quarter of the processor time would be spent on the garbage collector, because the
# collected tests and the modules are millions of objects that it visits again and again.
gc.set_threshold(50_000, 20, 50)


LONGEST = (
    "test_console_",
    "test_documents",
    "test_site_browser",
    "test_site_layout",
    "test_site.py",
    "test_cli_operator",
)
"""The beginnings of the names of the files whose tests take longest."""


def _rank(name: str) -> int:
    return next((rank for rank, beginning in enumerate(LONGEST) if f"/{beginning}" in name), len(LONGEST))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Run the longest files first: a worker that starts with one at the end would work long after the others."""
    items.sort(key=lambda item: _rank(item.nodeid))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Give each file to one worker, which then makes the fixtures and caches of the file only once.

    The three files on the page of the emulator share one worker, because starting the emulator takes ten seconds.
    """
    from xdist.scheduler import LoadScopeScheduling

    class ByFile(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return "console" if "/test_console_" in nodeid else nodeid.partition("::")[0]

    return ByFile(config, log)


def pytest_collection_finish() -> None:
    """Exclude all objects that exist after the collection from the garbage collector."""
    gc.collect()
    gc.freeze()


@pytest.fixture(autouse=True)
def _locale() -> Iterator[None]:
    """Restore the locale, because SimpleITK sets that of the process to C when it writes DICOM."""
    previous = locale.setlocale(locale.LC_ALL)
    yield
    if locale.setlocale(locale.LC_ALL) != previous:
        locale.setlocale(locale.LC_ALL, previous)

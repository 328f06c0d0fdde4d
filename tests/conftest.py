"""Profiles of hypothesis, the locale, and the settings of the garbage collector for all tests.

The profile ``ci`` always draws the same examples, ``dev`` new ones each time; the variable ``CI`` selects it.
"""

import gc
import locale
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from tests.support import editions

_CALM = (HealthCheck.too_slow, HealthCheck.function_scoped_fixture)

settings.register_profile("ci", derandomize=True, max_examples=60, deadline=None, suppress_health_check=_CALM)
settings.register_profile("dev", max_examples=60, deadline=None, suppress_health_check=_CALM)
settings.load_profile("ci" if os.environ.get("CI") else "dev")

# With the default thresholds, a quarter of the processor time would be spent on the garbage collector, because the
# collected tests and the modules are millions of objects that it visits again and again.
gc.set_threshold(50_000, 20, 50)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Run the documents first: a worker that starts with one of them at the end would work long after the others."""
    items.sort(key=lambda item: "test_the_blocks_of_a_document_run" not in item.name)


def pytest_collection_finish() -> None:
    """Exclude all objects that exist after the collection from the garbage collector."""
    gc.collect()
    gc.freeze()


def _worker(config: pytest.Config) -> str:
    """Return the name of this worker, or "" if one process runs all tests; the plugin xdist need not be loaded."""
    return str(getattr(config, "workerinput", {}).get("workerid", ""))


@pytest.fixture(scope="session")
def shared(tmp_path_factory, pytestconfig: pytest.Config) -> Path:
    """Return a folder that all workers of the test session share."""
    base = tmp_path_factory.getbasetemp()
    return base.parent if _worker(pytestconfig) else base


@pytest.fixture(scope="session", autouse=True)
def _site(request: pytest.FixtureRequest, shared: Path) -> Iterator[None]:
    """Start to build the site in the background, if tests of several workers will need it."""
    needs_site = any("site" in getattr(item, "fixturenames", ()) for item in request.session.items)
    if _worker(request.config) != "gw0" or not needs_site:
        yield
        return
    process = editions.begin(shared)
    yield
    process.wait()


@pytest.fixture(autouse=True)
def _locale() -> Iterator[None]:
    """Restore the locale, because SimpleITK sets that of the process to C when it writes DICOM."""
    previous = locale.setlocale(locale.LC_ALL)
    yield
    if locale.setlocale(locale.LC_ALL) != previous:
        locale.setlocale(locale.LC_ALL, previous)

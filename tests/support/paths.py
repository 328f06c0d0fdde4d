"""The paths of the data of the tests."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
DATA = ROOT / "tests" / "data"
MACHINE_RUNS = DATA / "machine_runs"
PROGRAMS = DATA / "programs"
VECTORS = DATA / "vectors"
PUBLISHED = VECTORS / "published"

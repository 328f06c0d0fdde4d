"""The lock files pin every dependency of ``pyproject.toml`` at an allowed version, with hashes and without a host."""

import re
import tomllib
from collections.abc import Iterable
from itertools import pairwise

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.support.paths import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
EXTRAS = PROJECT["project"]["optional-dependencies"]
REQUIREMENTS = {
    "run": (*PROJECT["project"]["dependencies"], *PROJECT["build-system"]["requires"]),
    "dev": (*PROJECT["project"]["dependencies"], *(line for lines in EXTRAS.values() for line in lines)),
}


def unmet(lock: str, requirements: Iterable[str]) -> list[str]:
    """Return the requirements that no version in the lock file satisfies."""
    pins = [Requirement(line.rstrip("\\ ")) for line in lock.splitlines() if re.match(r"[a-zA-Z0-9]", line)]
    versions = {canonicalize_name(pin.name): str(pin.specifier).removeprefix("==") for pin in pins}
    return [
        str(requirement)
        for requirement in map(Requirement, requirements)
        if requirement.name != PROJECT["project"]["name"]
        and versions.get(canonicalize_name(requirement.name), "0") not in requirement.specifier
    ]


@pytest.mark.parametrize("name", ["run", "dev"])
def test_the_lock_satisfies_every_requirement(name: str) -> None:
    assert unmet((ROOT / "locks" / f"{name}.lock").read_text(encoding="utf-8"), REQUIREMENTS[name]) == []


@pytest.mark.parametrize("name", ["run", "dev"])
def test_every_line_is_a_pinned_version_or_a_hash(name: str) -> None:
    lines = (ROOT / "locks" / f"{name}.lock").read_text(encoding="utf-8").splitlines()
    pin = re.compile(r"[a-z0-9-]+(\[[a-z0-9,-]+\])?==[0-9][0-9a-z.]*( ; [^/@]+?)? \\")
    digest = re.compile(r"    --hash=sha256:[0-9a-f]{64}( \\)?")
    assert [line for line in lines if not pin.fullmatch(line) and not digest.fullmatch(line)] == []
    assert all(digest.fullmatch(after) for line, after in pairwise(lines) if pin.fullmatch(line))


def test_unsatisfied_requirements_and_other_build_tools_are_reported() -> None:
    build_tools = (ROOT / "locks" / "build.in").read_text(encoding="utf-8").split()
    assert build_tools == PROJECT["build-system"]["requires"]
    lock = "lark==1.1.0 \\\n    --hash=sha256:00\n"
    assert unmet(lock, ["lark>=1.1.9", "mpmath>=1.3", "hull1620[fast]"]) == ["lark>=1.1.9", "mpmath>=1.3"]
    assert unmet(lock, ["lark>=1.0"]) == []

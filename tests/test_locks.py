"""The lock files hold what ``pyproject.toml`` asks for, in versions it allows, each with hashes and without a host."""

from __future__ import annotations

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
NEEDED = {
    "run": (*PROJECT["project"]["dependencies"], *PROJECT["build-system"]["requires"]),
    "dev": (*PROJECT["project"]["dependencies"], *(line for lines in EXTRAS.values() for line in lines)),
}


def unmet(lock: str, needed: Iterable[str]) -> list[str]:
    """The requirements that no version in the lock satisfies."""
    found = [Requirement(line.rstrip("\\ ")) for line in lock.splitlines() if re.match(r"[a-zA-Z0-9]", line)]
    held = {canonicalize_name(pin.name): str(pin.specifier).removeprefix("==") for pin in found}
    asked = [Requirement(line) for line in needed]
    own = PROJECT["project"]["name"]
    return [
        str(one) for one in asked if one.name != own and held.get(canonicalize_name(one.name), "0") not in one.specifier
    ]


@pytest.mark.parametrize("name", ["run", "dev"])
def test_the_lock_holds_what_is_asked_for(name: str) -> None:
    assert unmet((ROOT / "locks" / f"{name}.lock").read_text(encoding="utf-8"), NEEDED[name]) == []


@pytest.mark.parametrize("name", ["run", "dev"])
def test_every_line_is_a_version_or_a_hash(name: str) -> None:
    lines = (ROOT / "locks" / f"{name}.lock").read_text(encoding="utf-8").splitlines()
    pin = re.compile(r"[a-z0-9-]+==[0-9][0-9a-z.]*( ; [^/@]+?)? \\")
    digest = re.compile(r"    --hash=sha256:[0-9a-f]{64}( \\)?")
    assert [line for line in lines if not pin.fullmatch(line) and not digest.fullmatch(line)] == []
    assert all(digest.fullmatch(after) for line, after in pairwise(lines) if pin.fullmatch(line))


def test_the_build_tools_are_those_of_the_project() -> None:
    written = (ROOT / "locks" / "build.in").read_text(encoding="utf-8").split()
    assert written == PROJECT["build-system"]["requires"]


def test_a_requirement_that_a_lock_does_not_hold_is_found() -> None:
    lock = "lark==1.1.0 \\\n    --hash=sha256:00\n"
    assert unmet(lock, ["lark>=1.1.9", "mpmath>=1.3", "hull1620[fast]"]) == ["lark>=1.1.9", "mpmath>=1.3"]
    assert unmet(lock, ["lark>=1.0"]) == []

"""A missing package gives a sentence with the command that brings it."""

import re
import sys
import tomllib
from pathlib import Path

import pytest

from relguide.planning.extras import EXTRAS, MissingExtra, add_command, need

PROJECT = tomllib.loads((Path(__file__).parents[3] / "pyproject.toml").read_text())["project"]
IMPORTED_AS = {"libasterix": "asterix", "quickjs_ng": "quickjs"}
"""Packages that are imported by another name."""


def _imported(requirement: str) -> str:
    name = re.split(r"[\[=><]", requirement)[0].replace("-", "_")
    return IMPORTED_AS.get(name, name)


BROUGHT = {
    extra: {_imported(line) for line in lines}
    for extra, lines in PROJECT["optional-dependencies"].items()
}


def test_each_package_is_brought_by_the_extra_named() -> None:
    for package, extra in EXTRAS.items():
        assert package in BROUGHT[extra], package


def test_each_package_brought_is_named() -> None:
    assert set.union(*(BROUGHT[extra] for extra in set(EXTRAS.values()))) == set(EXTRAS)


def test_the_core_is_numpy_numba_and_pydantic() -> None:
    core = {re.split(r"[\[=><]", line)[0] for line in PROJECT["dependencies"]}
    assert core == {"numba", "numpy", "pydantic"}


def test_make_run_brings_the_service_and_its_client() -> None:
    makefile = (Path(__file__).parents[3] / "Makefile").read_text()
    rule = re.search(r"^\.make/installed:.*?--editable '\.\[([a-z,]+)\]'", makefile, re.M | re.S)
    assert rule is not None
    assert set(rule[1].split(",")) == {"serve", "client"}


def test_what_is_there_is_no_matter() -> None:
    need("numpy", "numba")


def test_what_is_missing_is_named_with_its_command(monkeypatch: pytest.MonkeyPatch) -> None:
    class Blocker:
        @staticmethod
        def find_spec(name: str, path: object = None, target: object = None) -> None:
            if name in ("torch", "rich"):
                raise ModuleNotFoundError(name=name)

    for name in ("torch", "rich"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setattr(sys, "meta_path", [Blocker, *sys.meta_path])
    with pytest.raises(MissingExtra, match=r"torch, .*pip install 'relguide\[learn\]'"):
        need("numpy", "torch")
    with pytest.raises(MissingExtra, match=r"rich, .*pip install 'relguide\[learn\]'"):
        need("rich", extra="learn")
    with pytest.raises(MissingExtra, match=r"rich, .*pip install 'relguide\[serve\]'"):
        need("rich")


def test_an_import_that_fails_is_given_the_command() -> None:
    found = add_command(ModuleNotFoundError("No module named 'pyproj.x'", name="pyproj.x"))
    assert isinstance(found, MissingExtra)
    assert "pip install 'relguide[serve]'" in str(found)
    other = ModuleNotFoundError("No module named 'nothing'", name="nothing")
    assert add_command(other) is other
    assert add_command(found) is found

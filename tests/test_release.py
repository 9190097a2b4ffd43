"""A release says one version wherever it says one, and what it changes."""

import json
import re
import tomllib

import yaml

from relguide import __version__
from tests.pages import ROOT

CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text())
CHANGELOG = (ROOT / "CHANGELOG.md").read_text()


def test_the_version_is_one() -> None:
    lock = json.loads((ROOT / "web/package-lock.json").read_text())
    examples = (ROOT / "server/relguide_server/http/api_examples.json").read_text()
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    said = {
        project["version"],
        json.loads((ROOT / "web/package.json").read_text())["version"],
        lock["version"],
        lock["packages"][""]["version"],
        CITATION["version"],
        *re.findall(r'"(?:relguide_)?version": ?"(\d+\.\d+\.\d+)"', examples),
    }
    assert said == {__version__}
    minor = __version__.rpartition(".")[0]
    assert f"now {minor}.x," in (ROOT / "SECURITY.md").read_text()


def test_the_newest_release_comes_first_and_says_how_to_upgrade() -> None:
    releases = re.findall(r"^## (\d+)\.(\d+)\.(\d+) - (\S+)$", CHANGELOG, re.MULTILINE)
    numbers = [tuple(map(int, release[:3])) for release in releases]
    assert numbers == sorted(numbers, reverse=True)
    assert ".".join(map(str, numbers[0])) == __version__
    assert releases[0][3] == str(CITATION["date-released"])
    newest = CHANGELOG.split("\n## ")[1]
    assert "### When you upgrade" in newest


def test_a_citation_names_what_its_form_asks_for() -> None:
    assert {"cff-version", "message", "title", "authors", "version", "license"} <= set(CITATION)
    assert all("name" in author or "family-names" in author for author in CITATION["authors"])

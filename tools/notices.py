"""Write THIRD_PARTY_NOTICES.md anew: `python -m tools.notices`.

It reads what is installed: the distributions that `relguide[serve,atc]` brings, which the container
holds, and the packages that are bundled into the web page, which the wheel holds.
"""

import json
import re
import tomllib
from importlib.metadata import Distribution, distribution
from pathlib import Path
from textwrap import indent
from typing import NamedTuple

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[1]
NOTICES = ROOT / "THIRD_PARTY_NOTICES.md"
MODULES = ROOT / "web" / "node_modules"
HEAD = """# Third-party notices

relguide is licensed under Apache-2.0 (`LICENSE`). It is made with the work of others, whose
licences are named here. `python -m tools.notices` writes this file.
"""
PAGE = """
## In the web page

The page that the wheel and the container hold contains these packages, fonts included.
"""
EARTH = ROOT / "server" / "relguide_server" / "scene" / "earth.licence.txt"
GROUND = """
## On the ground of the 3D scene

`earth.npz` holds coast lines and airports; `tools/earth.py` makes it of these data.
"""
GUIDE = """
## In the guide

The guide that the wheel and the container hold is built by Zensical, whose scripts and styles are
in it, with icons of Lucide.
"""
PYTHON = """
## Beside it in Python

A wheel of relguide contains none of these: pip installs them as distributions of their own, each
with its licence in its `.dist-info` folder. The container holds them all, the client of the 3D
scene within viser, and also Python and Debian, whose licences lie in `/usr/share/doc` and
`/usr/local/lib/python3*/LICENSE.txt`.

| distribution | licence | home |
|---|---|---|
"""
LICENCES = {
    "Apache 2.0": "Apache-2.0",
    "Apache License 2.0": "Apache-2.0",
    "Apache Software License": "Apache-2.0",
    "BSD License": "BSD",
    "MIT License": "MIT",
    "The MIT License (MIT)": "MIT",
    "Mozilla Public License 2.0 (MPL 2.0)": "MPL-2.0",
    "Python Software Foundation License": "PSF-2.0",
}
"""How distributions write what SPDX calls otherwise."""
IMPORTED = re.compile(r"""(?:from|import) "([a-z@][^"]*)\"""")
"""A package that a file of the page imports, with the path in it."""


class Notice(NamedTuple):
    """Whose work something is, and under which licence it comes."""

    name: str
    licence: str
    home: str


def main() -> None:
    lines = [HEAD, PAGE]
    for notice in bundled_notices():
        shown = _quoted(MODULES / notice.name / "LICENSE")
        lines.append(f"\n### {notice.name}\n\n{notice.licence}, <{notice.home}>\n\n{shown}\n")
    lines += [GROUND, "\n", _quoted(EARTH), "\n"]
    lines.append(GUIDE)
    for name, licence, home, file in guide_notices():
        lines.append(f"\n### {name}\n\n{licence}, <{home}>\n\n{_quoted(file)}\n")
    lines.append(PYTHON)
    lines += [f"| {n.name} | {n.licence} | <{n.home}> |\n" for n in installed_notices()]
    NOTICES.write_text("".join(lines), "utf-8")


def _quoted(licence: Path) -> str:
    return indent(licence.read_text("utf-8").strip(), "    ", lambda line: bool(line.strip()))


def guide_notices() -> list[tuple[str, str, str, Path]]:
    """What the guide's site holds of others: name, licence, home, and the text of the licence."""
    about, home = distribution("zensical"), "https://zensical.org"
    templates = Path(str(about.locate_file("zensical/templates")))
    (own,) = [file for file in about.files or () if file.match("licenses/LICENSE.md")]
    return [
        ("zensical", "MIT", home, Path(str(about.locate_file(own)))),
        ("In its scripts", "As named", home, templates / "assets/javascripts/LICENSE"),
        ("lucide", "ISC", "https://lucide.dev", templates / ".icons/lucide/LICENSE"),
    ]


def installed_notices() -> list[Notice]:
    """The distributions that `relguide[serve,atc]` brings, by name."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = project["optional-dependencies"]
    waiting = [*project["dependencies"], *extras["serve"], *extras["atc"]]
    found: dict[str, Notice] = {}
    asked: set[tuple[str, str]] = set()
    while waiting:
        requirement = Requirement(waiting.pop())
        name = canonicalize_name(requirement.name)
        about = distribution(name)
        found[name] = _notice(about)
        for extra in ("", *requirement.extras):
            if (name, extra) not in asked:
                asked.add((name, extra))
                waiting += _requirements(about, extra)
    return [found[name] for name in sorted(found)]


def _requirements(about: Distribution, extra: str) -> list[str]:
    """What a distribution needs here, for one of its extras."""
    lines = [(line, Requirement(line).marker) for line in about.requires or ()]
    return [line for line, marker in lines if marker is None or marker.evaluate({"extra": extra})]


def _notice(about: Distribution) -> Notice:
    fields = about.metadata
    classes = [line.rpartition(" :: ")[2] for line in fields.get_all("Classifier", [])
               if line.startswith("License ::")]  # fmt: skip
    said = [
        fields.get("License-Expression", ""),
        *classes,
        fields.get("License", "").partition("\n")[0],
    ]
    licence = next(name for name in said if name and name != "OSI Approved")
    links = dict(line.split(", ", 1) for line in fields.get_all("Project-URL", []))
    home = next(
        (links[key] for key in links if key.lower() in ("homepage", "repository", "source")),
        fields.get("Home-page") or f"https://pypi.org/project/{fields['Name']}/",
    )
    return Notice(fields["Name"], LICENCES.get(licence, licence), home)


def imports_of_page() -> set[str]:
    """The packages that the page's own sources import."""
    sources = [*(ROOT / "web" / "src").rglob("*.ts"), *(ROOT / "web" / "src").rglob("*.tsx")]
    paths = {path for file in sources for path in IMPORTED.findall(file.read_text("utf-8"))}
    return {"/".join(path.split("/")[: 2 if path[0] == "@" else 1]) for path in paths}


def bundled_notices() -> list[Notice]:
    """The packages in the page and those that they need in turn, by name."""
    locked = json.loads((ROOT / "web" / "package-lock.json").read_text("utf-8"))["packages"]
    waiting, found = sorted(imports_of_page()), dict[str, Notice]()
    while waiting:
        name = waiting.pop()
        about = locked[f"node_modules/{name}"]
        home = f"https://www.npmjs.com/package/{name}"
        found[name] = Notice(name, about["license"], home)
        waiting += [other for other in about.get("dependencies", {}) if other not in found]
    return [found[name] for name in sorted(found)]


if __name__ == "__main__":
    main()

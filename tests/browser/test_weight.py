"""What a browser has to load before the cockpit stands: the scene's own page is not part of it."""

import gzip
import re
from pathlib import Path

from tests.browser.service import ROOT

MOST = 80_000
"""Of the scripts and styles that the page begins with, compressed as they are sent [bytes]."""
DIST = ROOT / "web" / "dist"
NAMED = re.compile(r"""(?:src|href)="\./(assets/[^"]+\.(?:js|css))\"""")
IMPORTED = re.compile(r"""(?:from|import)\s*["']\./([^"']+\.js)["']""")
"""What a script imports at once; `import(…)` comes later."""


def first_load() -> set[Path]:
    """What the page names, and all that is imported by that."""
    found: set[Path] = set()
    wanted = [DIST / name for name in NAMED.findall((DIST / "index.html").read_text())]
    while wanted:
        file = wanted.pop()
        if file in found:
            continue
        found.add(file)
        if file.suffix == ".js":
            wanted += [file.parent / name for name in IMPORTED.findall(file.read_text())]
    return found


def test_the_page_is_light() -> None:
    assets = first_load()
    assert len(assets) > 2
    assert sum(len(gzip.compress(each.read_bytes(), 9)) for each in assets) <= MOST


def test_charts_are_loaded_when_they_are_opened() -> None:
    charts = list(DIST.glob("assets/charts-*.js"))
    assert charts
    assert first_load().isdisjoint(charts)

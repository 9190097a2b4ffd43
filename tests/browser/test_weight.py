"""What a browser has to load before the cockpit stands, and before the controller's page does.

The scene follows at once; map, charts, records and help come when they are opened.
"""

import gzip
import re

import pytest

from tests.browser.service import ROOT

MOST = {"index.html": 80_000, "atc.html": 60_000}
"""Of all scripts and styles that a page names, compressed as they are sent [bytes]."""


@pytest.mark.parametrize("name", MOST)
def test_the_page_is_light(name: str) -> None:
    page = ROOT / "web" / "dist" / name
    named = set(re.findall(r'(?:src|href)="\./([^"]+\.(?:js|css))"', page.read_text("utf-8")))
    assert named
    assets = [(page.parent / each).read_bytes() for each in named]
    assert sum(len(gzip.compress(each, 9)) for each in assets) <= MOST[name]

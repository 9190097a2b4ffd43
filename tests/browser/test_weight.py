"""What a browser has to load before the cockpit stands.

The scene follows at once; map, charts, records and help come when they are opened.
"""

import gzip
import re

from tests.browser.service import ROOT

MOST = 80_000
"""Of all scripts and styles that the page names, compressed as they are sent [bytes]."""


def test_the_page_is_light() -> None:
    page = ROOT / "web" / "dist" / "index.html"
    named = set(re.findall(r'(?:src|href)="\./([^"]+\.(?:js|css))"', page.read_text("utf-8")))
    assert named
    assets = [(page.parent / each).read_bytes() for each in named]
    assert sum(len(gzip.compress(each, 9)) for each in assets) <= MOST

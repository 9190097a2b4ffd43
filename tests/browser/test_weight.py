"""What a browser has to load before the cockpit stands: the scene's own page is not part of it."""

import gzip

from tests.browser.service import ROOT

MOST = 80_000
"""Of all scripts and styles, compressed as they are sent [bytes]."""


def test_the_page_is_light() -> None:
    assets = [*ROOT.glob("web/dist/assets/*.js"), *ROOT.glob("web/dist/assets/*.css")]
    assert assets
    assert sum(len(gzip.compress(each.read_bytes(), 9)) for each in assets) <= MOST

"""The example page of the display as an element: from the disk, without a server."""

import gzip
import re

from playwright.sync_api import Page, expect

from tests.browser.service import ROOT

READ_T = "document.querySelector('relguide-nd').t"


def test_the_example_page_needs_no_server(page: Page) -> None:
    faults: list[str] = []
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.goto((ROOT / "examples" / "embed.html").as_uri())
    display = page.locator("relguide-nd [role=img]")
    expect(display).to_have_attribute("aria-label", re.compile("^Navigation display, ROSE"))
    expect(page.locator("#clock")).to_have_text("01:00")
    page.locator("#time").fill("200")
    assert page.evaluate(READ_T) == 200
    expect(page.locator("#clock")).to_have_text("03:20")
    page.locator("relguide-nd .nd-leader .nd-touch").click(force=True)
    expect(page.locator("#said")).to_have_text("LEADER was clicked, at 03:20.")
    page.locator("#arc").check()
    expect(display).to_have_attribute("aria-label", re.compile("^Navigation display, ARC"))
    page.locator("#paper").check()
    plan = "getComputedStyle(document.querySelector('relguide-nd')).getPropertyValue('--plan')"
    assert page.evaluate(plan) == "#0057b8"
    page.locator("#play").click()
    page.wait_for_function(f"{READ_T} > 210")
    assert faults == []


def test_it_is_light() -> None:
    element = (ROOT / "web" / "dist" / "embed" / "relguide-nd.js").read_bytes()
    assert len(gzip.compress(element, 9)) <= 45_000

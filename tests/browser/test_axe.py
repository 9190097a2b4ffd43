"""What axe-core finds wrong for those who listen, type, or see little: nothing, at any size."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.browser.service import Service, Watch

SIZES = [(1440, 900), (820, 1180), (390, 844)]
RULES = 30
"""At least so many rules find something to judge: else it was not looked at."""


@pytest.mark.parametrize("size", SIZES, ids=["desk", "tablet", "phone"])
def test_axe_finds_nothing(page: Page, watched: Watch, sky: Service, size: tuple[int, int]) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.goto(sky.url)
    expect(page.locator("g.nd-leader, g.nd-offscale").first).to_be_attached()
    judge(page, "off")
    page.keyboard.press("d")
    expect(page.locator(".nd-proposed")).to_be_attached()
    judge(page, "proposed")
    page.get_by_role("button", name="Help").click()
    judge(page, "help")
    page.keyboard.press("Escape")
    page.get_by_role("button", name="PLAN", exact=True).click()
    expect(page.locator(".plan-map .nd-proposed")).to_be_attached()
    judge(page, "map")
    assert watched.complaints == []


def judge(page: Page, state: str) -> None:
    # the scene's page is not ours
    found = Axe().run(page, options={"iframes": False}).response
    wrong = [f"{each['id']}: {each['nodes'][0]['html']}" for each in found["violations"]]
    assert wrong == [], state
    assert len(found["passes"]) >= RULES, state

"""A sky with others in it: laid out on the map by hand, planned around, flown, and read."""

import re

from playwright.sync_api import Page, expect

from tests.browser.service import Service, Watch

ALONE = "?plan=&own=-40000 20000 90 235 25&leader=0 0 90 200&distances=12000 9260"
AMID = f"{ALONE}&traffic=BAW12 60000 20000 270 230 - -&cell=CB1 -5000 22000 6000 0 0 0"


def test_others_are_laid_out_by_hand(sky: Service, page: Page, watched: Watch) -> None:
    page.goto(f"{sky.url}/{ALONE}")
    time_alone = page.locator(".plan .headline-figure")
    expect(time_alone).to_have_text(re.compile(r"\d\d:\d\d"))
    page.get_by_role("button", name="Add aircraft").click()
    page.get_by_role("button", name="Add cell").click()
    expect(page.locator(".plan-map .nd-weather")).to_have_count(1)
    grip = page.get_by_role("slider", name="TFC1: place")
    before = grip.get_attribute("aria-valuetext")
    box = grip.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2.0, box["y"] + box["height"] / 2.0
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 12.0, y - 50.0, steps=4)
    page.mouse.up()
    expect(grip).not_to_have_attribute("aria-valuetext", str(before))
    # the service plans around both, and says how near the path comes to each
    expect(page.locator(".other summary").first).to_contain_text(re.compile(r"NM at \d\d:\d\d"))
    page.keyboard.press("Control+z")
    expect(grip).to_have_attribute("aria-valuetext", str(before))
    page.get_by_role("slider", name="CB1: place").focus()
    page.keyboard.press("Delete")
    expect(page.locator(".plan-map .nd-weather")).to_have_count(0)
    assert watched.complaints == []


def test_a_flight_amid_others_shows_and_lists_them(
    sky: Service, page: Page, watched: Watch
) -> None:
    page.goto(f"{sky.url}/{AMID}")
    expect(page.locator(".plan")).to_contain_text("Nearest other")
    page.get_by_role("button", name="Fly it").first.click()
    other = page.locator('.nd-traffic[data-ident="BAW12"]')
    expect(other).to_be_visible()
    expect(page.locator(".nd-weather")).to_be_visible()
    panel = page.locator(".panel.traffic")
    row = panel.get_by_role("row").filter(has_text="BAW12")
    expect(row).to_contain_text("+00")
    row.get_by_role("button", name="BAW12").click()
    label = page.locator('.bezel .nd-label[data-element="traffic"]')
    expect(label).to_contain_text("CPA")
    page.keyboard.press("t")
    expect(label.filter(has_text="CPA")).to_have_count(0)
    # in the scene, the server draws them, and the page writes who they are
    expect(page.locator(".scene-writing")).to_contain_text("BAW12")
    assert watched.complaints == []

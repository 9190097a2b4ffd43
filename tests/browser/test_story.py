"""A crew in a real browser, from a situation of its own to the end of its flight."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.browser.service import Service, Watch
from tests.browser.test_map import drag


@pytest.fixture(autouse=True)
def _opened(page: Page, watched: Watch, sky: Service) -> None:
    page.goto(sky.url)
    expect(page.locator(".connection")).to_have_text("Live")
    expect(page.locator("g.nd-leader, g.nd-offscale").first).to_be_attached()


def test_a_crew_lays_out_flies_joins_loses_its_leader_and_disconnects(
    page: Page, watched: Watch
) -> None:
    """Drag, fly, accept, engage, leader turns, replan, capture, follow, lost, heard, disconnect."""
    state, line = page.locator(".mode-name"), page.locator(".nd-message")
    lateral, order = page.locator(".nd-fma text").nth(2), page.locator(".nd-atc")
    expect(state).to_have_text("Off")
    expect(lateral).to_have_text("HDG")
    page.get_by_role("button", name="PLAN", exact=True).click()
    page.get_by_role("button", name="Fig. 6b").click()
    expect(page.locator(".map-bench .headline-figure")).to_have_text("15:16")
    north = page.get_by_role("spinbutton", name="Own ship: north")
    before = north.input_value()
    drag(page, "own", by=(0.4, -0.4))
    expect(north).not_to_have_value(before)
    page.get_by_role("button", name="Fly it").click()
    expect(line).to_contain_text("CONV PROPOSED")
    expect(page.locator(".nd-proposed")).to_be_attached()
    page.get_by_role("button", name="Accept").click()
    expect(state).to_have_text("Armed")
    expect(order).to_have_text("VALIDATED AUTO")
    expect(page.locator(".nd-armed")).to_be_attached()
    page.get_by_role("button", name="Engage").click()
    expect(lateral).to_have_text("RG CNV")
    expect(page.get_by_test_id("announcer")).to_contain_text("Relative guidance engaged")
    wrong = Axe().run(page, options={"iframes": False}).response["violations"]
    assert [each["id"] for each in wrong] == []
    page.get_by_role("button", name="×60", exact=True).click()
    plans = page.locator(".log li.plan")
    before = plans.first.inner_text()
    page.get_by_role("spinbutton", name="Leader's heading").fill("100")
    page.get_by_role("spinbutton", name="Leader's heading").press("Enter")
    expect(page.locator(".log li.leader").first).to_be_visible()
    expect(plans.first).not_to_have_text(before)
    expect(page.locator(".log li.mode").filter(has_text="aptur")).not_to_have_count(0)
    expect(lateral).to_have_text("RG TRK")
    expect(page.locator(".log li").filter(has_text="SEPARATION")).to_have_count(0)
    page.get_by_role("button", name="lost", exact=True).click()
    expect(line).to_contain_text("LDR DATA LOST")
    expect(lateral).to_have_text("HDG")
    page.get_by_role("button", name="received", exact=True).click()
    expect(line).not_to_contain_text("LDR DATA LOST")
    page.keyboard.press("x")
    expect(state).to_have_text("Off")
    assert watched.complaints == []


def test_the_leader_is_designated_by_a_click_on_it(page: Page, watched: Watch) -> None:
    leader = page.locator(".nd-leader, .nd-offscale").first.bounding_box()
    assert leader is not None
    page.mouse.click(leader["x"] + leader["width"] / 2, leader["y"] + leader["height"] / 2)
    expect(page.locator(".nd-message")).to_contain_text("CONV PROPOSED")
    assert watched.complaints == []


def test_what_may_not_follow_is_refused_with_a_sentence(page: Page, watched: Watch) -> None:
    page.keyboard.press("e")
    expect(page.locator(".feedback.refused")).to_contain_text("designate the leader first")
    expect(page.locator(".mode-name")).to_have_text("Off")


def test_the_scene_shows_nothing_but_the_flight_and_obeys_the_pages_buttons(
    page: Page, watched: Watch
) -> None:
    expect(page.locator(".poster")).to_have_count(0, timeout=60_000)
    scene = page.locator("iframe").content_frame
    expect(scene.locator("[class*=Paper-root]:visible")).to_have_count(0)
    expect(scene.locator("[class*=Notification-root]:visible")).to_have_count(0)
    written = page.locator(".scene-writing .nd-label")
    expect(written.filter(has_text="PURSUER")).to_be_visible()
    expect(written.filter(has_text="LEADER")).to_be_visible()
    page.get_by_role("button", name="Top", exact=True).click()
    expect(page.get_by_role("button", name="Top", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )
    page.locator("iframe").hover()
    page.mouse.wheel(0, 200)
    expect(page.get_by_role("button", name="Free")).to_have_attribute("aria-pressed", "true")
    assert watched.complaints == []

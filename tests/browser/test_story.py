"""A crew in a real browser: designates, accepts, engages, loses its leader, disconnects."""

import pytest
from playwright.sync_api import Page, expect

from tests.browser.service import Service, Watch


@pytest.fixture(autouse=True)
def _opened(page: Page, watched: Watch, sky: Service) -> None:
    page.goto(sky.url)
    expect(page.locator(".connection")).to_have_text("Live")
    expect(page.locator("g.nd-leader, g.nd-offscale").first).to_be_attached()


def test_a_crew_engages_loses_the_leader_and_disconnects(page: Page, watched: Watch) -> None:
    state, line = page.locator(".mode-name"), page.locator(".nd-message")
    lateral = page.locator(".nd-fma text").nth(2)
    expect(state).to_have_text("Off")
    expect(lateral).to_have_text("HDG")
    leader = page.locator(".nd-leader, .nd-offscale").first.bounding_box()
    assert leader is not None
    page.mouse.click(leader["x"] + leader["width"] / 2, leader["y"] + leader["height"] / 2)
    expect(line).to_contain_text("CONV PROPOSED")
    expect(page.locator(".nd-proposed")).to_be_attached()
    page.get_by_role("button", name="Accept").click()
    expect(state).to_have_text("Armed")
    expect(page.locator(".nd-armed")).to_be_attached()
    page.get_by_role("button", name="Engage").click()
    expect(lateral).to_have_text("RG CNV")
    expect(page.locator(".log li.plan").first).to_be_visible()
    expect(page.get_by_test_id("announcer")).to_contain_text("Converge")
    page.get_by_role("button", name="×5", exact=True).click()
    page.get_by_role("button", name="lost", exact=True).click()
    expect(line).to_contain_text("LDR DATA LOST")
    expect(lateral).to_have_text("HDG")
    page.get_by_role("button", name="received", exact=True).click()
    expect(state).to_have_text("Proposed")
    page.keyboard.press("x")
    expect(state).to_have_text("Off")
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

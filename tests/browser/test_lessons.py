"""A lesson in a real browser, from card to mark: flown along the bar by a scripted stick."""

import re
from pathlib import Path

from playwright.sync_api import Page, expect

from tests.browser.service import Service, Watch

PILOT = (Path(__file__).parent / "pilot.js").read_text()
"""A controller that follows the bar, in place of the browser's own."""
CUT = (Path(__file__).parent / "cut.js").read_text()
"""Lists everything on the page that does not fit where it stands."""
KEPT = "localStorage.getItem('relguide.lessons')"


def test_a_lesson_is_flown_from_its_card_to_its_mark(
    page: Page, watched: Watch, sky: Service
) -> None:
    page.add_init_script(PILOT)
    page.route("**/scene/**", lambda route: route.abort())
    page.goto(sky.url)
    page.get_by_role("button", name="Help").click()
    page.get_by_role("button", name="Follow the bar").click()
    card = page.get_by_role("complementary", name="Lesson: Follow the bar")
    begin = card.get_by_role("button", name="Take control")
    expect(begin).to_be_focused()
    expect(page.locator(".sim-state")).to_have_text("PAUSED")
    assert page.evaluate(CUT) == []
    page.keyboard.press("Enter")
    expect(card.locator(".done")).to_have_count(1)
    page.evaluate("pilot.follows = true")
    page.get_by_role("button", name="×5", exact=True).click()
    debrief = page.get_by_role("region", name="Debrief")
    expect(debrief).to_be_visible(timeout=90_000)
    expect(page.locator(".sim-state")).to_have_text("PAUSED")
    verdict = debrief.locator(".verdict")
    expect(verdict).to_contain_text(re.compile(r"Joined at 04:\d\d, .* the autopilot.* Mark [A-D]"))
    expect(debrief.locator(".debrief-path .fastest")).to_be_attached()
    expect(debrief).to_contain_text(re.compile(r"Within 2° of the bar\s*\d+ %"))
    expect(debrief).to_contain_text(re.compile(r"Least separation\s*5\.\d\d NM"))
    assert '"lesson_bar"' in page.evaluate(KEPT)
    page.set_viewport_size({"width": 1024, "height": 768})
    path, figures = (
        debrief.locator(each).bounding_box() for each in (".debrief-path", ".debrief-figures")
    )
    assert path is not None
    assert figures is not None
    assert path["x"] + path["width"] <= figures["x"]  # beside it, not under it
    debrief.get_by_role("button", name="Next: Converge without it").click()
    expect(page.get_by_role("complementary", name="Lesson: Converge without it")).to_be_visible()
    expect(debrief).to_have_count(0)
    assert [each for each in watched.complaints if "/scene/" not in each] == []

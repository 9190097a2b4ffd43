"""The cockpit in a real browser, served by the real service: what a person sees and does."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from time import monotonic
from urllib.request import Request, urlopen

import pytest
from playwright.sync_api import Page, Route, expect

from tests.browser.service import Service, Watch

CUT = (Path(__file__).parent / "cut.js").read_text()
"""Lists everything on the page that does not fit where it stands."""
COVERED = """() => [...document.querySelectorAll(".panel, .scene")].flatMap((panel) => {
  const buttons = [...panel.querySelectorAll("header button")]
    .map((each) => each.getBoundingClientRect());
  return buttons.flatMap((each, k) =>
    buttons.slice(k + 1).some(({ left }) => left < each.right - 1) ? [panel.innerText] : []);
})"""
"""Heads of panels in which a button covers the one after it."""
BOTTOM = "(element) => element.getBoundingClientRect().bottom"
"""Where an element ends, from the top of the window [px]."""
MOVED = 700
"""Long enough for a picture to have moved [ms]."""


@pytest.fixture(autouse=True)
def _opened(page: Page, watched: Watch, sky: Service) -> None:
    page.goto(f"{sky.url}/?engaged")
    expect(page.locator(".connection")).to_have_text("Live")
    expect(page.locator(".nd-map")).to_be_attached()


def test_both_pictures_fly(page: Page, watched: Watch) -> None:
    """The page that opens engaged flies Fig. 6b, on the ND and in the scene."""
    expect(page.get_by_role("combobox", name="Scenario")).to_have_value("fig_6b")
    assert changes(page, lambda: map_transform(page))
    scene = page.locator("iframe")
    expect(scene.content_frame.locator("canvas").first).to_be_visible()
    until(page, lambda: watched.frames["scene"] > 20, "the scene's socket brings the flight")
    before = watched.frames["scene"]
    until(page, lambda: watched.frames["scene"] > before + 10, "the scene goes on")
    # software WebGL: the first picture takes seconds
    picture = scene.screenshot()
    until(page, lambda: scene.screenshot() != picture, "the scene's picture changes")
    assert watched.complaints == []


def test_a_turn_of_the_leader_is_answered_by_a_new_plan(page: Page, watched: Watch) -> None:
    plans = page.locator(".log li.plan")
    expect(plans.first).to_be_visible()
    page.get_by_role("button", name="×1", exact=True).click()
    expect(page.locator(".sim-rate")).to_have_text("×1")
    before = plans.first.inner_text()
    heading = page.get_by_role("spinbutton", name="Leader's heading")
    heading.fill("180")
    heading.press("Enter")
    started = monotonic()
    until(page, lambda: plans.first.inner_text() != before, "a new plan within 2 s", seconds=2.0)
    assert monotonic() - started < 2.0
    expect(page.locator(".feedback")).to_contain_text("Leader to heading 180")
    expect(page.locator(".log li.leader").first).to_be_visible()
    assert watched.complaints == []


def test_pause_holds_the_picture_and_play_frees_it(page: Page, watched: Watch) -> None:
    page.get_by_role("button", name="Pause").click()
    expect(page.locator(".sim-state")).to_have_text("PAUSED")
    page.wait_for_timeout(300)
    held, time = map_transform(page), page.locator(".sim-time").inner_text()
    page.wait_for_timeout(MOVED)
    assert (map_transform(page), page.locator(".sim-time").inner_text()) == (held, time)
    expect(page.locator(".connection")).to_have_text("Live")  # paused is not old
    page.get_by_role("button", name="Play").click()
    expect(page.locator(".sim-state")).to_have_text("")
    assert changes(page, lambda: map_transform(page))
    assert watched.complaints == []


@pytest.mark.parametrize("mode", ["ROSE", "ARC"])
def test_mode_and_range_of_the_nd(page: Page, watched: Watch, mode: str) -> None:
    other = page.get_by_role("button", name="ARC" if mode == "ROSE" else "ROSE", exact=True)
    other.click()
    layers = page.locator(".nd-display .nd-rings")
    was = layers.inner_html()
    chosen = page.get_by_role("button", name=mode, exact=True)
    chosen.click()
    expect(chosen).to_have_attribute("aria-pressed", "true")
    expect(other).to_have_attribute("aria-pressed", "false")
    assert layers.inner_html() != was
    for nautical_miles in (10, 160):
        page.get_by_role("button", name=str(nautical_miles), exact=True).click()
        expect(layers).to_contain_text(str(nautical_miles // 2))
    assert watched.complaints == []


def test_intent_withdrawn_is_shown(page: Page, watched: Watch) -> None:
    shown = page.locator(".reading", has_text="Leader intent").locator(".figure")
    page.get_by_role("button", name="not known", exact=True).click()
    expect(shown).to_have_text("NO")
    page.get_by_role("button", name="known", exact=True).click()
    expect(shown).to_have_text("YES")
    assert watched.complaints == []


def test_another_scenario_starts_a_new_flight(page: Page, watched: Watch) -> None:
    first = page.url
    picker = page.get_by_role("combobox", name="Scenario")
    picker.select_option("fig_6a")
    expect(page).not_to_have_url(first)
    expect(picker).to_have_value("fig_6a")
    expect(page.locator(".connection")).to_have_text("Live")
    assert changes(page, lambda: map_transform(page))
    assert watched.complaints == []


@pytest.mark.parametrize(
    "size",
    [(1024, 768), (1280, 800), (1366, 768), (1440, 900), (1920, 1080)],
    ids=lambda size: f"{size[0]}x{size[1]}",
)
def test_nothing_is_cut(page: Page, watched: Watch, size: tuple[int, int]) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.wait_for_timeout(MOVED)
    assert page.evaluate(CUT) == []
    assert watched.complaints == []


@pytest.mark.parametrize("size", [(1024, 768), (1280, 800)], ids=["1024x768", "1280x800"])
def test_the_page_stands_still_under_the_flight_display(
    page: Page, watched: Watch, size: tuple[int, int]
) -> None:
    """Its panels are scrolled where they have no room, and nothing else."""
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.get_by_role("button", name="PFD", exact=True).click()
    expect(page.locator(".pfd-panel")).to_be_visible()
    assert page.evaluate("document.scrollingElement.scrollHeight") <= size[1]
    assert watched.complaints == []


def test_a_small_page_shows_the_aircraft_under_every_caption(page: Page, watched: Watch) -> None:
    """The captions of the first minute stand beside it, in the place of the events."""
    page.set_viewport_size({"width": 1024, "height": 768})
    caption = page.get_by_label("First steps").locator("b")
    for number, step in ((4, None), (5, "Next"), (1, "x"), (2, "d"), (3, "c")):
        if step == "Next":
            page.get_by_role("button", name=step).click()
        elif step is not None:
            page.keyboard.press(step)
        expect(caption).to_have_text(f"{number} of 5")
        table, body = page.locator(".states"), page.locator(".aircraft .panel-body")
        assert page.evaluate(BOTTOM, table.element_handle()) <= page.evaluate(
            BOTTOM, body.element_handle()
        )
    assert watched.complaints == []


@pytest.mark.parametrize("width", [1440, 1280, 1279, 1024])
def test_the_unit_of_ranges_stands_clear_of_them(page: Page, watched: Watch, width: int) -> None:
    page.set_viewport_size({"width": width, "height": 768})
    panel, last, unit = (
        page.locator(each).last.bounding_box()
        for each in (".efis", ".efis .ranges button", ".efis-unit")
    )
    assert panel is not None
    assert last is not None
    assert unit is not None
    assert last["x"] + last["width"] + 4.0 <= unit["x"]
    assert unit["x"] + unit["width"] + 4.0 <= panel["x"] + panel["width"]
    assert watched.complaints == []


def test_long_numbers_are_not_cut(page: Page, watched: Watch, sky: Service) -> None:
    """A leader that turns for hours is joined after hours and a thousand miles."""
    turns = [
        {"turn_to_heading_deg": 60, "direction": "right", "bank_deg": 2},
        {"turn_to_heading_deg": 90, "direction": "left", "bank_deg": 1},
    ]
    situation = {
        "pursuer": {
            "x_m": -3e5, "y_m": 2e5, "heading_deg": 90, "tas_mps": 240, "max_bank_deg": 30,
        },
        "leader": {"x_m": 0, "y_m": 0, "heading_deg": 90, "tas_mps": 234, "intent": turns},
        "slot_distance_m": 10_000,
        "min_separation_m": 9260,
    }  # fmt: skip
    body = json.dumps({"situation": situation}).encode()
    asked = Request(f"{sky.url}/api/v1/flights", body, {"Content-Type": "application/json"})
    with urlopen(asked) as answer:
        flight = json.load(answer)["id"]
    page.set_viewport_size({"width": 1024, "height": 768})
    page.goto(f"{sky.url}/?flight={flight}")
    expect(page.locator(".mode-name")).to_have_text("Converge")
    page.wait_for_timeout(MOVED)
    assert page.evaluate(CUT) == []
    assert watched.complaints == []


def test_what_is_not_available_says_why_in_help(page: Page, watched: Watch) -> None:
    def without_recordings(route: Route) -> None:
        answer = route.fetch()
        listed = answer.json()
        for each in listed["scenarios"]:
            if each["name"] == "recorded_leader":
                each |= {"available": False, "message": "It needs recorded flights."}
        route.fulfill(response=answer, json=listed)

    page.route("**/api/v1/scenarios", without_recordings)
    page.set_viewport_size({"width": 1024, "height": 768})
    page.reload()
    expect(page.locator("option", has_text="not available: see Help")).to_have_count(1)
    assert page.evaluate(CUT) == []
    page.keyboard.press("?")
    expect(page.get_by_text("It needs recorded flights.")).to_be_visible()
    assert watched.complaints == []


@pytest.mark.parametrize(
    "size", [(820, 1180), (390, 844), (720, 450)], ids=["tablet", "phone", "zoomed to 200 %"]
)
def test_any_screen_is_read_without_scrolling_sideways(
    page: Page, watched: Watch, size: tuple[int, int]
) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    expect(page.locator(".below .engage")).to_be_visible()
    wide = page.evaluate(
        """() => [...document.querySelectorAll("main *, header *")]
          .filter((each) => !each.closest("svg, iframe, .visually-hidden, .log, table"))
          .filter((each) => each.getBoundingClientRect().right > innerWidth + 1)
          .map((each) => `${each.tagName}.${each.className}`)"""
    )
    assert wide == []
    assert page.evaluate(COVERED) == []
    assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
    assert watched.complaints == []


def test_help_takes_the_focus_and_gives_it_back(page: Page, watched: Watch) -> None:
    button = page.get_by_role("button", name="Help")
    button.click()
    expect(page.get_by_role("dialog", name="Keys")).to_be_focused()
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(button).to_be_focused()
    assert watched.complaints == []


def test_the_api_has_its_page(page: Page, watched: Watch, service: Service) -> None:
    page.goto(f"{service.url}/docs")
    expect(page.get_by_text("/api/v1/plans", exact=True).first).to_be_visible()
    assert watched.complaints == []


def test_a_flight_that_was_removed_says_so(page: Page, service: Service) -> None:
    flight = re.search(r"flight=([\w-]+)", page.url)
    assert flight is not None
    address = f"{service.url}/api/v1/flights/{flight[1]}"
    with urlopen(Request(address, method="DELETE")) as answer:
        assert answer.status == 204
    expect(page.get_by_role("alert")).to_contain_text("over")
    page.get_by_role("button", name="Start a new flight").click()
    expect(page.locator(".connection")).to_have_text("Live")
    assert changes(page, lambda: map_transform(page))


def map_transform(page: Page) -> str:
    return page.locator(".nd-world").first.get_attribute("transform") or ""


def changes(page: Page, read: Callable[[], str]) -> bool:
    before = read()
    page.wait_for_timeout(MOVED)
    return read() != before


def until(page: Page, holds: Callable[[], bool], what: str, *, seconds: float = 30.0) -> None:
    give_up = monotonic() + seconds
    while not holds():
        assert monotonic() < give_up, f"not seen in {seconds:g} s: {what}"
        page.wait_for_timeout(50)

"""Time in a real browser: any instant of a flight, from the stream, the records or a file."""

import json
from pathlib import Path
from urllib.request import Request, urlopen

import pytest
from playwright.sync_api import Browser, Page, expect

from relguide.contract.recorder import record
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.planning.plan import plan
from tests.browser.service import Service, Watch

TURN = 819
"""When the leader of Fig. 6a begins to turn without a word [s]."""
PICTURE = "document.querySelector('.nd-display').innerHTML"


def begun(service: Service, rate: float = 60.0) -> str:
    """A flight of Fig. 6a, engaged, that has no viewer yet."""
    body = json.dumps({"scenario": "fig_6a", "rate": rate, "engagement": "engaged"}).encode()
    headers = {"Content-Type": "application/json"}
    with urlopen(Request(f"{service.url}/api/v1/flights", body, headers)) as answer:
        return str(json.load(answer)["id"])


def shown(page: Page, text: str) -> None:
    """The page stands at a flight time."""
    expect(page.locator(".sim-time")).to_have_text(text)


@pytest.fixture
def flown(page: Page, watched: Watch, sky: Service) -> str:
    """A flight on the page that has flown past the leader's turn."""
    flight = begun(sky)
    page.goto(f"{sky.url}/?flight={flight}")
    expect(page.locator(".connection")).to_have_text("Live")
    expect(page.locator(".timeline .mark.leader")).to_be_attached()
    return flight


def test_a_flight_is_looked_back_on_while_it_flies(page: Page, watched: Watch, flown: str) -> None:
    field = page.get_by_role("textbox", name="Flight time, mm:ss")
    field.fill("13:39")
    field.press("Enter")
    shown(page, "13:39")
    expect(page.locator(".timeline-edge")).to_contain_text("LIVE ▸")
    expect(page).to_have_url(f"{page.url.split('?')[0]}?flight={flown}&t={TURN}")
    held = page.evaluate(PICTURE)
    page.wait_for_timeout(700)
    assert page.evaluate(PICTURE) == held  # the flight flies on, the picture stands
    page.get_by_role("button", name="Disconnect").click()
    expect(page.locator(".feedback")).to_contain_text("behind the flight")
    page.get_by_role("slider", name="Flight time shown").focus()
    page.keyboard.press("ArrowRight")
    shown(page, "13:40")
    page.keyboard.press("l")
    expect(page.locator(".connection")).to_have_text("Live")
    assert watched.complaints == []


def test_a_link_shows_the_same_instant_in_another_tab(
    page: Page, browser: Browser, watched: Watch, flown: str
) -> None:
    address = page.url.split("?")[0]
    page.goto(f"{address}?flight={flown}&t={TURN + 6}&nd=ROSE&range=40")
    shown(page, "13:45")
    other = browser.new_page(viewport={"width": 1440, "height": 900})
    other.goto(page.url)
    expect(other.locator(".sim-time")).to_have_text("13:45")
    expect(other.locator(".nd-map")).to_be_attached()
    assert other.evaluate(PICTURE) == page.evaluate(PICTURE)
    other.close()
    assert watched.complaints == []


def test_a_flight_that_is_over_is_opened_from_the_records_and_going_back_shows_the_one_before(
    page: Page, watched: Watch, sky: Service, flown: str
) -> None:
    urlopen(Request(f"{sky.url}/api/v1/flights/{flown}", method="DELETE")).close()
    expect(page.locator(".timeline-edge")).to_have_text("FLIGHT OVER")
    expect(page.locator(".nd-map")).to_be_attached()  # it stays on show
    page.goto(f"{sky.url}/?engaged")
    expect(page.locator(".connection")).to_have_text("Live")
    before = page.url
    page.get_by_role("button", name="Records").click()
    page.get_by_role("searchbox").fill("6a")
    page.get_by_role("dialog").get_by_role("button", name="Fig. 6a").first.click()
    expect(page.locator(".connection")).to_have_text("Recorded")
    shown(page, "00:00")
    assert f"flight={flown}" in page.url
    page.go_back()
    expect(page.locator(".connection")).to_have_text("Live")
    assert page.url == before
    assert watched.complaints == []


def test_a_file_is_shown_and_a_broken_one_says_its_line(
    page: Page, watched: Watch, sky: Service, tmp_path: Path
) -> None:
    whole, cut = tmp_path / "flight.jsonl.gz", tmp_path / "cut.jsonl"
    for _ in record(fly(scenario("fig_6b"), plan), whole):
        pass
    page.goto(sky.url)
    expect(page.locator(".connection")).to_have_text("Live")
    page.get_by_role("button", name="Records").click()
    page.get_by_label("Open a recording").set_input_files(whole)
    expect(page.locator(".connection")).to_have_text("Recorded")
    page.get_by_role("slider", name="Flight time shown").press(".")
    cut.write_text('{"format":"relguide-flight","version":3}\n{"kind":"sample"\n')
    page.get_by_role("button", name="Records").click()
    page.get_by_label("Open a recording").set_input_files(cut)
    expect(page.locator(".feedback")).to_contain_text("line 2: it is no JSON")
    expect(page.locator(".connection")).to_have_text("Recorded")
    assert watched.complaints == []


def test_on_a_phone_a_finger_scrubs(browser: Browser, sky: Service) -> None:
    phone = browser.new_context(
        viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True
    )
    page = phone.new_page()
    page.goto(f"{sky.url}/?flight={begun(sky)}")
    expect(page.locator(".timeline .mark.leader")).to_be_attached()
    track = page.get_by_role("slider", name="Flight time shown")
    expect(track).to_be_in_viewport()
    box = track.bounding_box()
    assert box is not None
    page.touchscreen.tap(box["x"] + box["width"] * 0.3, box["y"] + box["height"] / 2)
    expect(page.locator(".timeline-edge")).to_contain_text("LIVE ▸")
    expect(page.get_by_role("combobox", name="Seconds of flight a second")).to_be_in_viewport()
    phone.close()

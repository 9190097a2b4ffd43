"""A crew flies by hand in the browser; its flight is flown again from its record, to the bit."""

import json
from pathlib import Path
from typing import Any
from urllib.request import Request, urlopen

import pytest
from playwright.sync_api import Browser, Page, WebSocket, expect

from relguide.contract.orders import commands_of, flown_again
from relguide.contract.recorder import replay
from relguide.contract.wire import to_wire
from relguide.flying.documents import Sample
from relguide.flying.flight import fly
from relguide.flying.orders import Stick
from relguide.flying.scenarios import scenario
from relguide.planning.plan import plan
from tests.browser.service import Service, Watch

PILOT = (Path(__file__).parent / "pilot.js").read_text()
"""A controller that follows the bar, in place of the browser's own."""
FOLLOWED = 40.0
"""So long a bar is followed [s of flight]."""

Heard = dict[float, dict[str, Any]]


@pytest.fixture
def heard(page: Page) -> Heard:
    """Every sample that the stream has brought, by flight time."""
    samples: Heard = {}

    def hear(frame: str | bytes) -> None:
        content = json.loads(frame)
        for each in content.get("documents", ()):
            if each["kind"] == "sample":
                samples[each["t_s"]] = each

    def opened(socket: WebSocket) -> None:
        if "/scene/" not in socket.url:
            socket.on("framereceived", hear)

    page.on("websocket", opened)
    return samples


@pytest.fixture
def flown(page: Page, sky: Service, heard: Heard) -> str:
    """The id of a flight of Fig. 6b, engaged at ×5, without the scene."""
    del heard  # listens from the start
    page.add_init_script(PILOT)
    page.route("**/scene/**", lambda route: route.abort())
    page.goto(f"{sky.url}/?engaged")
    expect(page.locator(".connection")).to_have_text("Live")
    page.get_by_role("button", name="×5", exact=True).click()
    expect(page.locator(".sim-rate")).to_have_text("×5")
    return flight_id(page)


def test_a_controller_follows_the_bar_and_the_flight_is_flown_again_to_the_bit(
    page: Page, watched: Watch, sky: Service, flown: str, heard: Heard, tmp_path: Path
) -> None:
    take_control(page)
    expect(page.locator(".panel.stick")).to_contain_text("Scripted stick")
    page.get_by_role("button", name="×2", exact=True).click()
    page.evaluate("pilot.stick = 0.7")
    bank_of(page, heard, 15.0)
    page.evaluate("pilot.follows = true")
    begun = max(heard)
    while max(heard) < begun + FOLLOWED:
        page.wait_for_timeout(200)
    late = [each for t, each in heard.items() if t > begun + FOLLOWED / 2]
    bars = [abs(bar["roll_deg"]) for each in late for bar in each["guidance"][0]["bars"]]
    assert sum(bars) / len(bars) < 2.0
    page.evaluate("pilot = { stick: 0, bar: 0 }")
    give_back(page)
    assert [each for each in watched.complaints if "/scene/" not in each] == []
    assert_flown_again(sky, flown, heard, tmp_path, sticks=20)


def test_the_keyboard_alone_flies(
    page: Page, sky: Service, flown: str, heard: Heard, tmp_path: Path
) -> None:
    take_control(page)
    page.keyboard.press("6")
    page.keyboard.press("6")
    expect(page.locator(".panel.stick")).to_contain_text("To 10 R of bank")
    bank_of(page, heard, 10.0)
    page.keyboard.press("5")
    bank_of(page, heard, 0.0)
    page.keyboard.down("ArrowLeft")
    bank_of(page, heard, -15.0)
    page.keyboard.up("ArrowLeft")
    page.keyboard.press("5")
    bank_of(page, heard, 0.0)
    give_back(page)
    assert_flown_again(sky, flown, heard, tmp_path, sticks=5)


def test_a_controller_unplugged_in_a_turn_stops_the_roll_and_flies_again_once_it_was_let_go(
    page: Page, flown: str, heard: Heard
) -> None:
    told = page.locator(".panel.stick [role=alert]")
    take_control(page)
    page.evaluate("pilot.stick = 0.4")
    bank_of(page, heard, 10.0)
    page.evaluate("pilot.unplugged = true")
    expect(told).to_have_text(
        "Scripted stick is gone: stick neutral. You have control, by keys and by this panel."
    )
    page.wait_for_timeout(1000)
    held = heard[max(heard)]["aircraft"][0]["bank_deg"]
    page.evaluate("pilot.unplugged = false")
    expect(told).to_have_text("Scripted stick is back: let go of its stick once, then it flies.")
    page.wait_for_timeout(1000)
    assert abs(heard[max(heard)]["aircraft"][0]["bank_deg"] - held) < 1.0
    page.evaluate("pilot.stick = 0")
    expect(told).to_have_text("Scripted stick flies again.")
    page.evaluate("pilot.stick = -0.4")
    bank_of(page, heard, -10.0)
    expect(told).to_have_text("")
    page.evaluate("pilot.stick = 0")
    give_back(page)


def test_one_page_has_control_and_whoever_closes_it_gives_it_back(
    browser: Browser, page: Page, sky: Service, flown: str
) -> None:
    take_control(page)
    other = browser.new_page()
    other.route("**/scene/**", lambda route: route.abort())
    other.goto(f"{sky.url}/?flight={flown}")
    expect(other.locator(".connection")).to_have_text("Live")
    other.keyboard.press("h")
    expect(other.locator(".feedback")).to_contain_text("REFUSED Another client has control")
    expect(other.locator(".panel.stick")).to_have_count(0)
    page.goto("about:blank")
    expect(other.locator(".log")).to_contain_text("The autopilot flies.")
    other.keyboard.press("h")
    expect(other.locator(".panel.stick")).to_be_visible()
    other.close()


def take_control(page: Page) -> None:
    page.keyboard.press("h")
    expect(page.locator(".panel.stick")).to_be_visible()
    expect(page.locator(".log")).to_contain_text("You have control.")


def give_back(page: Page) -> None:
    page.keyboard.press("h")
    expect(page.locator(".panel.stick")).to_have_count(0)
    expect(page.locator(".log")).to_contain_text("The autopilot flies.")


def bank_of(page: Page, heard: Heard, bank: float) -> None:
    """Wait until own ship banks so, or steeper to the same side; 0 is level [°]."""
    for _ in range(150):
        now = heard[max(heard)]["aircraft"][0]["bank_deg"]
        if abs(now) < 1.0 if bank == 0.0 else now / bank > 0.95:
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"The bank is {now:.1f}°, not {bank:g}°.")


def assert_flown_again(
    sky: Service, flight: str, heard: Heard, folder: Path, *, sticks: int
) -> None:
    """Each sample that the browser got is the one that the record's orders lead to."""
    file = folder / "flight.jsonl"
    urlopen(Request(f"{sky.url}/api/v1/flights/{flight}", method="DELETE")).close()
    with urlopen(f"{sky.url}/api/v1/records/flights/{flight}/export?format=jsonl") as answer:
        file.write_bytes(answer.read())
    orders, engagement, seed, *_ = flown_again(replay(file))
    assert sum(isinstance(order.command, Stick) for order in orders) >= sticks
    until = max(heard)
    again: Heard = {}
    commands = commands_of(orders)
    for document in fly(
        scenario("fig_6b"), plan, commands=commands, seed=seed, engagement=engagement
    ):
        if document.t > until:
            break
        if isinstance(document, Sample):
            again[document.t] = to_wire(document)
    assert len(heard) > 100
    assert [t for t, each in heard.items() if again[t] != each] == []


def flight_id(page: Page) -> str:
    found: str = page.evaluate("new URL(location.href).searchParams.get('flight')")
    return found

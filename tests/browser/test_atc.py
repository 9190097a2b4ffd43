"""The controller's page: five requests worked by keyboard alone; the past shown; axe-clean."""

import json
import re
import time
from collections.abc import Iterator
from urllib.request import Request, urlopen

import pytest
from playwright.sync_api import Download, Locator, Page, expect

from relguide.atc.clearances import OVER
from tests.browser.service import Service, Watch
from tests.browser.test_axe import SIZES, judge

ASKED = 60_000
"""Five flights are in the air and ask by then [ms]."""


@pytest.fixture
def asked(sky: Service, page: Page, watched: Watch) -> Iterator[Page]:
    """The page, with the demonstration begun by keyboard in a sky that is empty."""
    flights = f"{sky.url}/api/v1/flights"
    with urlopen(flights) as answer:
        flown = [flight["id"] for flight in json.load(answer)["flights"]]
    for flight in flown:
        urlopen(Request(f"{flights}/{flight}", method="DELETE")).close()
    wait_until_all_are_over(sky)
    page.goto(f"{sky.url}/atc")
    expect(page.locator(".atc-clock .link")).to_have_text("Live")
    page.get_by_role("button", name="Demo").focus()
    page.keyboard.press("Enter")
    yield page
    assert watched.complaints == []


def wait_until_all_are_over(sky: Service) -> None:
    """A request of a removed flight waits until the desk looks again."""
    until = time.monotonic() + ASKED / 1000.0
    while True:
        with urlopen(f"{sky.url}/api/v1/clearances") as answer:
            found = json.load(answer)["clearances"]
        if all(one["state"] in OVER for one in found):
            return
        assert time.monotonic() < until
        time.sleep(0.1)


def strip(page: Page) -> Locator:
    return page.locator(".atc-strip .headline .state")


def rows(page: Page, state: str) -> Locator:
    return page.get_by_role("option").filter(has_text=state)


def choose_waiting(page: Page) -> None:
    """Choose the next request that waits, as soon as there is one."""
    expect(rows(page, "REQUESTED").first).to_be_attached(timeout=ASKED)
    page.keyboard.press("n")
    expect(strip(page)).to_have_text("REQUESTED")
    expect(page.locator(".atc-strip")).to_contain_text("Automation advises")


def test_a_controller_works_five_requests_by_keyboard_alone(asked: Page) -> None:
    choose_waiting(asked)
    asked.keyboard.press("a")
    expect(strip(asked)).to_have_text("ACCEPTED")
    choose_waiting(asked)
    asked.keyboard.press("u")
    # the reason that automation finds, or the first, has the focus
    expect(asked.locator(".atc-reasons button:focus")).to_have_count(1)
    asked.keyboard.press("2")
    expect(strip(asked)).to_have_text("UNABLE")
    expect(asked.locator(".atc-strip .history")).to_contain_text("Due to airspace")
    choose_waiting(asked)
    asked.keyboard.press("s")
    expect(strip(asked)).to_have_text("STANDBY")
    asked.keyboard.press("a")
    expect(strip(asked)).to_have_text("ACCEPTED")
    choose_waiting(asked)
    asked.keyboard.press("p")
    expect(asked.locator(".tried")).to_contain_text(re.compile("ACCEPTABLE|UNABLE"))
    asked.keyboard.press("u")
    expect(asked.locator(".atc-reasons button:focus")).to_have_count(1)
    asked.keyboard.press("Enter")
    expect(strip(asked)).to_have_text("UNABLE")
    choose_waiting(asked)
    asked.keyboard.press("a")
    expect(strip(asked)).to_have_text("ACCEPTED")
    expect(asked.locator("[aria-live=polite]")).to_contain_text("accepted")
    # what was accepted cannot be told to stand by, and a sentence says so
    asked.keyboard.press("s")
    expect(asked.locator(".refused")).to_contain_text("cannot be told to stand by")
    asked.keyboard.press("Escape")
    expect(asked.get_by_role("option", selected=True)).to_have_count(0)


def test_the_sky_is_looked_at_from_all_sides(asked: Page) -> None:
    expect(rows(asked, "REQUESTED")).to_have_count(5, timeout=ASKED)
    choose_waiting(asked)
    # every aircraft has a label, the pair and the join, too, and none covers another
    expect(asked.locator(".atc-labels text[data-label]")).to_have_count(
        asked.locator(".atc-aircraft > [data-ident]").count() + 2
    )
    boxes = [each.bounding_box() for each in asked.locator(".atc-labels text").all()]
    for k, a in enumerate(boxes):
        for b in boxes[:k]:
            assert a is not None
            assert b is not None
            wide = min(a["x"] + a["width"], b["x"] + b["width"]) - max(a["x"], b["x"])
            high = min(a["y"] + a["height"], b["y"] + b["height"]) - max(a["y"], b["y"])
            assert wide < 2.0 or high < 4.0
    # a pair of CARD shows where and when on the map
    asked.keyboard.press("]")
    expect(asked.locator(".atc-labels text[data-label=pair]")).to_contain_text("MIN 5.0 NM")
    expect(asked.locator(".atc-pair .apart")).to_be_attached()
    asked.keyboard.press("r")
    for k in (0, 1):
        asked.locator(".atc-pair-tool select").nth(k).select_option(index=k + 1)
    expect(asked.locator(".atc-pair-tool [role=status]")).to_contain_text(
        re.compile(r"NM, bearing \d{3}°")
    )
    for width, height in SIZES:
        asked.set_viewport_size({"width": width, "height": height})
        judge(asked, f"a request at {width}")
    asked.set_viewport_size({"width": 1440, "height": 900})
    asked.keyboard.press("?")
    judge(asked, "keys")
    asked.keyboard.press("Escape")


def test_what_was_received_is_saved_and_shown_again(asked: Page) -> None:
    choose_waiting(asked)
    asked.keyboard.press("a")
    expect(strip(asked)).to_have_text("ACCEPTED")
    with asked.expect_download() as saving:
        asked.get_by_role("button", name="Save").click()
    saved: Download = saving.value
    asked.locator("input[type=file]").set_input_files(saved.path())
    expect(asked.locator(".atc-clock .link")).to_have_text("Recorded")
    asked.get_by_role("slider").fill("0")
    expect(rows(asked, "ACCEPTED")).to_have_count(0)
    asked.keyboard.press("l")
    expect(rows(asked, "ACCEPTED")).to_have_count(1)
    # the slider keeps its own arrows
    asked.get_by_role("listbox").focus()
    asked.keyboard.press("ArrowDown")
    expect(asked.locator(".atc-strip")).to_contain_text("This is a recording")
    judge(asked, "recorded")

"""The map in a real browser: a situation is laid out by hand and by key, taken along, and flown."""

import json
import re
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from statistics import median
from urllib.request import Request, urlopen

import pytest
from playwright.sync_api import Page, expect

from tests.browser.service import Service, Watch

CUT = (Path(__file__).parent / "cut.js").read_text()
"""Lists everything on the page that does not fit where it stands."""
LAG = (Path(__file__).parent / "lag.js").read_text()
"""Notes how long after a finger's move the plan and the area for it are painted."""
QUICK = 100.0
"""The plan follows the finger within this [ms], half of the time even on a busy machine."""
STEPS = 40


@pytest.fixture(autouse=True)
def _opened(page: Page, watched: Watch, sky: Service) -> None:
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.goto(f"{sky.url}/?plan")
    expect(page.locator(".plan-map .nd-proposed")).to_be_attached()
    expect(page.locator(".nd-area path").first).to_be_attached()


@pytest.mark.parametrize("handle", ["own", "own-heading", "leader", "slot"])
def test_the_plan_follows_the_finger(page: Page, watched: Watch, handle: str) -> None:
    page.evaluate(LAG)
    before = page.locator(".plan-map .nd-proposed").inner_html()
    drag(page, handle, by=(0.7, 0.9))
    expect(page.locator(".plan-map .nd-proposed")).to_be_attached()
    lags = page.evaluate("lags.plans")
    assert page.locator(".plan-map .nd-proposed").inner_html() != before
    assert median(lags) < QUICK
    assert watched.complaints == []


def test_keys_move_what_has_the_focus(page: Page, watched: Watch) -> None:
    north = page.get_by_role("spinbutton", name="Own ship: north")
    expect(north).to_have_value("21.6")
    page.get_by_role("slider", name="Own ship's place").focus()
    page.keyboard.press("ArrowUp")
    expect(north).to_have_value("22.6")
    page.keyboard.press("Shift+ArrowDown")
    expect(north).to_have_value("22.5")
    heading = page.get_by_role("spinbutton", name="Leader: heading")
    page.get_by_role("slider", name="Leader's heading").focus()
    page.keyboard.press("ArrowRight")
    expect(heading).to_have_value("95")
    assert watched.complaints == []


def test_a_situation_is_taken_along_as_link_request_and_program(
    page: Page, watched: Watch, service: Service
) -> None:
    drag(page, "own", by=(0.5, -0.4))
    page.wait_for_timeout(500)
    shown = page.locator(".map-bench .headline-figure").inner_text()

    def copied(kind: str) -> str:
        page.get_by_role("button", name=kind, exact=True).click()
        expect(page.locator(".take .feedback")).to_have_text(f"{kind} copied.")
        text: str = page.evaluate("navigator.clipboard.readText()")
        return text

    body = copied("REST").encode()
    asked = Request(f"{service.url}/api/v1/plans", body, {"content-type": "application/json"})
    with urlopen(asked) as answer:
        plan = json.load(answer)
    assert clock(plan["time_to_converge_s"]) == shown
    said = StringIO()
    with redirect_stdout(said):
        exec(copied("Python"), {})
    assert plan["word"] in said.getvalue()
    link = copied("Link")
    assert re.search(r"own=.*leader=.*distances=", link)
    page.goto(link)
    expect(page.locator(".map-bench .headline-figure")).to_have_text(shown)
    assert watched.complaints == []


def test_what_is_laid_out_is_flown(page: Page, watched: Watch) -> None:
    page.get_by_role("button", name="Beside").click()
    expect(page.locator(".map-bench .headline-figure")).to_have_text("02:37")
    page.get_by_role("button", name="Fly it").click()
    expect(page.get_by_role("button", name="ARC", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )
    expect(page.locator(".connection")).to_have_text("Live")
    expect(page.locator(".mode-name")).to_have_text("Proposed")
    expect(page).not_to_have_url(re.compile("own="))
    assert "flight=" in page.url
    page.get_by_role("button", name="PLAN", exact=True).click()
    page.get_by_role("button", name="From the flight").click()
    expect(page.get_by_role("spinbutton", name="Own ship: north")).to_have_value("12.0")
    assert watched.complaints == []


@pytest.mark.parametrize("size", [(1440, 900), (1280, 800), (1024, 768)])
def test_what_flies_it_is_in_sight(page: Page, watched: Watch, size: tuple[int, int]) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    expect(page.get_by_role("button", name="Fly it")).to_be_in_viewport(ratio=1)
    assert not [each for each in page.evaluate(CUT) if "loses" in each or "wide" in each]
    assert watched.complaints == []


def test_no_way_out_says_why(page: Page, watched: Watch) -> None:
    page.get_by_role("button", name="No way out").click()
    expect(page.locator(".plan-map .nd-message")).to_have_text("NO PLAN: SPEED")
    expect(page.locator(".map-bench .headline")).to_contain_text("kt")
    expect(page.locator(".plan-map .nd-proposed")).to_have_count(0)
    assert watched.complaints == []


def drag(page: Page, handle: str, *, by: tuple[float, float]) -> None:
    box = page.locator(f'.grip[data-handle="{handle}"]').bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, STEPS + 1):
        page.mouse.move(x + step * by[0], y + step * by[1])
        page.wait_for_timeout(25)
    page.mouse.up()
    page.wait_for_timeout(300)


def clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes:02d}:{rest:02d}"

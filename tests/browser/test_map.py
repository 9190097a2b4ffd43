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
    # the slot goes outward: inward, D ends at MIN after a few steps
    drag(page, handle, by=(-0.7, -0.9) if handle == "slot" else (0.7, 0.9))
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
    url = f"{service.url}/api/v1/plans?include=flown"
    with urlopen(Request(url, body, {"content-type": "application/json"})) as answer:
        plan = json.load(answer)
    assert clock(plan["flown"]["join_s"]) == shown
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
    page.get_by_role("button", name="Beside", exact=True).click()
    expect(page.locator(".map-bench .headline-figure")).to_have_text("03:02")
    expect(page.locator(".map-bench .headline-note")).to_have_text("ideal 02:37")
    expect(page.locator(".map-bench .why")).to_contain_text("flies LRL in place of RSL: 26 s more")
    page.get_by_role("button", name="Fly it").click()
    expect(page.get_by_role("button", name="ARC", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )
    expect(page.locator(".connection")).to_have_text("Live")
    expect(page.locator(".mode-name")).to_have_text("Proposed")
    expect(page).not_to_have_url(re.compile("own="))
    assert "flight=" in page.url
    # it waits, with the time that the map gave
    expect(page.locator(".headline-figure")).to_have_text("03:02")
    page.wait_for_timeout(2000)
    expect(page.locator(".headline-figure")).to_have_text("03:02")
    page.go_back()
    expect(page.locator(".map-bench .headline-figure")).to_have_text("03:02")
    assert "own=" in page.url
    page.go_forward()
    expect(page.locator(".mode-name")).to_have_text("Proposed")
    page.get_by_role("button", name="PLAN", exact=True).click()
    page.get_by_role("button", name="From the flight").click()
    page.get_by_role("button", name="Undo").click()
    expect(page.get_by_role("spinbutton", name="Own ship: north")).to_have_value("12.0")
    assert watched.complaints == []


def test_a_typed_mistake_is_refused_in_a_sentence_and_changes_nothing(
    page: Page, watched: Watch
) -> None:
    heading = page.get_by_role("spinbutton", name="Own ship: heading")
    refusal = page.locator(".refusal:visible")
    heading.press_sequentially("400")
    heading.fill("400")
    expect(refusal).to_have_text("400° is refused: 0 to 360° is right. 90° stays.")
    heading.blur()
    expect(heading).to_have_value("90")
    least = page.get_by_role("spinbutton", name="Minimum separation")
    least.fill("9")
    expect(refusal.nth(1)).to_contain_text("since MIN is no more than D. 5.0 NM stays.")
    least.fill("letters")
    expect(refusal.nth(1)).to_contain_text('"letters" is no number')
    least.blur()
    expect(least).to_have_value("5.0")
    heading.fill("120")
    expect(refusal.nth(1)).to_have_count(0)
    assert watched.complaints == []


def test_a_drag_is_one_step_to_be_taken_back(page: Page, watched: Watch) -> None:
    straight = page.get_by_role("spinbutton", name="Piece 1: straight for")
    expect(straight).to_have_value("820")
    drag(page, "turn", by=(-2.0, 0.0))
    expect(straight).not_to_have_value("820")
    dragged = straight.input_value()
    to = page.get_by_role("spinbutton", name="Piece 2: to heading")
    drag(page, "turn-heading", by=(0.0, -2.0))
    expect(to).not_to_have_value("135")
    page.keyboard.press("Control+z")
    expect(to).to_have_value("135")
    page.keyboard.press("Control+z")
    expect(straight).to_have_value("820")
    page.keyboard.press("Control+Shift+z")
    expect(straight).to_have_value(dragged)
    expect(page.get_by_role("button", name="Redo")).to_be_enabled()
    assert watched.complaints == []


@pytest.mark.parametrize(
    ("link", "sentence"),
    [
        ("own=-9900000+0+90+240+25", "Own ship: east -9,900 km is refused"),
        ("own=garbage", 'Own ship is "garbage", and 5 numbers are right.'),
        ("distances=9000+12000", "D is 4.9 NM, and no less than MIN, 6.5 NM, is right."),
    ],
)
def test_a_bad_link_says_what_is_wrong(page: Page, sky: Service, link: str, sentence: str) -> None:
    parts = {
        "own": "-40000+40000+90+240+25",
        "leader": "0+0+90+200",
        "distances": "10000+9260",
    }
    name, _, value = link.partition("=")
    query = "&".join(f"{key}={text}" for key, text in {**parts, name: value}.items())
    page.goto(f"{sky.url}/?plan&{query}")
    expect(page.locator(".map-notice")).to_contain_text(sentence)


def test_beyond_what_is_planned_no_area_is_asked_for(
    page: Page, watched: Watch, sky: Service
) -> None:
    place = "own=-900000+0+90+240+25&leader=-600000+0+90+150&distances=10000+9260"
    page.goto(f"{sky.url}/?plan&{place}")
    expect(page.locator(".plan-map .nd-proposed")).to_be_attached()
    for _ in range(4):
        page.get_by_role("button", name="Range outward").click()
    expect(page.get_by_text("AREA WITHIN 540 NM OF THE ORIGIN")).to_be_visible()
    page.wait_for_timeout(1000)
    assert watched.complaints == []


def test_a_phone_has_the_times_and_what_flies_it_under_the_map(page: Page, watched: Watch) -> None:
    page.set_viewport_size({"width": 390, "height": 844})
    page.get_by_role("button", name="A limit that binds").click()
    expect(page.locator(".fly-times b")).to_have_text("06:11")
    page.evaluate("scrollTo(0, 0)")
    expect(page.locator(".fly-bar .primary")).to_be_in_viewport(ratio=1)
    heights = page.locator(".map-bench .field input").evaluate_all(
        "all => all.map(each => each.offsetHeight)"
    )
    assert min(heights) >= 44
    sizes = page.locator(".plan-glass .nd-text").evaluate_all(
        "all => all.filter(e => e.textContent).map(e => parseFloat(getComputedStyle(e).fontSize)"
        " * e.ownerSVGElement.getScreenCTM().a)"
    )
    assert min(sizes) >= 11.0
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

"""Two flights beside each other: the paper's conclusion by one click, over time, and on paper."""

import re
from xml.etree import ElementTree

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from relguide.contract.flight_summary import figures, summarize
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.planning.plan import plan
from tests.browser.service import Service, Watch

NM = 1852.0
SVG = "{http://www.w3.org/2000/svg}"


def test_6a_beside_6b_is_one_click_and_says_what_the_command_says(
    page: Page, watched: Watch, sky: Service
) -> None:
    page.goto(sky.url)
    page.get_by_role("button", name="Fig. 6a beside 6b").click()
    table = page.locator(".panel.compare table")
    expect(table).to_be_visible()
    one, other = (
        figures(summarize(fly(scenario(name), plan, seed=0, sample_period=1.0)))
        for name in ("fig_6a", "fig_6b")
    )
    rows = table.locator("tbody tr")
    for number, (name, text) in enumerate(
        (
            ("join_time_s", lambda t: f"{int(t) // 60:02d}:{int(t) % 60:02d}"),
            ("track_nm", "{:.1f}".format),
            ("least_separation_m", lambda d: f"{d / NM:.2f}"),
            ("heading_swing_deg", "{:.0f}".format),
            ("bank_reversals", str),
            ("replans", str),
        )
    ):
        cells = rows.nth(number).locator("td")
        expect(cells.nth(0)).to_have_text(text(one[name]))
        expect(cells.nth(1)).to_have_text(text(other[name]))
    # both are there when the leader turns, the other one by its name
    expect(page.locator(".sim-time")).to_have_text("13:45")
    expect(page.locator(".nd-other")).to_be_attached()
    expect(page.locator(".nd-label[data-element=other]").first).to_contain_text("FIG 6B")
    assert "compare=scenario%3Afig_6a%2Cscenario%3Afig_6b" in page.url
    # by the join, the other one is shown 100 s earlier in its own time
    page.get_by_role("button", name="join", exact=True).click()
    expect(page.locator(".panel.compare")).to_contain_text("01:40 earlier")
    page.get_by_role("button", name="Close", exact=True).click()
    expect(page.locator(".nd-other")).to_have_count(0)
    assert watched.complaints == []


def test_charts_scrub_and_are_saved(page: Page, watched: Watch, sky: Service) -> None:
    page.goto(f"{sky.url}/?compare=scenario:fig_6a,scenario:fig_6b&t=845")
    expect(page.locator(".panel.compare table")).to_be_visible()
    page.get_by_role("button", name="Charts", exact=True).click()
    strips = page.get_by_role("slider", name="Flight time shown in the charts")
    expect(strips).to_have_attribute("aria-valuenow", "845")
    expect(page.locator(".chart-strip canvas")).to_have_count(11)  # seven, and four of optimality
    expect(page.locator(".chart-note")).to_contain_text("Exact plan")
    strips.press("ArrowRight")
    expect(strips).to_have_attribute("aria-valuenow", "846")
    box = page.locator(".chart-plot").first.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2 + 60, box["y"] + box["height"] / 2)
    page.mouse.up()
    expect(strips).not_to_have_attribute("aria-valuenow", "846")
    shown = strips.get_attribute("aria-valuetext")
    assert shown is not None
    expect(page.locator(".sim-time")).to_have_text(shown)
    with page.expect_download() as drawn:
        page.get_by_role("button", name="SVG").click()
    root = ElementTree.parse(drawn.value.path()).getroot()
    words = [text.text or "" for text in root.iter(f"{SVG}text")]
    assert any("Separation" in each for each in words)
    assert any("relguide" in each for each in words)
    with page.expect_download() as pictured:
        page.get_by_role("button", name="PNG").click()
    assert pictured.value.path().read_bytes().startswith(b"\x89PNG")
    assert re.fullmatch(r"relguide-fig_6a-\d{4}\.png", pictured.value.suggested_filename)
    wrong = Axe().run(page, options={"iframes": False}).response["violations"]
    assert [f"{each['id']}: {each['nodes'][0]['html']}" for each in wrong] == []
    assert watched.complaints == []


def test_what_cannot_be_compared_is_said(page: Page, sky: Service) -> None:
    page.goto(f"{sky.url}/?compare=scenario:fig_6c,scenario:fig_6b")
    expect(page.locator(".feedback")).to_contain_text("There is no scenario 'fig_6c'")
    expect(page.locator("g.nd-leader, g.nd-offscale").first).to_be_attached()

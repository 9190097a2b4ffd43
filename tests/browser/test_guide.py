"""The guide in a browser: linked where it is built, its search works, no other machine is asked."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, Route, expect
from relguide_server.http import guide
from relguide_server.http.pages import HELP

from tests.browser.service import Service, Watch
from tests.pages import build_site
from tests.server.serving import ideal_app, serve


def test_cockpit_guide_and_controller_lead_to_each_other(
    page: Page, watched: Watch, sky: Service
) -> None:
    """By keyboard; and where no guide is built there is no link to it."""
    said: dict[str, str] = {}

    def tell(route: Route) -> None:
        if route.request.method == "HEAD":
            route.fulfill(headers=said)
        else:
            route.continue_()

    page.route(f"{sky.url}/", tell)
    page.goto(sky.url)
    page.get_by_role("button", name="Help").click()
    expect(page.get_by_role("link", name="the service's interface")).to_be_visible()
    expect(page.get_by_role("link", name="The guide")).to_have_count(0)
    page.keyboard.press("Escape")
    said["Link"] = HELP["Link"]
    page.get_by_role("button", name="Help").click()
    expect(page.get_by_role("link", name="The guide")).to_have_attribute("href", "guide/")
    page.keyboard.press("Escape")
    page.get_by_role("link", name="ATC: the controller's page").press("Enter")
    expect(page).to_have_title("relguide ATC")
    page.get_by_role("link", name="Cockpit").press("Enter")
    expect(page).to_have_title("relguide cockpit")
    assert watched.complaints == []


def test_it_is_searched_without_another_machine(
    page: Page, watched: Watch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guide, "GUIDE_FOLDERS", (build_site(tmp_path),))
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    with serve(ideal_app()) as address:
        page.goto(f"http://{address}/guide/")
        page.get_by_role("link", name="tutorial", exact=True).first.click()
        expect(page.locator("h1")).to_contain_text("1. Plan")
        page.locator(".md-search__button").first.click()
        page.locator("dialog[open] input").fill("certificate")
        page.get_by_role("option", name=re.compile("certificate", re.IGNORECASE)).first.click()
        expect(page).to_have_url(re.compile("/guide/.*[?#]"))
        assert {url.split("/")[2] for url in asked if url.startswith("http")} == {address}
    assert watched.complaints == []

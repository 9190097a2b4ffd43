"""When the service goes, the page says so; it never shows the last number as if it were new."""

from pathlib import Path
from urllib.parse import urlsplit

from playwright.sync_api import Page, expect

from tests.browser.service import running_service


def test_the_service_dies_and_comes_back(page: Page, tmp_path: Path) -> None:
    with running_service(tmp_path) as service:
        page.goto(service.url)
        expect(page.locator(".connection")).to_have_text("Live")
        expect(page.locator(".nd-map")).to_be_attached()
        service.stop(at_once=True)
    expect(page.locator(".connection")).to_contain_text("Connection lost")
    expect(page.get_by_role("alert")).to_contain_text("connection to the server is lost")
    expect(page.locator(".nd-flag")).to_contain_text("LDR DATA")
    expect(page.locator(".nd-flag")).to_contain_text("MAP NOT AVAIL")
    expect(page.locator(".nd-map")).not_to_be_attached()

    with running_service(tmp_path, port=urlsplit(service.url).port):
        page.get_by_role("button", name="Start a new flight").click()  # the old one died with it
        expect(page.locator(".connection")).to_have_text("Live")
        expect(page.locator(".nd-map")).to_be_attached()

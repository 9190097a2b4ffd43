"""Take the pictures of docs/cockpit.md: `python -m tests.browser.steps FOLDER`.

A newcomer's first two minutes, done by hand and mouse as the page says; what goes wrong stops it.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Page, expect

from tests.browser.picture import hide_toasts, take_picture
from tests.browser.service import running_chromium, running_service
from tests.browser.test_map import drag

SMALL = 0.8
"""Pixels of a picture by those of the page."""
PATIENCE = 60_000
"""For the scene in software WebGL, and for a flight to join at ×60 [ms]."""


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as place, running_service(Path(place)) as service:
        with running_chromium() as browser:
            page = browser.new_page(
                viewport={"width": 1280, "height": 800}, device_scale_factor=SMALL
            )
            page.set_default_timeout(PATIENCE)
            expect.set_options(timeout=PATIENCE)
            page.goto(f"{service.url}/?plan")
            fly_an_encounter(page, folder)


def fly_an_encounter(page: Page, folder: Path) -> None:
    """Lay it out, fly it, accept, engage, follow; a picture of each."""
    expect(page.locator(".plan-map .nd-proposed")).to_be_attached()
    expect(page.locator(".nd-area path").first).to_be_attached()
    page.get_by_role("button", name="Overtaking").click()
    expect(page.locator(".plan-map .nd-proposed")).to_be_attached()
    drag(page, "own", by=(0.6, 0.8))
    drag(page, "own-heading", by=(0.3, 0.5))
    page.wait_for_timeout(1500)
    take_picture(page, folder / "1-lay-out.png")
    page.get_by_role("button", name="Fly it").click()
    expect(page.locator(".nd-message")).to_contain_text("CONV PROPOSED")
    expect(page.locator(".poster")).to_have_count(0)
    hide_toasts(page)
    page.wait_for_timeout(1500)
    take_picture(page, folder / "2-proposed.png")
    engage(page)
    expect(page.locator(".mode-name")).to_have_text("Converge")
    page.wait_for_timeout(3000)
    take_picture(page, folder / "3-engaged.png")
    page.get_by_role("button", name="×60", exact=True).click()
    expect(page.locator(".mode-name")).to_have_text("Follow")
    page.get_by_role("button", name="×1", exact=True).click()
    page.wait_for_timeout(3000)
    take_picture(page, folder / "4-following.png")


def engage(page: Page) -> None:
    """Accept and engage; a path that has become another one meanwhile is accepted again."""
    for _ in range(5):
        page.keyboard.press("c")
        expect(page.locator(".mode-name")).to_have_text("Armed")
        page.keyboard.press("e")
        page.wait_for_timeout(2500)
        if page.locator(".mode-name").inner_text() == "Converge":
            return


if __name__ == "__main__":
    main(Path(sys.argv[1]))

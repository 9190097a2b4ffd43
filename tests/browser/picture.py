"""Take the picture of the cockpit for the README: `python -m tests.browser.picture FILE`."""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image
from playwright.sync_api import Page, expect

from tests.browser.service import running_chromium, running_service

SIMULATED = "07:00"
"""The flight time shown: on its way, all turns still visible."""
RANGE = "80"
"""The ND's range [NM]: the whole plan is on it."""
SCENE_DRAWN = 15_000
"""Software WebGL takes this long to its first pictures [ms]."""


def main(file: Path) -> None:
    with TemporaryDirectory() as folder, running_service(Path(folder)) as service:
        with running_chromium() as browser:
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            page.goto(f"{service.url}/?engaged")
            expect(page.locator(".connection")).to_have_text("Live", timeout=20_000)
            page.get_by_role("button", name=RANGE, exact=True).click()
            fly_until(page, SIMULATED)
            hide_toasts(page)
            page.wait_for_timeout(SCENE_DRAWN)
            take_picture(page, file)


def take_picture(page: Page, file: Path) -> None:
    """A picture of the page in 256 colours: a third of the size, and no colour is another one."""
    page.screenshot(path=file)
    with Image.open(file) as taken:
        few = taken.convert("RGB").quantize(
            256, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE
        )
    few.save(file, optimize=True)


def fly_until(page: Page, time: str) -> None:
    """Fly on at ×10 until the simulated clock shows a time, then hold."""
    expect(page.locator(".sim-time")).to_contain_text(time[:-1], timeout=120_000)
    page.get_by_role("button", name="Pause").click()
    expect(page.locator(".sim-state")).to_have_text("PAUSED")


def hide_toasts(page: Page) -> None:
    """The scene warns that its WebGL is drawn in software; a reader's is not."""
    frame = page.locator("iframe").content_frame
    frame.locator("body").evaluate(
        """body => {
          const style = document.createElement("style");
          style.textContent = "[class*=Notification] { display: none !important }";
          body.append(style);
        }"""
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))

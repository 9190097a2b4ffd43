"""Take the pictures of both pages: `python -m tests.browser.picture STILL.png MOVING.webp ATC.png`.

The moving one is the README's: the paper's Fig. 6b from engagement until it is joined. The last is
the controller's page with its demonstration.
"""

import io
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
FRAMES = 48
"""Of the moving picture."""
FRAME_APART = 20.0
"""Flight time between two of them [s]."""
FRAME_SHOWN = 160
"""How long each is seen, and the last one ten times as long [ms]."""
SMALL = (1008, 630)
"""Size of the moving picture [px]."""
QUALITY = 45
"""Of its compression: numbers can still be read."""


def main(still: Path, moving: Path, controller: Path) -> None:
    with TemporaryDirectory() as folder, running_service(Path(folder)) as service:
        with running_chromium() as browser:
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            page.goto(f"{service.url}/?engaged")
            expect(page.locator(".connection")).to_have_text("Live", timeout=20_000)
            page.get_by_role("button", name=RANGE, exact=True).click()
            fly_until(page, SIMULATED)
            hide_toasts(page)
            page.wait_for_timeout(SCENE_DRAWN)
            take_picture(page, still)
            take_film(page, service.url, moving)
            take_controller(page, service.url, controller)


def take_controller(page: Page, url: str, file: Path) -> None:
    """Five requests: one accepted, one chosen that comes too near to another."""
    page.goto(f"{url}/atc")
    page.get_by_role("button", name="Demo").click()
    requests = page.get_by_role("option")
    expect(requests).to_have_count(5, timeout=60_000)
    expect(requests.filter(has_text="UNABLE")).to_have_count(1)
    page.keyboard.press("n")
    page.keyboard.press("a")
    expect(requests.filter(has_text="ACCEPTED")).to_have_count(1)
    requests.filter(has_text="UNABLE").click()
    page.locator(".atc-clock").click()
    page.wait_for_timeout(12_000)  # dots behind all aircraft
    take_picture(page, file)


def take_film(page: Page, url: str, file: Path) -> None:
    """A whole flight in some seconds, as animated WebP."""
    page.goto(f"{url}/?engaged")
    expect(page.locator(".connection")).to_have_text("Live", timeout=20_000)
    page.get_by_role("button", name=RANGE, exact=True).click()
    page.get_by_role("button", name="Pause").click()
    expect(page.locator(".sim-state")).to_have_text("PAUSED")
    hide_toasts(page)
    page.wait_for_timeout(SCENE_DRAWN)
    page.get_by_role("button", name="Play").click()
    frames = []
    for number in range(FRAMES):
        page.wait_for_function(FLOWN, arg=number * FRAME_APART, timeout=120_000)
        with Image.open(io.BytesIO(page.screenshot())) as taken:
            frames.append(taken.convert("RGB").resize(SMALL, Image.Resampling.LANCZOS))
    shown = [FRAME_SHOWN] * (FRAMES - 1) + [10 * FRAME_SHOWN]
    first, *others = frames
    first.save(
        file, save_all=True, append_images=others, duration=shown, loop=0, quality=QUALITY, method=6
    )


FLOWN = """t => {
  const [minutes, seconds] = document.querySelector(".sim-time").textContent.split(":").map(Number);
  return 60 * minutes + seconds >= t;
}"""
"""Whether the simulated clock shows a time [s] or a later one."""


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
    main(*map(Path, sys.argv[1:4]))

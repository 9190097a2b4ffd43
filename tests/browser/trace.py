"""What the cockpit costs the browser at ×1: `python -m tests.browser.trace [SECONDS]`.

The page's main thread is watched while a flight converges, without the scene beside it and with; a
layout is counted wherever the browser had to find places anew.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Page, expect

from tests.browser.service import running_chromium, running_service

SETTLED = 15_000
"""The first pictures are past [ms]."""


def main(seconds: int) -> None:
    with TemporaryDirectory() as folder, running_service(Path(folder)) as service:
        with running_chromium() as browser:
            for scene in (False, True):
                page = browser.new_page(viewport={"width": 1440, "height": 900})
                if not scene:
                    page.route("**/scene/**", lambda route: route.abort())
                page.goto(f"{service.url}/?engaged")
                page.get_by_role("button", name="×1", exact=True).click()
                expect(page.locator(".sim-rate")).to_have_text("×1")
                page.wait_for_timeout(SETTLED)
                said = f"{'with' if scene else 'without'} the scene: {cost(page, seconds)}\n"
                sys.stdout.write(said)
                page.close()


def cost(page: Page, seconds: int) -> str:
    """Share of a core on the main thread, frames, and layouts, in so many seconds."""
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable")
    page.evaluate(
        "() => { window.frames60 = 0; const f = () => { frames60 += 1; requestAnimationFrame(f); };"
        " requestAnimationFrame(f); }"
    )

    def read() -> dict[str, float]:
        metrics = session.send("Performance.getMetrics")["metrics"]
        return {each["name"]: each["value"] for each in metrics}

    before, first = read(), page.evaluate("frames60")
    page.wait_for_timeout(1000 * seconds)
    after, last = read(), page.evaluate("frames60")
    took = after["Timestamp"] - before["Timestamp"]
    busy = 100.0 * (after["TaskDuration"] - before["TaskDuration"]) / took
    frames, layouts = last - first, after["LayoutCount"] - before["LayoutCount"]
    return f"{busy:.1f} % of a core, {frames} frames and {layouts:.0f} layouts in {took:.0f} s"


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 60)

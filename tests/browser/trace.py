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
PARTS = {
    "TaskDuration": "in all",
    "ScriptDuration": "scripts",
    "RecalcStyleDuration": "styles",
    "LayoutDuration": "layout",
}
"""What a browser tells apart."""
COUNT = """() => {
  window.pictures = 0;
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (draw) => { pictures += 1; return request(draw); };
}"""
"""Counts the pictures that the page asks for, and asks for none itself."""


def main(seconds: int) -> None:
    with TemporaryDirectory() as folder, running_service(Path(folder)) as service:
        with running_chromium() as browser:
            for scene in (False, True):
                page = browser.new_page(viewport={"width": 1440, "height": 900})
                if not scene:
                    page.route("**/scene/**", lambda route: route.abort())
                page.set_default_timeout(60_000)
                expect.set_options(timeout=60_000)
                page.goto(f"{service.url}/?engaged")
                expect(page.locator(".connection")).to_have_text("Live")
                page.get_by_role("button", name="×1", exact=True).click()
                expect(page.locator(".sim-rate")).to_have_text("×1")
                page.wait_for_timeout(SETTLED)
                said = f"{'with' if scene else 'without'} the scene: {cost(page, seconds)}\n"
                sys.stdout.write(said)
                page.close()


def cost(page: Page, seconds: int) -> str:
    """Share of a core on the main thread, pictures, and layouts, in so many seconds."""
    session = page.context.new_cdp_session(page)
    # its own time on the processor: what others take from it on a busy machine is not counted
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.evaluate(COUNT)

    def read() -> dict[str, float]:
        metrics = session.send("Performance.getMetrics")["metrics"]
        return {each["name"]: each["value"] for each in metrics}

    before, first = read(), page.evaluate("pictures")
    page.wait_for_timeout(1000 * seconds)
    after, last = read(), page.evaluate("pictures")
    pictures, layouts = last - first, after["LayoutCount"] - before["LayoutCount"]
    shares = ", ".join(
        f"{100.0 * (after[name] - before[name]) / seconds:.1f} % {said}"
        for name, said in PARTS.items()
    )
    return f"{shares} of a core; {pictures} pictures and {layouts:.0f} layouts in {seconds} s"


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 60)

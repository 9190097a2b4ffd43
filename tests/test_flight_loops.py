"""The loops of docs/flight.md: margins that are margins, and the loops that are flown."""

import re
from dataclasses import fields
from itertools import pairwise
from math import inf
from pathlib import Path

import numpy as np
import pytest
from control import StateSpace

from benchmarks.page import with_block
from benchmarks.tables import read_table
from relguide.flying.airframe import Airframe
from relguide.flying.guidance.settings import DEFAULT, Settings, load_settings
from relguide.kernels.base.turn import turn_rate
from relguide.units import DEG
from tools.campaign import pictures, report, responses
from tools.campaign.constants import FILE, constants_toml
from tools.campaign.loops import (
    FOLLOW_GAINS,
    PATH_GAINS,
    STEP,
    TICK,
    PathGains,
    heading_loop,
    margins,
    path_loop,
    roll_loop,
    straight_loop,
)
from tools.campaign.report import (
    AUTOPILOT,
    CAMPAIGN,
    FOLDER,
    LOOPS,
    PAGE,
    PATH,
    SHOWN,
)

ROOT = Path(__file__).parents[1]


def spectral_radius(loop: StateSpace, *, gain: float = 1.0, late: int = 0) -> float:
    """Of a loop that is closed with so much gain, so many samples late; stable below 1."""
    n = len(loop.A)
    whole = np.zeros((n + late, n + late))
    whole[:n, :n] = loop.A
    back = -gain * loop.C
    if late == 0:
        whole += loop.B @ back
    else:  # a chain of samples: what comes out of its end drives the loop
        whole[:n, -1:] = loop.B
        whole[n : n + 1, :n] = back
        for i in range(late - 1):
            whole[n + 1 + i, n + i] = 1.0
    return float(np.abs(np.linalg.eigvals(whole)).max())


@pytest.mark.parametrize("name", LOOPS)
def test_margins_are_where_the_closed_loop_becomes_unstable(name: str) -> None:
    loop = LOOPS[name](report.A306)
    found = margins(loop)
    assert spectral_radius(loop) < 1.0
    assert found.gain < inf
    assert spectral_radius(loop, gain=0.98 * found.gain) < 1.0
    assert spectral_radius(loop, gain=1.02 * found.gain) > 1.0
    samples = found.delay / loop.dt
    assert spectral_radius(loop, late=int(samples)) < 1.0
    assert spectral_radius(loop, late=int(samples) + 1) > 1.0
    assert found.phase > 45.0


@pytest.mark.parametrize("loop", [heading_loop, path_loop, straight_loop])
def test_margins_do_not_depend_on_the_speed(loop: object) -> None:
    assert callable(loop)
    slow, fast = margins(loop(tas=120.0)), margins(loop(tas=250.0))
    assert slow.phase == pytest.approx(fast.phase, abs=1e-6)
    assert slow.gain == pytest.approx(fast.gain, rel=1e-6)


def test_the_roll_loop_is_an_integrator() -> None:
    # the feedback of the roll rate cancels the roll mode
    found = margins(roll_loop())
    assert found.crossover == pytest.approx(0.8, rel=1e-3)
    assert found.phase == pytest.approx(90.0 - 0.5 * 0.8 * STEP / DEG, abs=0.01)


def test_without_a_look_ahead_a_quicker_path_loop_has_too_little_phase() -> None:
    blind = [
        margins(path_loop(tas=240.0, gains=PathGains(omega=w, damping=0.8, look_ahead=0.0)))
        for w in (0.09, 0.11, 0.13)
    ]
    assert all(a.phase > b.phase for a, b in pairwise(blind))
    assert blind[1].phase > 45.0 > blind[2].phase


@pytest.mark.parametrize("gains", [PATH_GAINS, FOLLOW_GAINS])
def test_near_a_path_that_bends_what_is_flown_is_the_linear_loop(gains: PathGains) -> None:
    loop = path_loop(tas=240.0, gains=gains)
    # 0.7° a minute: enough not to be taken for a straight
    flown = responses.path_step(1.0, tas=240.0, gains=gains, bend=2e-4, duration=59.0)
    assert flown.across[:: round(TICK / STEP)] == pytest.approx(
        linear(loop, np.array([1.0, 0.0, 0.0, 0.0])), abs=0.01
    )


@pytest.mark.parametrize("gains", [PATH_GAINS, FOLLOW_GAINS])
def test_near_a_straight_what_is_flown_is_the_linear_loop(gains: PathGains) -> None:
    loop = straight_loop(tas=240.0, gains=gains)
    flown = responses.path_step(1.0, tas=240.0, gains=gains, duration=59.0)
    assert flown.across[:: round(TICK / STEP)] == pytest.approx(
        linear(loop, np.array([0.0, 0.0, 0.0, 0.0, 1.0]), shown=4), abs=0.01
    )


def linear(loop: StateSpace, state: np.ndarray, *, shown: int = 0) -> np.ndarray:
    """A column of the closed loop's state, a minute long, a sample a second."""
    values = []
    for _ in range(60):
        values.append(state[shown])
        state = (loop.A - loop.B @ loop.C) @ state
    return np.array(values)


def test_a_small_change_of_heading_is_the_linear_loop() -> None:
    loop = heading_loop(tas=240.0)
    state, linear = np.zeros(4), []
    for _ in range(600):
        linear.append(state[0])
        state = loop.A @ state + loop.B[:, 0] * (0.1 * DEG - state[0])
    flown = responses.heading_step(0.1 * DEG, tas=240.0, duration=30.0)
    assert flown.heading[:600] == pytest.approx(np.array(linear), abs=2e-5)


@pytest.mark.parametrize("across", [100.0, 1500.0])
@pytest.mark.parametrize("in_hand", [2.5 * DEG, 25.0 * DEG])
@pytest.mark.parametrize("tas", [120.0, 250.0])
def test_no_start_overshoots_the_path(across: float, in_hand: float, tas: float) -> None:
    flown = responses.path_step(across, tas=tas, in_hand=in_hand, duration=150.0)
    assert responses.overshoot(flown.across, 0.0) < 5.0
    assert abs(flown.across[-1]) < 0.15 * across


@pytest.mark.parametrize("model", [pictures.SLUGGISH, report.A306, pictures.NIMBLE])
def test_a_switch_of_bank_costs_what_the_page_says(model: Airframe) -> None:
    # V Δr T²/24 is what the ramp alone costs; the feedback takes back a part of it
    q = 0.67 * report.A306.max_roll_rate
    rate = turn_rate(240.0, 22.5 * DEG)
    entry = 240.0 * rate * (22.5 * DEG / q) ** 2 / 24.0
    reversal = 240.0 * 2.0 * rate * (45.0 * DEG / q) ** 2 / 24.0
    assert 0.5 * entry < responses.off_path([70.0 * DEG], tas=240.0, model=model) < 1.1 * entry
    turns = [70.0 * DEG, -70.0 * DEG]
    assert 0.5 * reversal < responses.off_path(turns, tas=120.0, model=model) < 1.1 * reversal


def test_the_page_has_its_blocks_and_pictures() -> None:
    page = PAGE.read_text()
    assert "\nflight-figures:" in (ROOT / "Makefile").read_text()
    assert "make flight-figures" in page
    for name in (AUTOPILOT, PATH, CAMPAIGN):
        assert f"]({FOLDER.name}/{name})" in page
        assert "</svg>" in (FOLDER / name).read_text()
    for name in SHOWN:
        assert with_block(page, name, report.table(name)) == page
    with pytest.raises(ValueError, match="once each"):
        with_block(page, "no such block", "")


def test_the_page_tells_the_least_margins_of_all_loops() -> None:
    told = re.search(
        r"least (\d+)° of phase and × ([\d.]+) of gain, and bears ([\d.]+) s",
        " ".join(PAGE.read_text().split()),
    )
    found = [margins(loop(model)) for loop in LOOPS.values() for model in report.MODELS]
    assert told is not None
    assert float(told[1]) == round(min(one.phase for one in found))
    assert float(told[2]) == round(min(one.gain for one in found), 1)
    assert float(told[3]) == round(min(one.delay for one in found), 1)


def test_what_is_kept_is_what_is_computed() -> None:
    assert read_table(report.MARGINS_FILE)[1] == report.margins_cells()
    assert read_table("loop_gains.csv")[1] == report.gains_cells()


def test_the_file_of_settings_has_all_defaults() -> None:
    assert FILE.read_text() == constants_toml(), "write it anew: python -m tools.campaign.constants"
    loaded = load_settings(FILE)
    for field in fields(Settings):
        default = getattr(DEFAULT, field.name)
        assert getattr(loaded, field.name) == pytest.approx(default, rel=1e-12), field.name


def test_the_picture_of_the_campaign_is_drawn_from_what_is_kept(tmp_path: Path) -> None:
    again = tmp_path / CAMPAIGN
    pictures.draw_campaign(read_table(report.FIGURES)[1], again)
    drawn = [
        re.findall(r"<path d=\"[^\"]*\"", file.read_text()) for file in (again, FOLDER / CAMPAIGN)
    ]
    assert drawn[0] == drawn[1]

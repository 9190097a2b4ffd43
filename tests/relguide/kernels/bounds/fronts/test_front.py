"""Round a leader that turns nobody is faster than the fronts say, who need not turn himself."""

from collections.abc import Iterator
from itertools import islice
from math import acos, cos, hypot, inf, isnan, nan, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Pose, Scene, with_limit
from relguide.kernels.bounds.fronts.around import (
    is_behind,
    is_last,
    no_fronts,
    round_bound,
    round_time,
    soonest_in,
    sweep_from,
    times_of,
    times_round,
    unknown_around,
)
from relguide.kernels.bounds.fronts.cell_fronts import begin_fronts, round_arrival, slides_from
from relguide.kernels.bounds.fronts.front import whole_rounds
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import contact_heading, to_frame_of
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import MAX_ROWS, solve

WIDE = 0.05
"""Half a cell whose contacts' headings are not looked at [rad]."""
NARROW = 1e-9
"""Half a cell that holds hardly more than one contact [rad]."""


def turning(rng: np.random.Generator) -> Scene:
    """A leader that turns once, between two straight legs."""
    alpha, rate = rng.uniform(0.3, 0.98), rng.choice((-1.0, 1.0)) * rng.uniform(0.3, 1.5)
    starts = np.cumsum((0.0, rng.uniform(0.5, 3.0), rng.uniform(0.5, 4.0)))
    table = np.zeros((3, 5))
    table[:, 0], table[1, 4] = starts, rate
    scene = Scene(table, alpha, rng.uniform(1.0, 5.0), 0.0)
    for i in (0, 1):
        table[i + 1, 1:4] = leader_at(scene, i, starts[i + 1])
    return scene


def contact(scene: Scene, bearing: float, t: float, side: float = 1.0) -> Cell:
    """A cell that holds hardly more than the contact at this bearing from the leader, in the world,
    at one time.
    """
    piece = piece_at(scene.leader, t)
    turned = leader_at(scene, piece, t).h
    return Cell(piece, side, bearing - turned, NARROW, t, t)


def pose_of(scene: Scene, cell: Cell) -> Pose:
    """The pose of its contact."""
    there = leader_at(scene, cell.piece, cell.start)
    x, y = place(scene, cell.bearing + there.h, cell.start)
    return Pose(x, y, there.h + contact_heading(cell.bearing, cell.side, scene.alpha))


def place(scene: Scene, bearing: float, t: float) -> tuple[float, float]:
    there = leader_at(scene, piece_at(scene.leader, t), t)
    return there.x + scene.d_min * cos(bearing), there.y + scene.d_min * sin(bearing)


def slide(
    scene: Scene, bearing: float, t: float, sense: float, angle: float
) -> tuple[float, float]:
    """When who slides along the disc has gone round so far, and how fast he turned at most."""
    step, fastest = 1e-3, 0.0
    heading, before = 0.0, nan
    while angle > 0.0:
        there = leader_at(scene, piece_at(scene.leader, t), t)
        heading = bearing + sense * acos(scene.alpha * cos(bearing - there.h))
        if not isnan(before):
            fastest = max(fastest, abs(heading - before) / step)
        before = heading
        rate = sin(heading - bearing) - scene.alpha * sin(there.h - bearing)
        bearing += rate / scene.d_min * step
        angle -= abs(rate) / scene.d_min * step
        t += step
    return t, fastest


@pytest.mark.parametrize("seed", range(2))
def test_nobody_slides_round_sooner_and_who_has_no_turn_to_wait_for_hardly_later(seed: int) -> None:
    rng = np.random.default_rng(seed)
    tight = slid = 0
    for _ in range(120):
        scene = turning(rng)
        bearing, t = rng.uniform(-pi, pi), rng.uniform(0.0, scene.leader[1, 0])
        angle, sense = rng.uniform(0.1, 3.0), rng.choice((-1.0, 1.0))
        came, turned = slide(scene, bearing, t, sense, angle)
        if turned > 1.0:
            continue
        start = contact(scene, bearing, t, sense)
        end = contact(scene, bearing + sense * angle, came, sense)._replace(end=came + 0.02)
        soonest = arrival(scene, start, end, inf)
        assert t <= soonest <= came + 0.01
        tight += soonest > came - 1e-3
        slid += 1
    assert slid > 40
    assert tight > 20


def arrival(scene: Scene, start: Cell, end: Cell, latest: float) -> float:
    """How soon something that starts in one cell can be in the other one."""
    table = times_round(scene.alpha, scene.d_min)
    return round_arrival(begin_fronts(), 0, scene, table, start, end, latest)


def straight_flights(rng: np.random.Generator) -> Iterator[tuple[Scene, Cell, Cell]]:
    """From contact to contact in a straight line outside the disc, in the time it takes or more."""
    for _ in range(20_000):
        scene = turning(rng)
        low, high = rng.uniform(-pi, pi, 2)
        begin, took = rng.uniform(0.0, scene.leader[2, 0]), rng.uniform(0.2, 6.0)
        (x, y), (to_x, to_y) = place(scene, low, begin), place(scene, high, begin + took)
        if hypot(to_x - x, to_y - y) > took:
            continue
        gaps = []
        for share in np.linspace(0.02, 0.98, 25):
            t = begin + share * took
            there = leader_at(scene, piece_at(scene.leader, t), t)
            at = x + share * (to_x - x) - there.x, y + share * (to_y - y) - there.y
            gaps.append(hypot(*at) - scene.d_min)
        if min(gaps) > 1e-3:
            yield scene, contact(scene, low, begin), contact(scene, high, begin + took)


@pytest.mark.parametrize("seed", range(2))
def test_nobody_flies_straight_from_contact_to_contact_sooner(seed: int) -> None:
    flown = 0
    for scene, start, end in straight_flights(np.random.default_rng(seed)):
        # cells so wide that it is not asked how somebody heads
        wide = start._replace(half=WIDE), end._replace(half=WIDE)
        assert arrival(scene, *wide, inf) <= end.start + 1e-6
        flown += 1
    assert flown > 100


def turning_flights(rng: np.random.Generator) -> Iterator[tuple[Scene, Cell, Cell]]:
    """From contact to contact by words outside the disc, in the time that they take."""
    rows = np.empty((MAX_ROWS, 5))
    for _ in range(1_500):
        scene = turning(rng)
        begin, sides = rng.uniform(0.0, scene.leader[2, 0]), rng.choice((-1.0, 1.0), 2)
        low, high = rng.uniform(-pi, pi, 2)
        start = contact(scene, low, begin, sides[0])
        at, times = pose_of(scene, start), begin + np.arange(0.0, 8.0, 0.05)
        spare = np.full((len(times), 6), np.inf)
        for k, t in enumerate(times):
            n = solve(
                to_frame_of(at, pose_of(scene, contact(scene, high, t, sides[1]))), 0.0, 0.0, rows
            )
            for row in rows[:n][::-1]:
                spare[k, int(row[1])] = row[0] - (t - begin)
        for k, word in np.argwhere((spare[:-1] > 0.0) & (spare[1:] <= 0.0) & (spare[:-1] < 0.1)):
            t = times[k] + 0.05 * spare[k, word] / (spare[k, word] - spare[k + 1, word])
            end = contact(scene, high, t, sides[1])
            n = solve(to_frame_of(at, pose_of(scene, end)), 0.0, 0.0, rows)
            for row in rows[:n]:
                inside = with_limit(scene, scene.d_min - 1e-3)
                if abs(row[0] - (t - begin)) < 2e-3 and word_clears(at, begin, row, inside):
                    yield scene, start, end


def test_nobody_who_turns_comes_from_contact_to_contact_sooner() -> None:
    """Also who has to turn back, for whom it takes longer than for what needs no time to turn."""
    flown = turned_back = 0
    for scene, start, end in turning_flights(np.random.default_rng(6)):
        came = end.start
        end = end._replace(end=came + 5e-3, start=came - 5e-3)
        soonest = arrival(scene, start, end, inf)
        assert soonest <= came + 5e-3
        wide = arrival(scene, start, end._replace(half=WIDE), inf)
        flown += 1
        turned_back += soonest > wide + 0.5
    assert flown > 40
    assert turned_back > 8


def test_fronts_from_all_contacts_are_ahead_of_who_flies_straight_in_time_and_back() -> None:
    nothing = unknown_around()
    for scene, start, end in islice(straight_flights(np.random.default_rng(2)), 60):
        on, back = no_fronts(), no_fronts()
        sweep_from(on, scene, start, start.start, 1.0, 99.0)
        sweep_from(back, scene, end, -end.end, -1.0, 0.0)
        assert soonest_in(nothing._replace(soonest=times_of(on)), scene, end) <= end.end
        assert not is_last(nothing._replace(latest=-times_of(back)), scene, start)


def test_who_is_behind_the_fronts_adds_nothing() -> None:
    rng = np.random.default_rng(3)
    behind = 0
    for _ in range(40):
        scene = turning(rng)
        first, t = contact(scene, rng.uniform(-pi, pi), 0.1), rng.uniform(6.0, 90.0)
        other = contact(scene, rng.uniform(-pi, pi), t)
        swept = no_fronts()
        sweep_from(swept, scene, first, 0.1, 1.0, 120.0)
        before = times_of(swept)
        if is_behind(swept, scene, other, t):
            sweep_from(swept, scene, other, t, 1.0, 120.0)
            assert np.all(times_of(swept) >= before - 0.02)
            behind += 1
    assert behind > 10


def test_fronts_of_two_cells_are_as_soon_as_the_sooner_of_both() -> None:
    """One after the other, the later one only as far as it is ahead of the first."""
    rng = np.random.default_rng(5)
    mixed = 0
    for _ in range(40):
        scene, pace = turning(rng), rng.choice((-1.0, 1.0))
        start = 0.1 if pace > 0.0 else -30.0
        begun = start, start + rng.uniform(0.0, 3.0)
        cells = [contact(scene, rng.uniform(-pi, pi), pace * t) for t in begun]
        both, alone = no_fronts(), (no_fronts(), no_fronts())
        for cell, t, swept in zip(cells, begun, alone, strict=True):
            sweep_from(swept, scene, cell, t, pace, start + 25.0)
            sweep_from(both, scene, cell, t, pace, start + 25.0)
        first, second = times_of(alone[0]), times_of(alone[1])
        sooner = np.minimum(first, second)
        assert np.array_equal(np.isinf(times_of(both)), np.isinf(sooner))
        assert times_of(both) == pytest.approx(sooner, abs=0.02)
        mixed += bool(np.any(first < second - 0.1) and np.any(second < first - 0.1))
    assert mixed > 10


def test_where_the_leader_keeps_straight_it_is_the_time_round() -> None:
    """For who passes him the way that he goes on, and has bank enough to slide."""
    rng = np.random.default_rng(4)
    slid = 0
    for _ in range(80):
        scene = turning(rng)
        scene.leader[1:, 0] += 1e6
        scene.leader[1:, 1] += 1e6 * scene.alpha
        table = times_round(scene.alpha, scene.d_min)
        low, high = rng.uniform(-pi, pi, 2)
        start, end = Cell(0, 1.0, low, NARROW, 0.0, 0.0), Cell(0, 1.0, high, NARROW, 0.0, 999.0)
        least, side = min((round_bound(table, way, start, end), 1.0 - 2.0 * way) for way in (0, 1))
        start, end = start._replace(side=side), end._replace(side=side)
        soonest = arrival(scene, start, end, inf)
        assert soonest > 0.99 * least - 2e-3
        if slide(scene, low, 0.0, side, (side * (high - low)) % (2.0 * pi))[1] <= 1.0:
            assert soonest == pytest.approx(least, rel=0.01, abs=2e-3)
            slid += 1
    assert slid > 20


def test_what_comes_too_late_comes_back_as_infinite() -> None:
    scene = turning(np.random.default_rng(0))
    start, end = contact(scene, 0.0, 0.0), contact(scene, 2.0, 9.0)
    soonest = arrival(scene, start, end, inf)
    assert arrival(scene, start, end, soonest - 0.1) == inf
    assert arrival(scene, start, end, soonest + 0.1) == soonest


def by_slide(scene: Scene, start: Cell, end: Cell) -> float:
    """How soon something that starts in one cell can be in another one, on the final leg."""
    table, soonest = times_round(scene.alpha, scene.d_min), inf
    for way in (0, 1):
        edge = end.bearing - (1.0 - 2.0 * way) * end.half
        took = (1.0 - 2.0 * way) * round_time(table, way, edge)
        took += whole_rounds(scene, start, end, way) * float(table[way, -1])
        soonest = min(soonest, slides_from(scene, table, start, way, inf) + took)
    return soonest


@pytest.mark.parametrize("half", [NARROW, 0.02])
def test_nobody_slides_on_to_the_final_leg_sooner(half: float) -> None:
    """Whole rounds are counted right, wherever the leader has turned to meanwhile."""
    rng = np.random.default_rng(7)
    slid = tight = turned_far = 0
    for _ in range(150):
        scene = turning(rng)
        scene.leader[:, 3] += 2.0 * pi * rng.integers(-1, 2)
        bearing, t = rng.uniform(-pi, pi), rng.uniform(0.0, scene.leader[2, 0])
        angle, sense = rng.uniform(0.3, 6.0), rng.choice((-1.0, 1.0))
        came, turned = slide(scene, bearing, t, sense, angle)
        if turned > 1.0 or came < scene.leader[2, 0]:
            continue
        start = contact(scene, bearing, t, sense)._replace(half=half)
        to = wrap_signed(bearing + sense * angle - scene.leader[2, 3])
        soonest = by_slide(scene, start, Cell(2, sense, to, half, scene.leader[2, 0], inf))
        assert soonest <= came + 0.01
        slid += 1
        tight += soonest > came - 2e-3 - 6.0 * half * scene.d_min
        turned_far += abs(scene.leader[2, 3]) > pi
    assert min(slid, turned_far) > 15
    assert tight > 8


def test_nobody_flies_straight_to_the_final_leg_sooner() -> None:
    flown = 0
    for scene, start, end in straight_flights(np.random.default_rng(8)):
        if start.piece < end.piece == 2:
            there = end._replace(bearing=wrap_signed(end.bearing))
            assert by_slide(scene, start, there) <= end.start + 1e-6
            flown += 1
    assert flown > 20

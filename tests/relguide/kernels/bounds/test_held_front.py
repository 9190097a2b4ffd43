"""A front that is held is as late as who leaves the edge straight, and no later than anybody."""

from collections.abc import Iterator
from math import acos, atan2, cos, hypot, inf, pi, sin
from typing import NamedTuple

import numpy as np

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Scene
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.held_front import holds_of, slides_from
from relguide.kernels.bounds.round_time import round_anywhere, times_round
from relguide.kernels.separation.clearance import leader_at, piece_at
from tests.relguide.kernels.bounds.test_round_turning import contact, place, turning

STEP = 1e-3
"""In which paths are flown [R/V_P]."""
LATEST = 12.0
"""Nobody is followed for longer [R/V_P]."""
HELD = 0.01
"""What holding must gain somewhere: half a second for an airliner [R/V_P]."""


class Flown(NamedTuple):
    """Somebody who slides, leaves the edge straight, and slides on to the final leg."""

    scene: Scene
    start: Cell
    way: int
    holds: np.ndarray
    since: float
    """When he is there, less the time round to where he is [R/V_P]."""
    missed: float
    """How long it may take to make up for how far from the edge he was [R/V_P]."""


def slides_for(scene: Scene, bearing: float, t: float, sense: float) -> tuple[float, float]:
    """How who slides heads, and how fast he goes round."""
    there = leader_at(scene, piece_at(scene.leader, t), t)
    heading = bearing + sense * acos(scene.alpha * cos(bearing - there.h))
    rate = sin(heading - bearing) - scene.alpha * sin(there.h - bearing)
    return heading, rate / scene.d_min


def on_edge(scene: Scene, bearing: float, t: float, sense: float) -> float:
    """The bearing of who slides a step later."""
    half = bearing + 0.5 * STEP * slides_for(scene, bearing, t, sense)[1]
    return bearing + STEP * slides_for(scene, half, t + 0.5 * STEP, sense)[1]


def slid_to(
    scene: Scene, bearing: float, t: float, sense: float, course: float
) -> tuple[float, float]:
    """Where and when who slides heads on a course."""
    latest = t + LATEST
    while sense * slides_for(scene, bearing, t, sense)[0] < course and t < latest:
        bearing, t = on_edge(scene, bearing, t, sense), t + STEP
    return bearing, t


def straight_to(
    scene: Scene, bearing: float, t: float, sense: float, course: float
) -> tuple[float, float, float, float]:
    """Where and when who leaves the edge straight may slide on.

    Returns:
        the bearing [rad], when [R/V_P], how far from the edge he is then, and was at least [R].
    """
    x, y = place(scene, bearing, t)
    latest, closest, gap, away = t + LATEST, inf, 0.0, False
    while t < latest:
        x, y, t = x + STEP * cos(course), y + sense * STEP * sin(course), t + STEP
        there = leader_at(scene, piece_at(scene.leader, t), t)
        bearing += wrap_signed(atan2(y - there.y, x - there.x) - bearing)
        gap = hypot(x - there.x, y - there.y) - scene.d_min
        closest = min(closest, gap)
        turns = sense * slides_for(scene, bearing, t, sense)[0]
        if away and turns >= course:
            break
        away = away or turns < course
    return bearing, t, gap, closest


def held_flights(rng: np.random.Generator) -> Iterator[Flown]:
    """Who leaves the edge on the course on which a front is held, and keeps off the disc."""
    for _ in range(2_000):
        scene, way = turning(rng), int(rng.integers(2))
        sense, ends = 1.0 - 2.0 * way, float(scene.leader[2, 0])
        t, bearing = rng.uniform(scene.leader[1, 0], ends), rng.uniform(-pi, pi)
        start = contact(scene, bearing, t, sense)
        holds = holds_of(scene, start, way, inf)
        if len(holds) != 1 or sense * slides_for(scene, bearing, t, sense)[0] > holds[0, 0]:
            continue
        begun, latest = slid_to(scene, bearing, t, sense, holds[0, 0]), t + LATEST
        bearing, t, gap, closest = straight_to(scene, *begun, sense, holds[0, 0])
        if closest < -5e-4 or t >= latest:
            continue
        while t < ends:
            bearing, t = on_edge(scene, bearing, t, sense), t + STEP
        table = times_round(scene.alpha, scene.d_min)
        there = t - sense * round_anywhere(table, way, bearing - scene.leader[2, 3])
        missed = 2.0 * (abs(gap) - min(closest, 0.0)) / (1.0 - scene.alpha)
        yield Flown(scene, start, way, holds, there, missed)


def since(flown: Flown, holds: np.ndarray) -> float:
    """The same of a front that is held so."""
    table = times_round(flown.scene.alpha, flown.scene.d_min)
    return slides_from(flown.scene, table, flown.start, flown.way, inf, holds)


def test_a_front_is_held_as_long_as_who_leaves_the_edge_straight() -> None:
    held = []
    for flown in held_flights(np.random.default_rng(1)):
        soonest = since(flown, flown.holds)
        assert abs(soonest - flown.since) < flown.missed + 1e-3
        held.append(soonest - since(flown, flown.holds[:0]))
    assert len(held) > 50
    assert min(held) > -1e-4
    assert max(held) > HELD


def test_wherever_a_front_is_held_nobody_is_sooner() -> None:
    rng, looked = np.random.default_rng(2), 0
    for flown in held_flights(np.random.default_rng(1)):
        for _ in range(5):
            holds = flown.holds + rng.uniform(-0.5, 0.5, (1, 2))
            assert since(flown, holds) < flown.since + flown.missed + 1e-3
            looked += 1
    assert looked > 100


def test_who_is_on_the_final_leg_in_time_is_no_sooner_than_the_front() -> None:
    """Though the front may slide on only later than that."""
    rng, looked, later = np.random.default_rng(3), 0, 0
    while looked < 400:
        scene, way = turning(rng), int(rng.integers(2))
        sense, ends = 1.0 - 2.0 * way, float(scene.leader[2, 0])
        t, bearing = rng.uniform(scene.leader[1, 0], ends), rng.uniform(-pi, pi)
        start, latest = contact(scene, bearing, t, sense), ends + rng.uniform(0.01, 1.0)
        while t < ends:
            bearing, t = on_edge(scene, bearing, t, sense), t + STEP
        table = times_round(scene.alpha, scene.d_min)
        slid = t - sense * round_anywhere(table, way, bearing - scene.leader[2, 3])
        holds = holds_of(scene, start, way, latest)
        soonest = slides_from(scene, table, start, way, latest, holds)
        assert soonest < slid + 1e-3
        later += soonest > slides_from(scene, table, start, way, inf, holds) + 1e-3
        looked += 1
    assert later > 10

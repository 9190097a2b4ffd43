"""No path that slides round the leader is on the final leg sooner than is said."""

from math import acos, cos, inf, pi, sin

import numpy as np

from relguide.kernels.base.records import Scene
from relguide.kernels.bounds.round_time import round_anywhere, times_round
from relguide.kernels.bounds.to_final_leg import slides_from
from relguide.kernels.separation.clearance import leader_at, piece_at
from tests.relguide.kernels.bounds.test_round_turning import contact, turning

STEP = 1e-3
"""In which paths are flown [R/V_P]."""


def goes_round(scene: Scene, bearing: float, t: float, sense: float) -> float:
    """How fast the bearing of a pursuer changes that slides [V_P/R]."""
    there = leader_at(scene, piece_at(scene.leader, t), t)
    heading = bearing + sense * acos(scene.alpha * cos(bearing - there.h))
    return (sin(heading - bearing) - scene.alpha * sin(there.h - bearing)) / scene.d_min


def on_edge(scene: Scene, bearing: float, t: float, sense: float) -> float:
    """The bearing of a pursuer that slides, a step later."""
    half = bearing + 0.5 * STEP * goes_round(scene, bearing, t, sense)
    return bearing + STEP * goes_round(scene, half, t + 0.5 * STEP, sense)


def test_a_path_that_slides_is_on_the_final_leg_no_sooner_than_the_front() -> None:
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
        soonest = slides_from(scene, table, start, way, latest)
        assert soonest < slid + 1e-3
        later += soonest > slides_from(scene, table, start, way, inf) + 1e-3
        looked += 1
    assert later > 10

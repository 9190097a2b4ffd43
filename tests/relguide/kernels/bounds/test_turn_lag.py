"""Nobody who turns at full bank at most is round sooner than is said of how fronts fall behind."""

from collections.abc import Iterator
from itertools import islice
from math import inf, pi
from typing import NamedTuple

import numpy as np

from relguide.kernels.base.records import Scene
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.held_front import holds_of, slides_from
from relguide.kernels.bounds.junction import slide_turns
from relguide.kernels.bounds.round_time import ROUND_SLACK, round_anywhere, times_round
from relguide.kernels.bounds.turn_lag import SINCE, lag_at, lags_from
from relguide.kernels.contact.contact import contact_at
from relguide.kernels.separation.clearance import leader_at, piece_at
from tests.relguide.kernels.bounds.test_held_front import STEP, on_edge
from tests.relguide.kernels.bounds.test_hop_to_final import unrolled, words_between
from tests.relguide.kernels.bounds.test_round_turning import turning

SLACK = 2e-5
MATTERS = 2e-3
"""A front that falls behind so much is 0.1 s late for an airliner [R/V_P]."""


class Sliding(NamedTuple):
    """Who slides along the edge from a contact on, as far as bank is enough."""

    scene: Scene
    cell: Cell
    way: int
    table: np.ndarray
    front: float
    """When the front is on the final leg, less the time round to there [R/V_P]."""
    lags: np.ndarray
    """Of `lags_from`."""
    places: list[tuple[float, float]]
    """When and at which bearing he is [R/V_P, rad]."""


def slid(scene: Scene, cell: Cell, sense: float) -> list[tuple[float, float]]:
    """Where who starts in the middle of a cell and slides is, until no bank is enough."""
    t, latest = 0.5 * (cell.start + cell.end), float(scene.leader[2, 0]) + 2.0
    bearing, places = cell.bearing + leader_at(scene, cell.piece, t).h, []
    while t < latest:
        places.append((t, bearing))
        piece = piece_at(scene.leader, t)
        seen = bearing - leader_at(scene, piece, t).h
        if not -1.0 <= slide_turns(scene, Cell(piece, sense, seen, 0.0, t, t))[0] <= 1.0:
            break
        bearing, t = on_edge(scene, bearing, t, sense), t + STEP
    return places


def slides(rng: np.random.Generator, half: float) -> Iterator[Sliding]:
    """Fronts that fall behind, from cells so wide."""
    while True:
        scene, way = turning(rng), int(rng.integers(2))
        sense, ends = 1.0 - 2.0 * way, float(scene.leader[2, 0])
        piece = int(rng.integers(1, 3))
        t = ends + (rng.uniform(-1.5, -0.01) if piece == 1 else rng.uniform(0.1, 1.0))
        bearing, quadrant = rng.uniform(-pi, pi), 0.5 * pi
        low = np.floor(bearing / quadrant) * quadrant
        bearing = min(max(bearing, low + half), low + quadrant - half)
        cell = Cell(piece, sense, bearing, half, t - half, t + half)
        if {piece_at(scene.leader, cell.start), piece_at(scene.leader, cell.end)} != {piece}:
            continue
        table, holds = times_round(scene.alpha, scene.d_min), holds_of(scene, cell, way, inf)
        lags = lags_from(scene, table, cell, way, inf, holds)
        front = slides_from(scene, table, cell, way, inf, holds)
        if lags[0, SINCE] > front + MATTERS:
            places = slid(scene, cell, sense)
            yield Sliding(scene, cell, way, table, front, lags, places)


def said_of(sliding: Sliding, bearing: float) -> float:
    """When somebody may be in his last contact there, less the time round to there."""
    return float(lag_at(sliding.lags, bearing, 1.0 - 2.0 * sliding.way))


def hops(sliding: Sliding, rng: np.random.Generator, count: int) -> Iterator[tuple[float, float]]:
    """When who slides and then hops is in contact again, less the time round; and where."""
    scene, sense, ends = sliding.scene, 1.0 - 2.0 * sliding.way, float(sliding.scene.leader[2, 0])
    heading = scene.leader[2, 3]
    for _ in range(count):
        t, bearing = sliding.places[int(rng.integers(len(sliding.places)))]
        piece = piece_at(scene.leader, t)
        there = leader_at(scene, piece, t)
        begin = contact_at(scene, t, bearing - there.h, sense)
        to = bearing + sense * rng.uniform(0.05, 1.8)
        other = (to - heading + pi) % (2.0 * pi) - pi
        for row in words_between(scene, t, begin, other, sense):
            went = unrolled(scene, t, begin, row) if ends - t < row[0] < 4.0 else np.nan
            if np.isnan(went) or abs(went - (to - bearing)) > 1e-3:
                continue
            at = to - heading
            yield t + row[0] - sense * round_anywhere(sliding.table, sliding.way, at), at


def test_nobody_slides_hops_and_is_round_sooner() -> None:
    rng, flown, late = np.random.default_rng(1), 0, 0
    for half in (1e-7, 1e-4, 1e-3):
        for number, sliding in enumerate(slides(rng, half)):
            slack = SLACK + 2.0 * ROUND_SLACK * sliding.table[sliding.way, -1]
            for since, at in hops(sliding, rng, 60):
                said = said_of(sliding, at)
                flown += 1
                late += said > sliding.front + MATTERS
                assert since >= said - slack
            if number == 40:
                break
    assert flown > 1_000
    assert late > 200


def test_fronts_fall_behind_nearly_as_far_as_the_best_hop_does() -> None:
    rng, shares = np.random.default_rng(2), []
    for sliding in slides(rng, 1e-7):
        best = min(
            (since for since, at in hops(sliding, rng, 800) if said_of(sliding, at) > -inf),
            default=inf,
        )  # fmt: skip
        if best < inf:
            shares.append((sliding.lags[0, SINCE] - sliding.front) / (best - sliding.front))
        if len(shares) == 12:
            break
    assert max(shares) > 0.8
    assert np.median(shares) > 0.3


def test_round_a_leader_nearly_as_fast_nothing_is_known() -> None:
    """As of fronts, see `round_turning.FAST`."""
    for sliding in islice(slides(np.random.default_rng(4), 1e-7), 20):
        scene = sliding.scene._replace(alpha=0.9995)
        table = times_round(scene.alpha, scene.d_min)
        holds = holds_of(scene, sliding.cell, sliding.way, inf)
        lags = lags_from(scene, table, sliding.cell, sliding.way, inf, holds)
        assert (lags[:, SINCE] == -inf).all()

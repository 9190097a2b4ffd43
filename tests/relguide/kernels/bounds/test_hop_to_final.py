"""Who hops onto the final leg from where nobody can slide is no sooner round than is said."""

from collections.abc import Iterator
from math import atan2, cos, hypot, inf, pi, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Pose, Scene, Velocity
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.hop_to_final import hops_from, never_round
from relguide.kernels.bounds.junction import apart_by, slide_turns
from relguide.kernels.bounds.round_time import ROUND_SLACK, round_anywhere, times_round
from relguide.kernels.bounds.to_final_leg import slides_from
from relguide.kernels.contact.contact import contact_at, to_frame_of
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve_toward
from tests.costates import with_costate
from tests.relguide.kernels.bounds.test_round_turning import turning

SLACK = 1e-6
ENOUGH = 1.0
"""So much more than the front says is asked for [R/V_P]."""


class Left(NamedTuple):
    """Contacts that are left while the leader turns, and nobody can slide from there."""

    scene: Scene
    cell: Cell
    way: int
    table: FloatArray
    slides: float
    """What a front from there says [R/V_P]."""
    hops: float
    """And what `hops_from` does."""


def tight_cells(rng: np.random.Generator, wide: bool) -> Iterator[Left]:
    """Cells from which the next contact lies on the final leg."""
    while True:
        scene, half = turning(rng), 10.0 ** rng.uniform(-6.0, -3.0) if wide else 1e-7
        ends, side = float(scene.leader[2, 0]), rng.choice([1.0, -1.0])
        t, bearing = ends - rng.uniform(0.01, 0.4), rng.uniform(-pi, pi)
        quadrant = np.floor(bearing / (0.5 * pi)) * 0.5 * pi
        bearing = min(max(bearing, quadrant + half), quadrant + 0.5 * pi - half)
        cell = Cell(1, side, bearing, half, t - half, t + half)
        if piece_at(scene.leader, cell.start) != 1 or piece_at(scene.leader, cell.end) != 1:
            continue
        apart, way = apart_by(scene, cell, 1.0), 0 if side > 0.0 else 1
        if slide_turns(scene, cell)[0] <= 1.0 or cell.start + apart < ends:
            continue
        table = times_round(scene.alpha, scene.d_min)
        slides = slides_from(scene, table, cell, way, inf)
        if slides < 0.0 - 1e6:
            continue
        hops = hops_from(scene, table, cell, way, slides, apart, slides + ENOUGH, inf)
        yield Left(scene, cell, way, table, slides, hops)


def words_between(scene: Scene, t: float, begin: Pose, bearing: float, side: float) -> FloatArray:
    """Words from a pose at a time to a contact on the final leg, that some costate fits."""
    leader = scene.leader[2]
    at_once = contact_at(scene, float(leader[0]), bearing, side)
    early = t - leader[0]
    end = Pose(
        at_once.x + early * scene.alpha * cos(leader[3]),
        at_once.y + early * scene.alpha * sin(leader[3]), at_once.h,
    )  # fmt: skip
    seen, turn = to_frame_of(begin, end), leader[3] - end.h
    rows = np.empty((MAX_ROWS, 5))
    toward = Velocity(scene.alpha * cos(turn), scene.alpha * sin(turn))
    n = solve_toward(seen._replace(h=seen.h % (2.0 * pi)), toward, 0.0, rows)
    return with_costate(rows[:n])


@njit(nogil=True)
def unrolled(scene: Scene, t: float, at: Pose, row: FloatArray) -> float:
    """How far a word goes round the leader, counter-clockwise; NaN if it does not keep d_min."""
    there = leader_at(scene, piece_at(scene.leader, t), t)
    before, went = atan2(at.y - there.y, at.x - there.x), 0.0
    for k in range(3):
        sign, amount = SIGNS[int(row[1]), k], row[2 + k]
        for i in range(1, 201):
            along = amount * i / 200
            pose = fly_piece(at, sign, along)
            there = leader_at(scene, piece_at(scene.leader, t + along), t + along)
            dx, dy = pose.x - there.x, pose.y - there.y
            if hypot(dx, dy) < scene.d_min - 1e-9:
                return np.nan
            bearing = atan2(dy, dx)
            went += wrap_signed(bearing - before)
            before = bearing
        at = fly_piece(at, sign, amount)
        t += amount
    return went


def hops_of(left: Left, rng: np.random.Generator, count: int) -> Iterator[float]:
    """When paths from a contact of a cell are at the next one, less the time round to it."""
    scene, cell, sense = left.scene, left.cell, 1.0 - 2.0 * left.way
    for k in range(count):
        t = rng.uniform(cell.start, cell.end)
        bearing = cell.bearing + cell.half * rng.uniform(-1.0, 1.0)
        begin, there = contact_at(scene, t, bearing, cell.side), leader_at(scene, 1, t)
        side = cell.side if k % 4 else -cell.side
        ahead = rng.uniform(-0.5, 3.0) if k % 2 else rng.uniform(0.0, 1.0)
        other = wrap_signed(bearing + there.h - scene.leader[2, 3] + sense * ahead)
        for row in words_between(scene, t, begin, other, side):
            if row[0] >= never_round(scene) or t + row[0] < scene.leader[2, 0]:
                continue
            went = unrolled(scene, t, begin, row)
            if np.isnan(went):
                continue
            at = bearing + there.h - scene.leader[2, 3] + went
            yield t + row[0] - sense * round_anywhere(left.table, left.way, at)


def test_nobody_hops_onto_the_final_leg_and_is_round_sooner() -> None:
    rng, found, raised = np.random.default_rng(1), 0, 0
    for left in tight_cells(rng, True):
        slack = SLACK + 2.0 * ROUND_SLACK * left.table[left.way, -1]
        assert left.slides <= left.hops <= left.slides + ENOUGH + SLACK
        for since in hops_of(left, rng, 60):
            found += 1
            raised += left.hops > left.slides + 1e-3
            assert since >= left.hops - slack
        if found > 1_500 and raised > 500:
            return


def test_the_best_hop_is_as_soon_as_is_said() -> None:
    rng, compared = np.random.default_rng(2), 0
    for left in tight_cells(rng, False):
        least = min(hops_of(left, rng, 1_500), default=inf)
        if not left.slides + 1e-3 < least < left.slides + 0.3:
            continue
        assert least - 3e-4 < left.hops <= least + SLACK
        compared += 1
        if compared == 14:
            return


def test_where_the_next_contact_may_lie_on_another_leg_the_front_counts() -> None:
    left = next(tight_cells(np.random.default_rng(3), False))
    alone = float(left.scene.leader[2, 0]) - left.cell.start
    for apart in (0.5 * alone, 0.0):
        said = hops_from(
            left.scene, left.table, left.cell, left.way, left.slides, apart, inf, inf
        )  # fmt: skip
        assert said == left.slides

"""Certified answers to many situations at once, by networks: what `plan_rows` is compared to.

As `learn.network_planner`, row by row in one kernel: the fastest path, and where that breaks the
limit the constrained path that the network leads to; then the certificate. What the network passes
on, `plan_rows` answers. Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the
leader is at (D/R, 0) at t = 0 and keeps heading 0.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.path_pieces import pieces_of
from relguide.kernels.contact.time_rows import plan_rows
from relguide.kernels.networks.branch_scores import Layers
from relguide.kernels.networks.template_scores import LEGS, Decision, choose_template
from relguide.kernels.separation.approach import least_on_paths
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.branches import needs_mirror
from relguide.kernels.words.extremals import SIGNS
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch
from relguide.learn.boundary.template_network import TemplateNetwork
from relguide.planning.certificate import TOLERANCE
from relguide.planning.constrained_path import HARDER

BY_NETWORK = -1.0
"""Verdict of an answer that the networks gave."""
_RADIUS, _TAS = 10_000.0, 200.0  # certificates round in metres, so they are asked in those


def answer_rows(
    situations: FloatArray, ways: TemplateNetwork, bearings: int, first: int, last: int,
    answers: FloatArray,
) -> None:  # fmt: skip
    """Answer situations first … last − 1.

    Args:
        situations: x, y, h of the pursuer; α; x, y of the leader; d_min. shape (n, 7)
        ways: names the templates where the limit binds.
        bearings: how finely the disc is scanned for constrained paths, where `plan_rows` is asked.
        first: from this row on.
        last: up to this row.
        answers: as `plan_rows` gives them, or with the verdict `BY_NETWORK`. shape (n, 4)
    """
    around = ways.box
    _answer_rows(
        situations, ways.layers, (ways.least_share, ways.most, ways.doubt),
        (around.min_ratio, around.max_ratio, around.min_limit, around.max_limit, around.max_slot,
         around.max_range),
        bearings, first, last, answers,
    )  # fmt: skip


@njit(nogil=True)
def _answer_rows(
    situations: FloatArray, ways: Layers, surer: tuple[float, int, float],
    around: tuple[float, float, float, float, float, float], bearings: int, first: int, last: int,
    answers: FloatArray,
) -> None:  # fmt: skip
    free, scratch = np.empty(5), make_scratch()
    legs, leader = np.zeros((LEGS, 6)), np.zeros((1, 5))
    latest = np.full(last, inf)
    for n in range(first, last):
        x, y, h, alpha, slot, _, limit = situations[n]
        if needs_mirror(y, h):
            y, h = -y, TWO_PI - h if h > 0.0 else 0.0
        away = np.hypot(x - slot, y)
        time, leader[0, 1] = inf, slot
        pieces = np.empty((3, 0))
        if not fastest(Pose(x, y, h), alpha, 0.0, 0, scratch, free):
            time = inf
        elif word_clears(Pose(x, y, h), 0.0, free, Scene(leader, alpha, limit - SLACK, 0.0, inf)):
            time = free[0]
            pieces = np.zeros((3, 3))
            pieces[1], pieces[2] = SIGNS[int(free[1])], free[2:5]
            for k in range(3):
                pieces[2, k] *= _RADIUS if pieces[1, k] == 0.0 else 1.0
        elif (
            around[0] <= alpha <= around[1]
            and around[2] <= limit <= around[3]
            and limit <= slot <= around[4] * limit
            and limit <= away <= limit + around[5]
        ):
            _, _, time, count = choose_template(
                Pose(x, y, h),
                Scene(leader, alpha, limit, 0.0, inf),
                free,
                ways,
                Decision(*surer),
                legs,
            )
            if count > 0:
                pieces = pieces_of(
                    Pose(x, y, h), Scene(leader, alpha, limit, 0.0, inf), _RADIUS, 1.0, time,
                    legs[:count],
                )  # fmt: skip
        if pieces.shape[1] > 0 and _keeps(x, y, h, slot, alpha, limit, pieces):
            answers[n, 0], answers[n, 2] = time, BY_NETWORK
        else:
            plan_rows(situations, latest, bearings, HARDER, True, n, n + 1, answers)


@njit(nogil=True)
def _keeps(
    x: float, y: float, h: float, slot: float, alpha: float, limit: float, pieces: FloatArray
) -> bool:
    """The certificate. The slot frame is a world with its x axis north: left is right there."""
    path = np.empty(4 + 2 * pieces.shape[1])
    path[0], path[1], path[2], path[3] = y * _RADIUS, x * _RADIUS, h, _TAS
    for k in range(pieces.shape[1]):
        boundary_arc, bend, amount = pieces[0, k], pieces[1, k], pieces[2, k]
        if boundary_arc == 0.0:
            path[4 + 2 * k] = amount if bend == 0.0 else amount * _RADIUS
            path[5 + 2 * k] = bend / _RADIUS
        else:
            path[4 + 2 * k], path[5 + 2 * k] = amount, -bend
    leader = np.array((0.0, slot * _RADIUS, 0.0, alpha * _TAS))
    _, _, bound = least_on_paths(path, leader, TOLERANCE * _RADIUS)
    return bool(bound >= (limit - SLACK) * _RADIUS)

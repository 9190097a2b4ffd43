"""Paths that keep clear of the leader, other traffic and cells: what `plan` asks amid others.

The plan for the leader alone is tried first: leaving others out only relaxes what is asked, so what
is proved of it holds amid them too, and if it keeps clear of all it is the answer. Otherwise paths
are searched that touch any of them (`kernels/contact/detour_search.py`). The certificate is the
judge in the end.
"""

from collections.abc import Iterable
from functools import cache
from itertools import islice
from math import hypot, inf, pi
from typing import assert_never

import numpy as np

from relguide.kernels.contact.detour_search import MOST_PAIRS, fastest_clear_of_all
from relguide.kernels.separation.cell import signed_distance
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.aircraft import Leader, Pursuer, Traffic
from relguide.planning.candidate import SIGN_ROWS, Candidate, assemble
from relguide.planning.cells import Cell, Disc, Polygon
from relguide.planning.certificate import (
    Certificate,
    OtherSeparation,
    cell_shape,
    certify,
    judge,
)
from relguide.planning.heights import counted, heights_of
from relguide.planning.intent import TurnTo
from relguide.planning.others_table import others_of
from relguide.planning.phrases import distance
from relguide.planning.situation import Other, Situation
from relguide.planning.slot import slot_frame
from relguide.planning.tables import leader_path
from relguide.planning.trajectory import RIGHT, Trajectory
from relguide.planning.words import candidates
from relguide.units import DEG, Metre

MOST_TRIED = 32
"""Of the paths that arrive just as the slot opens, so many are tried, fewest turns first."""


def lost_already(situation: Situation) -> tuple[OtherSeparation, str] | None:
    """One of the others that the pursuer is too close to now, and a sentence that says so."""
    for other in situation.others:
        apart, limit = _separation_now(situation, other)
        if apart >= limit - SLACK * situation.pursuer.turn_radius or not _counts_now(
            situation, other
        ):
            continue
        if isinstance(other, Cell):
            message = (
                f"The pursuer is {distance(-apart)} inside {other.ident}. A plan must begin "
                "outside all cells."
            )
        else:
            message = (
                f"The pursuer is {distance(apart)} from {other.ident}, closer than the minimum "
                f"of {distance(limit)} that is to be kept from it."
            )
        lost = OtherSeparation(
            ident=other.ident, least_separation=apart, at_time=0.0, lower_bound=apart,
            min_separation=limit, holds=False,
        )  # fmt: skip
        return lost, message
    return None


def _counts_now(situation: Situation, other: Other) -> bool:
    """Whether the horizontal minimum counts at t = 0; from a cell it always does."""
    if isinstance(other, Cell):
        return True
    when = counted(heights_of(situation.pursuer), heights_of(other))
    return len(when) > 0 and when[0][0] <= 0.0


def _separation_now(situation: Situation, other: Other) -> tuple[Metre, Metre]:
    """How far the pursuer is from one of the others, and how far it should be at least [m]."""
    x, y = situation.pursuer.x, situation.pursuer.y
    match other:
        case Traffic():
            return hypot(x - other.x, y - other.y), other.min_separation
        case Cell():
            corners, cell = cell_shape(other, situation.wind)
            return float(signed_distance(x, y, corners, float(cell[0]))[0]), 0.0
        case _:
            assert_never(other)


def just_as_it_opens(situation: Situation) -> tuple[Candidate, Certificate] | None:
    """A path that arrives just as the slot opens: none is faster."""
    found = candidates(situation)
    if not found.reachable_at_release:
        return None
    radius, leading = situation.pursuer.turn_radius, leader_path(situation)
    for candidate in islice(found.at_release, MOST_TRIED):
        certificate = judge(candidate.trajectory, situation, radius, leading)
        if certificate.holds:
            return candidate, certificate
    return None


def around(situation: Situation, until: float) -> tuple[Candidate, Certificate] | None:
    """The fastest path found that keeps clear of all, and its certificate."""
    frame = slot_frame(situation, situation.leader.trajectory)
    others = others_of(situation, frame, until=until)
    pairs, row = np.zeros((MOST_PAIRS, 3)), np.empty(5)
    _, n = fastest_clear_of_all(frame.pose, others, pairs, row)
    if n < 0:
        return None
    signs, amounts = [], []
    for sign, turned, straight in pairs[:n].tolist():
        signs += [sign, 0.0]
        amounts += [turned, straight]
    _, word, *lasts = row.tolist()
    signs, amounts = signs + SIGN_ROWS[int(word)], amounts + lasts
    candidate = assemble(situation, frame, signs, amounts, "")
    certificate = certify(candidate.trajectory, situation)
    return (candidate, certificate) if certificate.holds else None


def nearest_miss(tried: Iterable[Trajectory], situation: Situation) -> OtherSeparation:
    """What comes in the way of the path that keeps clear best, if it keeps clear of the leader.

    Args:
        tried: paths to the slot, none clear of all; the first keeps clear of the leader.
        situation: for which they were made.
    """
    radius, leading = situation.pursuer.turn_radius, leader_path(situation)
    limit = situation.min_separation - SLACK * radius
    judged = [judge(trajectory, situation, radius, leading) for trajectory in tried]
    missed = [
        certificate.others[0]
        for k, certificate in enumerate(judged)
        if (k == 0 or certificate.lower_bound >= limit) and not certificate.others[0].holds
    ]
    return max(missed, key=lambda other: other.lower_bound - other.min_separation)


@cache
def load_kernels() -> None:
    """Call all kernels of a search amid others once."""
    around(LOADING, inf)
    lost_already(LOADING)


LOADING = Situation(
    pursuer=Pursuer(x=-30e3, y=20e3, heading=0.5 * pi, tas=240.0, max_bank=25.0 * DEG),
    leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0),
    slot_distance=12e3,
    min_separation=9_260.0,
    others=(
        Traffic(
            ident="TURNING", x=0.0, y=40e3, heading=4.0, tas=200.0, min_separation=9_260.0,
            intent=(TurnTo(heading=1.0, turn=RIGHT, bank=25.0 * DEG),),
        ),
        Cell(ident="DISC", shape=Disc(x=20e3, y=50e3, radius=5e3), east=10.0, growth=1.0),
        Cell(ident="POLYGON", shape=Polygon(corners=((8e3, 20e3), (9e3, 20e3), (9e3, 21e3)))),
    ),
)  # fmt: skip
"""One with others of each kind in the way."""

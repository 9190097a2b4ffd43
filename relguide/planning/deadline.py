"""end_of(deadline) → the time at which what has this deadline must have ended.

Kernels read the clock while they work (`kernels/base/clock.py`), and Python between two kernels.
Kernels are read from disk when they are first called, which takes a second in all: that is done
before, and does not count.
"""

from functools import cache
from itertools import islice
from math import inf, pi

from relguide.kernels.base.clock import now, time_is_up
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.at_release import first_at_release
from relguide.planning.certificate import certify
from relguide.planning.constrained_path import constrained_path
from relguide.planning.inputs import expect_within
from relguide.planning.intent import TurnTo
from relguide.planning.least_bad import least_bad, restore
from relguide.planning.situation import Situation
from relguide.planning.straight_ahead import first_candidate
from relguide.planning.tables import leader_path
from relguide.planning.trajectory import RIGHT
from relguide.planning.words import HORIZON, candidates
from relguide.units import DEG, Second

MAX_DEADLINE: Second = 3_600.0
"""Longest accepted deadline [s]."""
TO_PUT_DOWN: Second = 1e-3
"""How long it takes to fly, certify and hand over what was found [s]."""
TO_LOOK_ROUND: Second = 0.05
"""How long it takes at most to find the soonest way out of a lost separation [s]."""
LOADING = (
    Situation(
        pursuer=Pursuer(x=0.0, y=30e3, heading=pi, tas=240.0, max_bank=25 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0),
        slot_distance=12e3,
        min_separation=9_260.0,
    ),
    Situation(
        pursuer=Pursuer(x=-9e3, y=-1e3, heading=1.0, tas=240.0, max_bank=25 * DEG),
        leader=Leader(
            x=0.0,
            y=0.0,
            heading=0.0,
            tas=200.0,
            intent=(TurnTo(heading=1.0, turn=RIGHT, bank=25 * DEG),),
        ),
        slot_distance=9_300.0,
        min_separation=9_260.0,
    ),
)
"""One path touches d_min; the other waits for its slot to open."""


def end_of(deadline: Second | None) -> float:
    """When what has this deadline [s] from now on must have ended, by `clock.now` [s].

    Infinite without one.

    Raises:
        ValueError: if the deadline is out of range, naming the range.
    """
    if deadline is None:
        return inf
    seconds = check_deadline(deadline)
    load_kernels()
    return now() + seconds


def check_deadline(deadline: object) -> Second:
    """A deadline [s].

    Raises:
        ValueError: if it is out of range, naming the range.
    """
    return expect_within("The deadline", deadline, 0.0, MAX_DEADLINE, "s")


def left_until(end: float) -> Second | None:
    """The deadline from now on that ends then; `None` if it never does."""
    return None if end == inf else max(end - now(), 0.0)


@cache
def load_kernels() -> None:
    """Call all kernels of a plan once."""
    for situation in LOADING:
        first_candidate(situation, situation.pursuer.turn_radius)
        first_at_release(situation, situation.pursuer.turn_radius, leader_path(situation))
        found = candidates(situation)
        for candidate in islice(found, 1):
            certify(candidate.trajectory, situation)
        constrained_path(found, beat=HORIZON)
        constrained_path(found, beat=HORIZON, until=now())
        time_is_up(now())
        least_bad(situation)
        restore(situation)

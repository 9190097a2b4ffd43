"""regular_planner(situation): the paper's own machine as a planner, with a certificate.

    tree of the encounter → nearest regular trajectory → its word, solved exactly → certificate

Reverse dynamic programming grows a tree for the ratios V_L/V_P, D/R and d_min/R; the path
from the nearest state that the tree knows gives the signs; the word they spell is solved in closed
form, as that path leads to the slot from its own state and not from here. If the solution does not
keep d_min, the tree's first pair is flown as it is, which is how the tree went round the limit, and
the rest is solved from its end. What is not certified then, the exact planner answers. So every
answer is certified, and most are the fastest path, though nothing proves it.

Trees are grown when first asked for, in about a quarter of a second, and kept: there is none to
ship, as each ratio of speeds wants its own. Ratios are rounded for that, which moves no path: the
tree only says which word to solve.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf
from time import perf_counter_ns

import numpy as np

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.words.branches import direct_time
from relguide.kernels.words.extremals import MAX_ROWS, WORDS, fly_piece, solve_word
from relguide.learn.tree.nearest import Lookup, lookup_in, neighbours
from relguide.learn.tree.regular_words import SIGN, RegularPiece, pieces_of, words_like
from relguide.learn.tree.reverse_dp import reverse_tree
from relguide.learn.tree.tree import TreeParameters, pairs_of
from relguide.maps.area import Encounter
from relguide.planning.candidate import SIGN_ROWS, Candidate, assemble
from relguide.planning.certificate import Certificate, certify
from relguide.planning.inputs import expect
from relguide.planning.levels import chooses_level
from relguide.planning.outcome import NoPlan, Optimality, Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame, slot_frame
from relguide.planning.words import HORIZON
from relguide.units import DEG

RATIO_STEP, LENGTH_STEP = 0.025, 0.25
"""What V_L/V_P, and D/R and d_min/R, are rounded to for a tree."""
LEAST_RATIO, MOST_RATIO = 0.15, 0.97
"""V_L/V_P of the encounters that trees are grown for."""
FARTHEST_LEADER = 15.0
"""A leader farther ahead of the slot is as good as this far [R]."""
FARTHEST = 1.0
"""From the nearest state of the tree: beyond, it knows nothing of a situation [R]."""
TREES = 16
"""Kept at a time: 10 MB each."""
TAS, BANK = 240.0, 25.0 * DEG
"""Of the pursuer that trees are grown for [m/s, rad]; only ratios count."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Ratios:
    """What an encounter's tree depends on, rounded."""

    speed: float
    """V_L/V_P."""
    slot: float
    """D/R."""
    limit: float
    """d_min/R."""


def regular_planner(situation: Situation) -> Plan | NoPlan:
    """The fastest path of the word that the nearest regular trajectory spells, certified.

    Returns:
        as `plan` does; its plans say by `planner` who gave them, and by `fell_back` if the tree
        could not. Of the tree's plans only the straight line to the slot is proved as a bound.
    """
    expect("situation", situation, Situation)
    started = perf_counter_ns()
    for candidate in propose(situation):
        certificate = certify(candidate.trajectory, situation)
        if certificate.holds:
            return _plan(situation, candidate, certificate, started)
    exact = plan(situation)
    if isinstance(exact, NoPlan):
        return exact
    return replace(exact, fell_back=True, compute_time=(perf_counter_ns() - started) * 1e-6)


def _plan(
    situation: Situation, candidate: Candidate, certificate: Certificate, started: int
) -> Plan:
    frame = slot_frame(situation, situation.leader.trajectory)
    least = max(direct_time(frame.x, frame.y, frame.alpha), frame.t_release)
    return Plan(
        situation=situation,
        trajectory=candidate.trajectory,
        word=candidate.word,
        certificate=certificate,
        optimality=Optimality(
            proof="bound", lower_bound=least * frame.radius / situation.pursuer.tas
        ),
        planner="regular_dp",
        compute_time=(perf_counter_ns() - started) * 1e-6,
    )


def propose(situation: Situation) -> Iterator[Candidate]:
    """The word of the nearest path; then that path's first pair, and the word of the rest.

    Whether they keep d_min is not asked here: `certify` judges that. The tree knows no levels.
    """
    frame = slot_frame(situation, situation.leader.trajectory)
    if not LEAST_RATIO <= frame.alpha <= MOST_RATIO or chooses_level(situation):
        return
    pairs = nearest_pairs(tree_for(ratios_of(situation, frame)), frame)
    if pairs is None:
        return
    for kept in (0, 1):
        found = _close(situation, frame, pieces_of(pairs[:kept]), pieces_of(pairs[kept:]))
        if found is not None:
            yield found


def _close(
    situation: Situation, frame: SlotFrame, flown: list[RegularPiece], rest: list[RegularPiece]
) -> Candidate | None:
    """Pieces flown as they are, and from their end the fastest path of the words of the rest."""
    x, y, h = frame.x, frame.y, frame.h
    for letter, amount in flown:
        x, y, h = fly_piece(Pose(x, y, h), SIGN[letter], amount)
    spent = sum(amount for _, amount in flown)
    seen = Pose(x - frame.alpha * spent, y, wrap(h))
    rows, room, n = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 4)), 0
    for word in words_like(rest):
        n = solve_word(seen, Velocity(frame.alpha, 0.0), Window(0.0, inf), word, room, rows, n)
    if n == 0:
        return None
    time, word, *amounts = rows[0].tolist()
    # one that would be early is the exact planner's: it finds how to wait
    arrival = (spent + time) * frame.radius / situation.pursuer.tas
    if spent + time < frame.t_release or arrival > HORIZON:
        return None
    signs = [SIGN[letter] for letter, _ in flown] + SIGN_ROWS[int(word)]
    name = "" if flown else WORDS[int(word)]
    return assemble(situation, frame, signs, [amount for _, amount in flown] + amounts, name)


def nearest_pairs(lookup: Lookup, frame: SlotFrame) -> list[list[float]] | None:
    """(ε, θ [rad], l [R]) of the nearest path's pairs, forward; `None` where the tree ends."""
    radius = lookup.tree.parameters.encounter.turn_radius
    place = (np.array([value]) for value in (frame.x * radius, frame.y * radius, frame.h))
    near = neighbours(lookup, *place)
    if near.distance[0] > FARTHEST:
        return None
    pairs = pairs_of(lookup.tree, near.nodes)[0]
    pairs[:, 2] /= radius
    if near.mirrored[0]:
        pairs[:, 0] *= -1.0
    found: list[list[float]] = pairs.tolist()
    return found


def ratios_of(situation: Situation, frame: SlotFrame) -> Ratios:
    """The encounter whose tree a situation is looked up in.

    In wind the slot is D behind the leader along its track, here as if along its heading.
    """
    leader = situation.slot_distance / frame.radius
    gap = leader - situation.min_separation / frame.radius
    slot = _round(min(leader, FARTHEST_LEADER), LENGTH_STEP)
    return Ratios(
        speed=min(_round(frame.alpha, RATIO_STEP), MOST_RATIO),
        slot=slot,
        limit=max(0.0, slot - _round(gap, LENGTH_STEP)),
    )


def _round(value: float, step: float) -> float:
    return round(value / step) * step


@lru_cache(maxsize=TREES)
def tree_for(ratios: Ratios) -> Lookup:
    """The tree of an encounter: of order 4, Δθ 20°, Δl and cells R/3, up to 24 R/V_P."""
    radius = Encounter(
        pursuer_tas=TAS, max_bank=BANK, leader_tas=TAS, slot_distance=0.0, min_separation=0.0
    ).turn_radius
    encounter = Encounter(
        pursuer_tas=TAS,
        max_bank=BANK,
        leader_tas=ratios.speed * TAS,
        slot_distance=ratios.slot * radius,
        min_separation=ratios.limit * radius,
    )
    return lookup_in(
        reverse_tree(
            TreeParameters(
                encounter=encounter,
                order=4,
                delta_theta=20.0 * DEG,
                delta_l=radius / 3.0,
                cell=radius / 3.0,
                horizon=24.0 * radius / TAS,
            )
        )
    )

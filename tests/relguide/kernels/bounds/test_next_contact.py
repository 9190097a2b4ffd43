"""The contact after a first one: no path that is flown from one to the other is left out."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from math import acos, cos, hypot, inf, pi

import numpy as np

from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.bounds.around import unknown_around
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.contact_tree import Problem, plant
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.junction import slide_turns
from relguide.kernels.bounds.next_contact import (
    ask_next,
    begin_following,
    is_passed_turning,
)
from relguide.kernels.bounds.round_time import times_round
from relguide.kernels.bounds.tangent_contacts import tangent_contacts
from relguide.kernels.contact.contact import contact_on
from relguide.kernels.contact.paths_to_contact import paths_by_words
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import ALL_WORDS, MAX_ROWS, SIGNS, fly_piece
from tests.relguide.kernels.bounds.test_junction import turning_scene

BEAT, LAST = 80.0, 12.0
"""Arrivals after this do not matter, and no word takes longer than that [R/V_P]."""

Pieces = list[tuple[float, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Passage:
    """A path to a contact, which keeps the limit, and on to another one in the same turn."""

    start: Pose
    scene: Scene
    first: Contact
    at: float
    """When it is there [R/V_P]."""
    then: Contact
    then_at: float
    """When it is at the other one [R/V_P]."""
    inward: bool
    """Whether the turn is toward the leader."""


def words_between(
    pose: Pose, t: float, scene: Scene, contact: Contact
) -> Iterator[tuple[float, Pieces]]:
    """When words from a pose are at a contact, and their pieces that are no shorter than 1e-3."""
    rows = np.empty((MAX_ROWS, 5))
    for k in range(paths_by_words(pose, t, scene, contact, ALL_WORDS, 0.0, LAST, rows)):
        signs, amounts = SIGNS[int(rows[k, 1])], rows[k, 2:]
        pieces = [
            (float(sign), float(amount))
            for sign, amount in zip(signs, amounts, strict=True) if amount > 1e-3
        ]  # fmt: skip
        end = pose
        for sign, amount in pieces:
            end = fly_piece(end, sign, amount)
        took = sum(amount for _, amount in pieces)
        there = contact_on(scene, contact, t + took)
        turning = all(sign != 0.0 for sign in signs)
        has_costate = not turning or amounts[1] > max(amounts[0], amounts[2])
        if (
            len(pieces) == 3 and has_costate and took < LAST
            and hypot(end.x - there.x, end.y - there.y) < 1e-5
        ):  # fmt: skip
            yield t + took, pieces


def keeps_clear(pose: Pose, t: float, pieces: Pieces, scene: Scene) -> bool:
    """Whether a path from a time on keeps the limit."""
    clear = True
    for sign, amount in pieces:
        for along in np.arange(0.0, amount, 5e-3):
            at = fly_piece(pose, sign, float(along))
            there = leader_at(scene, piece_at(scene.leader, t + along), t + along)
            clear &= hypot(at.x - there.x, at.y - there.y) > scene.d_min - 1e-6
        pose, t = fly_piece(pose, sign, amount), t + amount
    return clear


def can_be_passed(scene: Scene, contact: Contact, turn: float) -> bool:
    """Whether the separation does not fall at a contact in a turn: see `junction`."""
    piece, bearing, side = contact
    k, _ = slide_turns(scene, Cell(piece, side, bearing, 0.0, 0.0, 0.0))
    return k >= turn * side


def passages(seed: int) -> Iterator[Passage]:
    """At random, without end."""
    rng = np.random.default_rng(seed)
    while True:
        alpha, d_min = rng.uniform(0.4, 0.9), rng.uniform(0.4, 3.0)
        scene = turning_scene(rng.uniform(-2.0, 2.0), alpha, d_min)
        start = Pose(*rng.uniform(-5.0, 5.0, 2), rng.uniform(-pi, pi))
        side = float(rng.choice((1.0, -1.0)))
        first = Contact(int(rng.integers(2)), rng.uniform(-pi, pi), side)
        for at, pieces in words_between(start, 0.0, scene, first):
            if not keeps_clear(start, 0.0, pieces, scene):
                continue
            toward, pose = pieces[-1][0] * side, contact_on(scene, first, at)
            if toward == 0.0 or not can_be_passed(scene, first, pieces[-1][0]):
                continue
            # the turn goes on, away from the leader for so long at least
            least = 2.0 * acos(alpha * cos(first.bearing)) if toward < 0.0 else 0.0
            piece = int(rng.integers(first.piece, 3))
            then = Contact(piece, rng.uniform(-pi, pi), float(rng.choice((1.0, -1.0))))
            for then_at, on in words_between(pose, at, scene, then):
                goes_on = on[0][0] == pieces[-1][0] and on[0][1] > least
                touches = can_be_passed(scene, then, on[-1][0])
                if goes_on and touches and keeps_clear(pose, at, on, scene):
                    yield Passage(
                        start=start, scene=scene, first=first, at=at, then=then, then_at=then_at,
                        inward=toward > 0.0,
                    )  # fmt: skip


def cell_round(scene: Scene, contact: Contact, t: float, half: float) -> Cell:
    """A cell with a contact in its middle, as far as the leader's piece lasts."""
    start, end = (*scene.leader[:, 0], inf)[contact.piece : contact.piece + 2]
    window = max(t - half, start), min(t + half, end)
    return Cell(contact.piece, contact.side, contact.bearing, half, *window)


def may_follow(passage: Passage, half: float, other: Cell) -> bool | None:
    """Whether the contact after the passage's first one may be in another cell.

    `None` where it is not known how the first one is passed, by a cell so large round it.
    """
    scene, here = passage.scene, Goal(0.0, 0.0, False)
    table = times_round(scene.alpha, scene.d_min)
    tangents = tangent_contacts(passage.start, scene, BEAT)
    problem = Problem(
        passage.start, scene, here, table, BEAT, 1e-4, unknown_around(), tangents
    )  # fmt: skip
    first = plant(np.array([cell_round(scene, passage.first, passage.at, half)]), 1)
    last = plant(np.array([other]), 1)
    if not is_passed_turning(first, problem, 0):
        return None
    return not ask_next(begin_following(1), first, last, problem, 0)


def test_a_next_contact_that_is_flown_to_is_never_left_out() -> None:
    rng, sides = np.random.default_rng(2), set()
    for passage in islice(passages(1), 200):
        half = 10.0 ** rng.uniform(-4.0, -2.0)
        other = cell_round(passage.scene, passage.then, passage.then_at, half)
        assert may_follow(passage, half, other) is not False
        sides.add(passage.inward)
    assert sides == {True, False}


def test_most_others_are_left_out() -> None:
    rng, left = np.random.default_rng(3), []
    for passage in islice(passages(4), 100):
        there = Contact(passage.then.piece, rng.uniform(-pi, pi), float(rng.choice((1.0, -1.0))))
        other = cell_round(passage.scene, there, passage.then_at, 1e-3)
        left.append(may_follow(passage, 1e-3, other))
    assert left.count(False) > 80

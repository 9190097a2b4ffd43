"""The contact after a first one: no path that is flown from one to the other is left out."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from math import acos, cos, inf, pi

import numpy as np

from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.around import unknown_around
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.contact_tree import Problem, plant
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.junction import slide_turns
from relguide.kernels.bounds.next_contact import (
    ask_next,
    begin_following,
    is_alone,
    is_passed_turning,
)
from relguide.kernels.bounds.round_time import times_round
from relguide.kernels.bounds.tangent_contacts import anything_tangent, tangent_contacts
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import contact_on
from relguide.kernels.contact.paths_to_contact import paths_by_words
from relguide.kernels.words.extremals import ALL_WORDS, MAX_ROWS, SIGNS
from tests.costates import with_costate
from tests.relguide.kernels.bounds.test_junction import turning_scene

BEAT, LAST = 80.0, 12.0
"""Arrivals after this do not matter, and no contact is later than that [R/V_P]."""


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


def words_between(pose: Pose, t: float, scene: Scene, contact: Contact) -> list[FloatArray]:
    """Words of three pieces from a pose to a contact that have a costate and keep the limit."""
    rows = np.empty((MAX_ROWS, 5))
    n = paths_by_words(pose, t, scene, contact, ALL_WORDS, 0.0, LAST, rows)
    clear = [row for row in with_costate(rows[:n]) if word_clears(pose, t, row, scene)]
    return [row for row in clear if min(row[2:]) > 1e-3 and row[0] < LAST]


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
        for word in words_between(start, 0.0, scene, first):
            at, turn = word[0], SIGNS[int(word[1]), 2]
            if turn == 0.0 or not can_be_passed(scene, first, turn):
                continue
            # the turn goes on, away from the leader for so long at least
            inward = bool(turn == side)
            least = 0.0 if inward else 2.0 * acos(alpha * cos(first.bearing))
            piece = int(rng.integers(first.piece, 3))
            then = Contact(piece, rng.uniform(-pi, pi), float(rng.choice((1.0, -1.0))))
            for on in words_between(contact_on(scene, first, at), at, scene, then):
                begins, _, ends = SIGNS[int(on[1])]
                if begins == turn and on[2] > least and can_be_passed(scene, then, ends):
                    yield Passage(
                        start=start, scene=scene, first=first, at=at, then=then, then_at=on[0],
                        inward=inward,
                    )  # fmt: skip


def cell_round(scene: Scene, contact: Contact, t: float, half: float) -> Cell:
    """A cell with a contact in its middle, as far as the leader's piece lasts."""
    start, end = (*scene.leader[:, 0], inf)[contact.piece : contact.piece + 2]
    window = max(t - half, start), min(t + half, end)
    return Cell(contact.piece, contact.side, contact.bearing, half, *window)


def problem_of(passage: Passage, tangents: FloatArray) -> Problem:
    """How soon can a path be where the slot is at first?"""
    scene, here = passage.scene, Goal(0.0, 0.0, False)
    table = times_round(scene.alpha, scene.d_min)
    return Problem(passage.start, scene, here, table, BEAT, 1e-4, unknown_around(), tangents)


def may_follow(passage: Passage, half: float, other: Cell) -> bool | None:
    """Whether the contact after the passage's first one may be in another cell.

    `None` where it is not known how the first one is passed, by a cell so large round it.
    """
    problem = problem_of(passage, tangent_contacts(passage.start, passage.scene, BEAT))
    first = plant(np.array([cell_round(passage.scene, passage.first, passage.at, half)]), 1)
    last = plant(np.array([other]), 1)
    if not is_passed_turning(first, problem, 0):
        return None
    return not ask_next(begin_following(1), first, last, problem, 0)


def test_a_next_contact_that_is_flown_to_is_never_left_out() -> None:
    rng, asked = np.random.default_rng(2), Counter[bool]()
    for passage in islice(passages(1), 200):
        half = 10.0 ** rng.uniform(-4.0, -2.0)
        other = cell_round(passage.scene, passage.then, passage.then_at, half)
        may_be = may_follow(passage, half, other)
        assert may_be is not False
        asked[passage.inward] += may_be is not None
    assert min(asked[True], asked[False]) > 40


def test_most_others_are_left_out() -> None:
    rng, left = np.random.default_rng(3), []
    for passage in islice(passages(4), 100):
        there = Contact(passage.then.piece, rng.uniform(-pi, pi), float(rng.choice((1.0, -1.0))))
        other = cell_round(passage.scene, there, passage.then_at, 1e-3)
        left.append(may_follow(passage, 1e-3, other))
    assert left.count(False) > 80


def test_nothing_is_said_of_a_contact_from_which_a_path_may_slide() -> None:
    """Of a larger cell it was asked for those only where nobody can, and what was found is kept."""
    sliding = 0
    for passage in islice(passages(4), 100):
        cell = np.array([cell_round(passage.scene, passage.first, passage.at, 0.01)])
        nowhere = np.array([cell_round(passage.scene, passage.first, passage.at, 1e-6)])
        following, last, asked = begin_following(1), plant(nowhere, 1), plant(cell, 1)
        assert ask_next(following, asked, last, problem_of(passage, np.empty((0, 5))), 0)
        for tangents in (np.empty((0, 5)), anything_tangent()):
            first, problem = plant(cell, 1), problem_of(passage, tangents)
            first.joined[:] = asked.joined
            known = is_alone(following, first, last, problem, 0, 0)
            assert known == is_passed_turning(first, problem, 0)
            sliding += not known
    assert sliding > 3

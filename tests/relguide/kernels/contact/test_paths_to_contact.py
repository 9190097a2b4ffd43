"""All words to a contact while the leader turns: none that a finer look would add."""

from math import cos, hypot, inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.contact.contact import contact_at
from relguide.kernels.contact.paths_to_contact import earliest_arrival, paths_to_contact
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece
from tests.situations import headings, numbers

ALPHA, D_MIN = 0.7, 1.2


def turning_leader(
    rate: float, parts: int, *, alpha: float = ALPHA, d_min: float = D_MIN, lasts: float = 2.5
) -> Scene:
    """A turn that lasts so long [R/V_P], in so many pieces, then straight."""
    leader = np.zeros((parts + 1, 5))
    leader[:, 0] = np.linspace(0.0, lasts, parts + 1)
    leader[:parts, 4] = rate
    leader[0, 1] = 2.0
    for i in range(1, parts + 1):
        leader[i, 1:4] = leader_at(Scene(leader, alpha, d_min, 0.0), i - 1, leader[i, 0])
    return Scene(leader, alpha, d_min, 0.0)


def paths(start: Pose, scene: Scene, bearing: float, side: float) -> list[list[float]]:
    """Rows to a contact on any piece but the last, in order of time."""
    rows, found = np.empty((MAX_ROWS, 5)), []
    for i in range(len(scene.leader) - 1):
        n = paths_to_contact(start, 0.0, scene, Contact(i, bearing, side), inf, rows)
        found += rows[:n].tolist()
    return sorted(found)


@given(
    x=numbers(-2.0, 4.0), y=numbers(-3.0, 3.0), h=headings, bearing=headings,
    side=st.sampled_from([1.0, -1.0]), rate=st.sampled_from([-1.2, -0.4, 0.7]),
)  # fmt: skip
def test_words_to_a_contact_on_a_turn_lead_there_and_none_is_missed(
    x: float, y: float, h: float, bearing: float, side: float, rate: float
) -> None:
    start, scene = Pose(x, y, h), turning_leader(rate, 1)
    coarse = paths(start, scene, bearing, side)
    for time, word, *amounts in coarse:
        end = start
        for sign, amount in zip(SIGNS[int(word)], amounts, strict=True):
            end = fly_piece(end, sign, amount)
        there = contact_at(scene, time, bearing, side)
        assert sum(amounts) == pytest.approx(time, abs=1e-8)
        assert hypot(end.x - there.x, end.y - there.y) < 1e-6
        assert cos(end.h - there.h) > 1.0 - 1e-9
    # in forty pieces the same turn is looked at forty times as finely
    fine = paths(start, turning_leader(rate, 40), bearing, side)
    for time, word, *_ in fine:
        nearest = min((abs(time - t) for t, w, *_ in coarse if w == word), default=inf)
        assert nearest < 1e-5, (time, word)


@given(
    x=numbers(-2.0, 4.0), y=numbers(-3.0, 3.0), h=headings, bearing=headings,
    side=st.sampled_from([1.0, -1.0]), rate=st.sampled_from([-1.2, -0.4, 0.7]),
    beat=numbers(0.0, 3.0),
)  # fmt: skip
def test_no_word_arrives_before_the_earliest_time_and_a_time_to_beat_only_cuts_it_short(
    x: float, y: float, h: float, bearing: float, side: float, rate: float, beat: float
) -> None:
    start, scene = Pose(x, y, h), turning_leader(rate, 1)
    contact = Contact(0, bearing, side)
    earliest = earliest_arrival(start, 0.0, scene, contact, inf)
    for time, *_ in paths(start, scene, bearing, side):
        assert earliest <= time + 1e-9
    in_time = earliest_arrival(start, 0.0, scene, contact, beat)
    assert in_time == earliest if earliest < beat else in_time >= beat


def test_a_word_is_found_to_where_it_leads() -> None:
    """The leader is put where a word drawn at random comes to a contact."""
    rng, rows = np.random.default_rng(8), np.empty((MAX_ROWS, 5))
    for _ in range(3_000):
        word, amounts = int(rng.integers(6)), rng.uniform(0.0, 6.2, 3)
        # others exist hardly longer than for that moment
        amounts[1] = rng.uniform(3.6, 6.0) if word > 3 else 0.3 + rng.exponential(2.0)
        start, time = Pose(0.0, 0.0, rng.uniform(0.0, TWO_PI)), float(amounts.sum())
        end = start
        for sign, amount in zip(SIGNS[word], amounts, strict=True):
            end = fly_piece(end, sign, amount)
        rate, begun = rng.uniform(-1.5, 1.5), max(time - rng.uniform(0.1, 4.0), 0.0)
        bearing, side = rng.uniform(0.0, TWO_PI), rng.choice([-1.0, 1.0])
        leader = np.array([[begun, 0.0, 0.0, 0.0, rate], [time + 0.1, 0.0, 0.0, 0.0, 0.0]])
        scene = Scene(leader, rng.uniform(0.5, 0.95), rng.uniform(0.3, 4.0), 0.0)
        # first turned, then moved to where the word ends
        leader[0, 3] = end.h - contact_at(scene, time, bearing, side).h
        there = contact_at(scene, time, bearing, side)
        leader[0, 1], leader[0, 2] = end.x - there.x, end.y - there.y
        n = paths_to_contact(start, 0.0, scene, Contact(0, bearing, side), inf, rows)
        assert any(row[1] == word and abs(row[0] - time) < 1e-6 for row in rows[:n])


@pytest.mark.parametrize(
    ("leader", "contact", "start", "word"),
    [
        # the first and the last turn both pass 0 between two looks
        ((0.99, 1.65, -1.12, 2.75), (2.7, -1.0), (1.76, 1.9, 5.24), 0),
        # the circles part so that a word begins to exist, and its last turn passes 0
        ((0.82, 1.62, -1.26, 2.88), (1.05, 1.0), (3.32, -2.59, 1.61), 3),
        ((0.53, 1.95, 2.16, 2.02), (5.5, -1.0), (1.85, 1.73, 0.82), 2),
        # just before a word of three turns ceases to exist
        ((0.83, 3.14, -1.97, 3.19), (0.39, 1.0), (6.19, 1.58, 3.57), 4),
        ((0.75, 1.53, 1.66, 3.79), (5.38, 1.0), (0.92, 0.79, 3.43), 5),
        # the contact comes past and goes between two looks: two words, and at both looks too long
        ((0.66, 3.43, 1.9, 3.22), (3.93, -1.0), (-2.15, 4.22, 4.54), 0),
        ((0.77, 2.24, -1.97, 3.19), (5.18, -1.0), (2.17, 3.05, 4.59), 4),
        # the circles pass each other closely, and turns change by half a turn one way or the other
        ((0.55, 1.68, -1.78, 2.5), (5.05, 1.0), (1.828, -1.671, 6.237), 1),
        ((0.89, 2.25, -1.81, 2.5), (5.25, -1.0), (2.892, -2.066, 3.91), 4),
    ],
)
def test_no_word_is_missed_between_two_looks(
    leader: tuple[float, ...], contact: tuple[float, float], start: tuple[float, float, float],
    word: int,
) -> None:  # fmt: skip
    """Of 1,898 words to contacts drawn at random 38 were missed, mostly with hardly a turn."""
    alpha, d_min, rate, lasts = leader
    coarse, fine = (
        paths(
            Pose(*start),
            turning_leader(rate, parts, alpha=alpha, d_min=d_min, lasts=lasts),
            *contact,
        )
        for parts in (1, 40)
    )
    assert word in [int(row[1]) for row in fine]
    for time, number, *_ in fine:
        nearest = min((abs(time - t) for t, w, *_ in coarse if w == number), default=inf)
        assert nearest < 1e-5, (time, number)

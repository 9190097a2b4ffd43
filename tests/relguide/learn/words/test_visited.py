"""Situations of closed loops: flown, the same every time, and as the planner was asked them."""

from math import inf

import numpy as np
import pytest

from relguide import Situation, candidates, plan
from relguide.flying.documents import FlightEnded
from relguide.flying.flight import fly
from relguide.learn.network_planner import network_planner
from relguide.learn.words.branch_labels import canonical, times_of
from relguide.learn.words.visited import (
    KEPT,
    STEP,
    Floats,
    collect_situations,
    draw_flight,
    draw_visited,
    listen_to,
    row_of,
)
from tests.relguide.learn.words.networks import network

BOX = {"max_range": 40.0, "min_ratio": 0.6, "max_ratio": 0.97}


def some(size: int, seed: int = 3) -> Floats:
    return draw_visited(np.random.default_rng(seed), size, **BOX)


@pytest.mark.slow
def test_as_many_as_asked_for_all_in_the_box_and_the_same_every_time() -> None:
    rows = some(2 * KEPT + 7)
    assert rows.shape == (2 * KEPT + 7, 6)
    assert np.array_equal(rows, some(2 * KEPT + 7))
    assert not np.array_equal(rows, some(2 * KEPT + 7, seed=4))
    x, y, h, alpha, slot, limit = rows.T
    assert np.hypot(x, y).max() <= 40.0
    assert 0.6 <= alpha.min() <= alpha.max() <= 0.97
    assert 0.0 <= h.min() <= h.max() < 2.0 * np.pi
    assert (slot >= limit).all()
    assert limit.min() > 0.0
    assert len(np.unique(rows, axis=0)) > 0.95 * len(rows)
    assert len(some(0)) == 0


@pytest.mark.slow
def test_a_row_is_the_situation_that_was_asked() -> None:
    asked = [
        situation
        for seed in range(4)
        for situation in collect_situations(draw_flight(np.random.default_rng(seed)), plan)
        if not situation.leader.intent
    ]
    assert len(asked) > 50
    rows = np.array([row_of(situation) for situation in asked])
    units = np.array([s.pursuer.turn_radius / s.pursuer.tas for s in asked])
    least = times_of(canonical(rows[:, :4])).min(axis=1) * units
    exact = np.array([candidates(s).bound if len(candidates(s)) else inf for s in asked])
    within = least < 12 * 3600.0
    assert within.mean() > 0.9
    assert least[within] == pytest.approx(exact[within], rel=1e-9)


@pytest.mark.slow
def test_flights_are_of_every_kind_and_arrive() -> None:
    known, joined, turned = set(), 0, 0
    for seed in range(8):
        flight = draw_flight(np.random.default_rng(seed))
        *_, end = fly(flight, plan, step=STEP, sample_period=1.0)
        assert isinstance(end, FlightEnded)
        # a leader that turns without a word may turn towards the pursuer
        if flight.intent_known:
            assert end.results[0].least_separation > 0.99 * flight.situation.min_separation
        known.add(flight.intent_known)
        joined += end.results[0].joined
        headings = [s.leader.heading for s in collect_situations(flight, plan)]
        turned += np.ptp(np.unwrap(headings)) > 0.1
    assert known == {True, False}
    assert joined > 3
    assert turned > 3


@pytest.mark.slow
def test_who_flies_decides_what_is_met() -> None:
    asked: list[Situation] = []
    planner = listen_to(network_planner(network()), asked.append)
    rows = draw_visited(np.random.default_rng(3), 20, **BOX, planner=planner)
    assert len(rows) == 20
    assert set(map(tuple, rows)) <= {row_of(situation) for situation in asked}


@pytest.mark.slow
def test_flights_that_never_come_there_are_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("relguide.learn.words.visited.FLIGHTS", 2)
    with pytest.raises(ValueError, match=r"2 flights met nothing within 1e-06 R and speed ratios"):
        draw_visited(np.random.default_rng(0), 1, max_range=1e-6, min_ratio=0.6, max_ratio=0.7)

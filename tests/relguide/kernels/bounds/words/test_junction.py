"""How a contact with others after it is passed: against costates and paths flown step by step."""

from math import acos, atan2, cos, hypot, inf, pi, sin, sqrt

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.bounds.words.junction import (
    apart_by,
    away_for,
    beyond_outward,
    can_touch,
    slide_turns,
)
from relguide.kernels.contact.contact import contact_heading, contact_on
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import fly_piece
from tests.situations import numbers

signs = st.sampled_from([1.0, -1.0])


def turning_scene(rate: float, alpha: float, d_min: float) -> Scene:
    """A leader that turns from t = 1 to 6, and then keeps straight."""
    leader = np.array(
        [[0.0, 0.0, 0.0, 0.4, 0.0], [1.0, alpha * cos(0.4), alpha * sin(0.4), 0.4, rate],
         [6.0, 0.0, 0.0, 0.4 + 5.0 * rate, 0.0]]
    )  # fmt: skip
    scene = Scene(leader, alpha, d_min, 0.0)
    end = leader_at(scene, 1, 6.0)
    leader[2, 1:4] = end.x, end.y, end.h
    return scene


@st.composite
def turning(draw: st.DrawFn) -> tuple[Scene, Cell]:
    """A leader that turns, and contacts while it does."""
    rate, alpha, d_min = draw(numbers(-3.0, 3.0)), draw(numbers(0.2, 0.98)), draw(numbers(0.3, 4.0))
    parts = 2 ** draw(st.integers(1, 14))
    k, width = draw(st.integers(0, 4 * parts - 1)), 0.5 * pi / parts
    start = draw(numbers(1.0, 5.0))
    window = min(draw(numbers(0.0, 1.0)), width)
    scene = turning_scene(rate, alpha, d_min)
    return scene, Cell(1, draw(signs), (k + 0.5) * width - pi, 0.5 * width, start, start + window)


@given(asked=turning(), share=numbers(-1.0, 1.0))
def test_who_slides_turns_as_it_says(asked: tuple[Scene, Cell], share: float) -> None:
    scene, cell = asked
    least, most = slide_turns(scene, cell)
    b, step = cell.bearing + share * cell.half, 1e-6
    across = sqrt(1.0 - (scene.alpha * cos(b)) ** 2)
    rate = scene.leader[1, 4]
    drift = (cell.side * across + scene.alpha * sin(b)) / scene.d_min - rate
    slope = contact_heading(b + step, cell.side, scene.alpha)
    slope -= contact_heading(b - step, cell.side, scene.alpha)
    toward = cell.side * (rate + slope / (2.0 * step) * drift)
    assert least - 1e-4 <= toward <= most + 1e-4
    # just after a contact the separation grows by who turns less toward the leader, and only then
    t = cell.start
    at = contact_on(scene, Contact(1, b, cell.side), t)
    before, there = leader_at(scene, 1, t), leader_at(scene, 1, t + 1e-3)
    for turn in (1.0, 0.0, -1.0):
        on = fly_piece(at, cell.side * turn, 1e-3)
        grown = hypot(on.x - there.x, on.y - there.y) - hypot(at.x - before.x, at.y - before.y)
        expected = 0.5e-6 * across * (toward - turn)
        assert abs(grown - expected) < 2e-8 * (1.0 + 1.0 / scene.d_min) ** 2 * (1.0 + rate * rate)
    if toward > -1.0:
        assert can_touch(scene, cell)


@given(
    middle=st.one_of(st.just(inf), numbers(0.3, 2.0 * pi)), share=numbers(0.01, 0.99),
    outward=numbers(0.1, pi - 0.1), change=st.one_of(numbers(0.0, 3.0), numbers(3.0, 1e4)),
)  # fmt: skip
def test_a_turn_away_goes_on_for_what_is_left_of_it_or_beyond_outward(
    middle: float, share: float, outward: float, change: float
) -> None:
    """A left turn, after a straight or a right turn of `middle`, past something on its right."""
    whole = min(middle, 2.0 * pi)
    turned = share * whole
    # the costate's angle from the heading where the turn begins: 0 after a straight, or λ_ψ would
    # not vanish where the middle turn begins as well as where it ends
    began = 0.0 if middle == inf else pi - 0.5 * middle
    at = began + turned
    # λ_ψ = cos(began) − cos(at) for λ_p = 1 along angle 0; the heading is `outward` from outward
    toward = at - (pi - outward)  # direction to the leader: pi − outward to the right
    x, y = 1.0 + change * cos(toward), change * sin(toward)
    size, along = hypot(x, y), atan2(y, x)
    here = cos(began) - cos(at)
    took = np.linspace(0.0, 2.0 * pi, 200_001)
    open_intervals = here + size * (cos(at - along) - np.cos(at - along + took))
    ends = took[1:][open_intervals[1:] < 0.0]
    end = ends[0] if len(ends) else 2.0 * pi
    assert end >= min(whole - turned, 2.0 * outward) - 1e-3


def test_beyond_outward_is_twice_the_least_angle_of_the_heading_from_outward() -> None:
    rng = np.random.default_rng(3)
    for _ in range(200):
        alpha, half = rng.uniform(0.1, 0.99), rng.uniform(0.0, 0.25 * pi)
        quadrant = rng.integers(4)
        cell = Cell(0, rng.choice([1.0, -1.0]), (quadrant + 0.5) * 0.5 * pi - pi, half, 0.0, inf)
        scene = Scene(np.zeros((1, 5)), alpha, 1.0, 0.0)
        bearings = np.linspace(cell.bearing - half, cell.bearing + half, 50)
        angles = [acos(alpha * cos(b)) for b in bearings]
        assert np.isclose(beyond_outward(scene, cell, 1.0), 2.0 * min(angles))
        assert np.isclose(beyond_outward(scene, cell, -1.0), 2.0 * (pi - max(angles)))


@given(
    asked=turning(), pace=signs, shares=st.tuples(numbers(-1.0, 1.0), numbers(0.0, 1.0)),
    turns=st.lists(st.tuples(numbers(-1.0, 1.0), numbers(0.01, 1.0)), max_size=4),
    first=st.sampled_from([1.0, 0.9, 0.0, -1.0]),
)  # fmt: skip
def test_for_a_while_there_is_no_other_contact(
    asked: tuple[Scene, Cell], pace: float, shares: tuple[float, float],
    turns: list[tuple[float, float]], first: float,
) -> None:  # fmt: skip
    scene, cell = asked
    apart = apart_by(scene, cell, pace)
    assume(apart > 0.0)
    t = cell.start + shares[1] * (cell.end - cell.start)
    bearing = cell.bearing + shares[0] * cell.half
    at = contact_on(scene, Contact(1, bearing, cell.side), t)
    took = 0.0
    for turn, lasts in [*turns, (first, pi)] if turns else [(first, pi)]:
        begun = at
        for along in np.linspace(0.0, min(lasts, apart - took), 60)[1:]:
            h = begun.h + pace * cell.side * turn * along
            if abs(turn) < 1e-6:
                at = fly_piece(begun, 0.0, pace * along)
            else:
                # a turn of another radius
                r = cell.side / turn
                x = begun.x + r * (sin(h) - sin(begun.h))
                at = Pose(x, begun.y - r * (cos(h) - cos(begun.h)), h)
            now = t + pace * (took + along)
            there = leader_at(scene, piece_at(scene.leader, now), now)
            assert hypot(at.x - there.x, at.y - there.y) > scene.d_min - 1e-9
        took += lasts
        if took >= apart:
            break


@given(
    asked=turning(), pace=signs, turn=numbers(0.1, 6.0), share=numbers(-1.0, 1.0),
    late=numbers(0.0, 1.0),
)  # fmt: skip
def test_who_turns_away_does_not_touch_again_so_soon(
    asked: tuple[Scene, Cell], pace: float, turn: float, share: float, late: float
) -> None:
    scene, cell = asked
    away = away_for(scene, cell, pace, turn)
    assert 0.0 <= away <= turn
    t = cell.start + late * (cell.end - cell.start)
    at = contact_on(scene, Contact(1, cell.bearing + share * cell.half, cell.side), t)
    for took in np.linspace(0.0, away, 200)[1:-1]:
        on = fly_piece(at, -cell.side, pace * took)
        then = t + pace * took
        assume(then >= 0.0)
        there = leader_at(scene, piece_at(scene.leader, then), then)
        assert hypot(on.x - there.x, on.y - there.y) > scene.d_min - 1e-9


def test_a_turn_away_is_followed_until_it_touches_again() -> None:
    """From a cell that holds hardly more than one contact, it is said nearly to the moment."""
    rng, again = np.random.default_rng(8), 0
    for _ in range(200):
        alpha, d_min, side = rng.uniform(0.3, 0.95), rng.uniform(0.3, 3.0), rng.choice((-1.0, 1.0))
        scene = Scene(np.array([[0.0, 0.0, 0.0, 0.0, 0.0]]), alpha, d_min, 0.0)
        bearing = rng.uniform(-pi, pi)
        away = away_for(scene, Cell(0, side, bearing, 1e-9, 0.0, inf), 1.0, 6.0)
        at = contact_on(scene, Contact(0, bearing, side), 0.0)
        times = np.arange(0.02, 6.0, 1e-3)
        flown = [fly_piece(at, -side, float(t)) for t in times]
        gaps = [hypot(on.x - alpha * t, on.y) - d_min for on, t in zip(flown, times, strict=True)]
        touches = next((t for t, gap in zip(times, gaps, strict=True) if gap <= 0.0), 6.0)
        assert away <= touches
        assert away > touches - 5e-3
        again += touches < 6.0
    assert again > 20


def test_who_weaves_may_touch_sooner_than_who_turns_toward_a_leader_behind() -> None:
    scene = Scene(np.array([[0.0, 0.0, 0.0, 0.0, 0.0]]), 0.796687209252521, 1.205743399071415, 0.0)
    bearing, before = 2.678876315846655, 2.623071922969844
    at = contact_on(scene, Contact(0, bearing, 1.0), 0.0)
    took = 0.0
    for sign, turn in ((1.0, 0.06283055), (-1.0, 2.21554205), (1.0, 0.62477048)):
        at, took = fly_piece(at, sign, -turn), took + turn
    earlier = contact_on(scene, Contact(0, before, -1.0), -took)
    assert np.allclose(at[:2], earlier[:2], atol=1e-5)
    for half in (1e-3, 1e-6):
        assert 0.1 < apart_by(scene, Cell(0, 1.0, bearing, half, 0.0, 0.0), -1.0) < took


def test_contacts_are_known_to_be_apart_for_more_than_a_moment() -> None:
    """Paths of a cell hardly part at first: the separation from the leader grows alike on all."""
    for rate, alpha, d_min, bearing, ahead, back in (
        (2.0, 0.8, 0.8, -2.75, 0.15, 2.0),
        (2.0, 0.8, 0.8, -0.5, 1.5, 0.4),
        (-1.0, 0.8, 3.0, 0.5, 1.5, 0.1),
    ):
        scene, cell = turning_scene(rate, alpha, d_min), Cell(1, 1.0, bearing, 1e-3, 2.0, 2.001)
        assert apart_by(scene, cell, 1.0) > ahead
        assert apart_by(scene, cell, -1.0) > back

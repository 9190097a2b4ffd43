"""The turns of a track, and whether an aircraft begins them."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.atc.track import Track
from relguide.atc.turns import LEAST, AwaitedTurn, await_turn, turns
from relguide.units import DEG
from tests.relguide.atc.tracks import seen_on, track_of_legs, tracks, turning_legs


@given(
    st.sampled_from((-1, 1)),
    st.sampled_from((20.0, 90.0, 200.0, 340.0)),
    st.sampled_from((0.5, 1.0, 2.5)),
)
def test_a_turn_is_found_with_its_side_and_its_times(side: int, turned: float, rate: float) -> None:
    (turn,) = turns(track_of_legs(turning_legs(side=side, turned=turned, rate=rate)))
    assert turn.side == side
    assert turn.begins == pytest.approx(120.0)
    assert turn.seen == pytest.approx(120.0 + 5.0 / rate, abs=1.0)
    assert turn.ends == pytest.approx(120.0 + turned / rate)
    assert turn.before == pytest.approx(0.0)
    assert turn.after == pytest.approx(side * turned * DEG % (2.0 * pi))


def test_a_straight_has_no_turn_and_bends_of_less_are_none() -> None:
    assert turns(track_of_legs([(100.0, 1.0, 200.0)] * 3)) == ()
    assert turns(track_of_legs(turning_legs(turned=14.0))) == ()


def test_what_turns_back_or_waits_is_two_turns() -> None:
    there = [(2.0, 2.0 * k * DEG, 200.0) for k in range(20)]
    back = [(2.0, (38.0 - 2.0 * k) * DEG, 200.0) for k in range(1, 20)]
    first, second = turns(track_of_legs([*there, *back, (60.0, 0.0, 200.0)]))
    assert (first.side, second.side) == (1, -1)
    on = [(2.0, (38.0 + 2.0 * k) * DEG, 200.0) for k in range(1, 20)]
    one, other = turns(track_of_legs([*there, (40.0, 38.0 * DEG, 200.0), *on]))
    assert (one.side, other.side) == (1, 1)


@given(tracks())
def test_mirrored_its_turns_go_to_the_other_side(track: Track) -> None:
    found = turns(track)
    mirrored = turns(replace(track, x=-track.x))
    assert [turn.side for turn in mirrored] == [-turn.side for turn in found]
    assert np.allclose([turn[:3] for turn in mirrored], [turn[:3] for turn in found])
    for turn in found:
        assert turn.begins <= turn.seen <= turn.ends
    assert LEAST > 0.0


def awaited(track: Track, flown: Track) -> list[AwaitedTurn]:
    """What an aircraft that flies another track makes of the turns of its own."""
    found: list[AwaitedTurn] = []
    for t in range(100, 250):
        found.append(await_turn(found[-1] if found else None, track, seen_on(flown, float(t))))
    return found


def test_who_flies_its_path_begins_each_turn_at_once() -> None:
    track = track_of_legs(turning_legs())
    assert not any(one.wrong for one in awaited(track, track))
    late = [one for one in awaited(track, track) if one.turn is not None and not one.begun]
    assert len(late) <= 7


def test_who_turns_to_the_other_side_is_wrong_until_it_flies_as_the_path_does() -> None:
    track = track_of_legs(turning_legs(side=1))
    other = track_of_legs(turning_legs(side=-1))
    found = awaited(track, other)
    assert any(one.wrong and not one.begun for one in found)
    assert not any(one.begun for one in found)


def test_a_turn_under_way_at_the_first_look_is_taken_as_begun() -> None:
    track = track_of_legs(turning_legs(turned=300.0))
    for t in (150.0, 250.0, 400.0):
        assert await_turn(None, track, seen_on(track, t)).begun
    assert not await_turn(None, track, seen_on(track, 121.0)).begun
    assert await_turn(None, track, seen_on(track, 50.0)).turn is None

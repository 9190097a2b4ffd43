"""Heights that are certain: where nothing counts, no flight within the tolerances is near."""

from itertools import pairwise
from math import inf

import numpy as np
import pytest

from relguide import ChangeLevel, FlyStraight, Leader, LevelChange, Pursuer, Traffic, TurnTo
from relguide.planning.heights import (
    ALTIMETRY,
    JOINED_HEIGHT,
    RATE_TOLERANCE,
    START_TOLERANCE,
    VERTICAL_MINIMUM,
    WHOLE_METRE,
    Heights,
    counted,
    heights_of,
    kept_by_height,
    off_level,
    time_to_level,
)
from relguide.units import DEG, FT

FL = 100.0 * FT
EDGES = (-1.0, 1.0, 0.0)


def flown(heights: Heights, rng: np.random.Generator, times: np.ndarray) -> np.ndarray:
    """An altitude flown within the tolerances, at their edges mostly."""
    changes = [
        (
            max(change.at + START_TOLERANCE * rng.choice(EDGES), 0.0),
            change.rate * (1.0 + RATE_TOLERANCE * rng.choice(EDGES)),
            change.to_altitude,
        )
        for change in heights.changes
    ]
    begun = [one for k, one in enumerate(changes) if all(one[0] < l[0] for l in changes[k + 1 :])]
    altitude, off = heights.altitude, ALTIMETRY * rng.choice(EDGES)
    knots, moving = [(0.0, altitude)], np.zeros(len(times), dtype=bool)
    for (start, rate, to), (end, *_) in pairwise([*begun, (times[-1] + 1.0,)]):
        takes = min(abs(to - altitude) / rate, end - start)
        knots.append((start, altitude))
        altitude += np.sign(to - altitude) * rate * takes
        knots.append((start + takes, altitude))
        moving |= (times >= start) & (times < start + takes)
    return np.interp(times, *np.array(knots).T) + off * moving


def a_profile(rng: np.random.Generator) -> Heights:
    changes, t = [], 0.0
    for _ in range(rng.integers(0, 4)):
        t += float(rng.choice([0.0, rng.uniform(0.0, 12.0), rng.uniform(0.0, 300.0)]))
        level = FL * float(rng.integers(200, 260))
        changes.append(LevelChange(at=t, to_altitude=level, rate=float(rng.uniform(2.0, 20.0))))
    return Heights(altitude=FL * float(rng.integers(200, 260)), changes=tuple(changes))


def test_where_nothing_counts_no_flight_within_the_tolerances_is_nearer_than_1000_ft():
    rng = np.random.default_rng(54)
    times = np.arange(0.0, 900.0, 1.0)
    free = 0
    for _ in range(2_000):
        own, other = a_profile(rng), a_profile(rng)
        counts = np.zeros(len(times), dtype=bool)
        for since, until in counted(own, other):
            counts |= (times >= since - 1e-6) & (times <= until + 1e-6)
        free += int((~counts).sum())
        for _ in range(5):
            apart = abs(flown(own, rng, times) - flown(other, rng, times))
            assert (apart[~counts] >= VERTICAL_MINIMUM - WHOLE_METRE - 1e-6).all()
    assert free > 100_000


def test_bounds_hold_every_flight_within_the_tolerances():
    rng = np.random.default_rng(7)
    times = np.arange(0.0, 900.0, 0.5)
    for _ in range(200):
        heights = a_profile(rng)
        low, high = np.array([heights.bounds(t) for t in times.tolist()]).T
        for _ in range(5):
            altitude = flown(heights, rng, times)
            assert (low <= altitude + 1e-6).all()
            assert (altitude <= high + 1e-6).all()
        final = heights.final_altitude
        assert heights.bounds(1e6) == pytest.approx((final, final))


def test_an_unknown_level_counts_always():
    known, unknown = Heights(altitude=10_000.0), Heights(altitude=None)
    for pair in ((known, unknown), (unknown, known), (unknown, unknown)):
        assert counted(*pair) == ((0.0, inf),)
        assert kept_by_height(*pair, 600.0) == ()


@pytest.mark.parametrize("feet", [1_000.0, 2_000.0, 10_000.0])
def test_levels_1000_ft_apart_never_count_and_nearer_ones_always(feet: float):
    own, near = Heights(altitude=310 * FL), Heights(altitude=310 * FL - 900.0 * FT)
    other = Heights(altitude=310 * FL + feet * FT)
    assert counted(own, other) == counted(other, own) == ()
    assert kept_by_height(own, other, 600.0) == ((0.0, 600.0, pytest.approx(feet * FT)),)
    assert counted(own, near) == ((0.0, inf),)


def test_a_descent_to_our_level_counts_from_when_1000_ft_are_no_longer_certain():
    own = Heights(altitude=310 * FL)
    change = LevelChange(at=100.0, to_altitude=310 * FL, rate=10.0)
    other = Heights(altitude=330 * FL, changes=(change,))
    # begun 5 s early, at 12 m/s, with 200 ft of altimetry: 800 ft are flown down
    begins = 95.0 + (1_000.0 - 200.0) * FT / 12.0
    ((since, until),) = counted(own, other)
    assert (since, until) == (pytest.approx(begins, abs=0.1), inf)
    ((start, end, least),) = kept_by_height(own, other, 600.0)
    assert (start, end) == (0.0, since)
    assert least == pytest.approx(VERTICAL_MINIMUM - WHOLE_METRE)


def test_crossing_our_level_counts_in_one_interval_and_then_no_more():
    own = Heights(altitude=310 * FL)
    change = LevelChange(at=0.0, to_altitude=350 * FL, rate=10.0)
    other = Heights(altitude=270 * FL, changes=(change,))
    ((since, until),) = counted(own, other)
    assert 0.0 < since < until < inf
    assert [kept[:2] for kept in kept_by_height(own, other, 900.0)] == [
        (0.0, since),
        (until, 900.0),
    ]


def test_a_change_begins_when_the_pieces_before_it_are_flown():
    descent = ChangeLevel(to_altitude=9_000.0, rate=8.0)
    turn = TurnTo.from_display(heading_deg=90.0, direction="right", bank_deg=20.0)
    leader = Leader(
        x=0.0, y=0.0, heading=0.0, tas=200.0, altitude=10_000.0,
        intent=(FlyStraight(duration=60.0), turn, descent, FlyStraight(duration=30.0), descent),
    )  # fmt: skip
    turning = leader.trajectory.durations()[1]
    first, second = heights_of(leader).changes
    assert (first.at, second.at) == (pytest.approx(60.0 + turning), pytest.approx(90.0 + turning))
    assert heights_of(leader).final_altitude == 9_000.0
    other = Traffic(
        ident="BAW12", x=0.0, y=0.0, heading=0.0, tas=200.0, min_separation=9_000.0,
        intent=(descent,),
    )  # fmt: skip
    assert heights_of(other) == Heights(altitude=None, changes=heights_of(other).changes)
    own = Pursuer(x=0.0, y=0.0, heading=0.0, tas=200.0, max_bank=25.0 * DEG, altitude=8_000.0)
    assert heights_of(own) == Heights(altitude=8_000.0)


def test_two_that_change_level_together_are_as_sure_as_both_their_tolerances():
    change = LevelChange(at=50.0, to_altitude=200 * FL, rate=10.0)
    above = LevelChange(at=50.0, to_altitude=230 * FL, rate=10.0)
    own = Heights(altitude=300 * FL, changes=(change,))
    other = Heights(altitude=330 * FL, changes=(above,))
    ((since, until),) = counted(own, other)
    assert 50.0 < since < until
    for t in (since + 0.1, until - 0.1):
        (low, high), (other_low, other_high) = own.bounds(t), other.bounds(t)
        assert max(low - other_high, other_low - high) < VERTICAL_MINIMUM


def test_off_level_is_when_two_are_more_than_300_ft_apart_by_what_they_declared():
    rng, times = np.random.default_rng(55), np.arange(0.5, 1_200.0)
    seen = 0
    for _ in range(300):
        own, leader = a_profile(rng), a_profile(rng)
        found = off_level(own, leader)
        apart = np.array([own.at(t) - leader.at(t) for t in times])
        off = np.zeros(len(times), dtype=bool)
        for since, until in found:
            off |= (times > since) & (times < until)
        assert (off == (abs(apart) > JOINED_HEIGHT)).all()
        seen += len(found) > 1
        first = time_to_level(own, leader)
        assert (abs(apart[times < first]) > JOINED_HEIGHT).all()
        assert first == inf or abs(own.at(first) - leader.at(first)) <= JOINED_HEIGHT + 1e-6
    assert seen > 20
    assert off_level(Heights(altitude=None), Heights(altitude=350 * FL)) == ()

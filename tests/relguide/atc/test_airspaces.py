"""A track against closed airspace, against dense sampling."""

from math import inf

import numpy as np
import pytest

from relguide.atc.airspaces import entries
from relguide.atc.picture import Airspace
from relguide.atc.track import Track
from relguide.atc.tracks import path_track
from relguide.planning.heights import Heights
from relguide.planning.intent import LevelChange
from relguide.units import FT
from tests.relguide.atc.pictures import LEVEL, NOW, drawn_path

SQUARE = ((0.0, 10_000.0, 10_000.0, 0.0), (0.0, 0.0, 10_000.0, 10_000.0))
NOTCHED = (
    (0.0, 20_000.0, 20_000.0, 12_000.0, 10_000.0, 8_000.0, 0.0),
    (0.0, 0.0, 20_000.0, 20_000.0, 2_000.0, 20_000.0, 20_000.0),
)
"""A square with a notch from the north: not convex."""


def airspace(shape, *, low=-inf, high=inf, since=-inf, until=inf) -> Airspace:
    return Airspace(
        ident="R1", x=shape[0], y=shape[1], low=low, high=high, since=since, until=until
    )


def flat(points, *, altitude=None, t=None):
    x, y = np.array(points, dtype=float).T
    level = np.ones(len(x))
    low, high = (-inf, inf) if altitude is None else (altitude, altitude)
    times = NOW + (100.0 * np.arange(len(x)) if t is None else np.array(t))
    return Track(t=times, x=x, y=y, low=level * low, high=level * high, error=0.0)


def entered(track, space, bound=0.0, spare=0.0):
    return entries(track, (space,), begin=NOW, end=NOW + 1_000.0, bound=bound, spare=spare)


def test_a_track_that_crosses_is_inside_from_the_edge_on():
    (found,) = entered(flat([(-5_000.0, 5_000.0), (15_000.0, 5_000.0)]), airspace(SQUARE))
    assert found.least == 0.0
    assert found.at == pytest.approx(NOW + 25.0)


def test_a_track_that_begins_inside_is_inside_at_once():
    (found,) = entered(flat([(5_000.0, 5_000.0), (6_000.0, 5_000.0)]), airspace(SQUARE))
    assert found == ("R1", 0.0, NOW)


def test_a_notch_is_outside():
    through = flat([(10_000.0, 30_000.0), (10_000.0, 4_000.0), (10_000.0, 30_000.0)])
    assert entered(through, airspace(NOTCHED)) == ()
    (found,) = entered(through, airspace(NOTCHED), bound=2_500.0)
    assert 0.0 < found.least < 2_000.0


def test_a_corner_and_an_edge_that_are_passed_count_by_their_distance():
    beside = flat([(-5_000.0, 11_000.0), (15_000.0, 11_000.0)])
    assert entered(beside, airspace(SQUARE), bound=999.0) == ()
    assert entered(beside, airspace(SQUARE), bound=1_001.0)[0].least == pytest.approx(1_000.0)
    corner = flat([(9_000.0, 13_000.0), (13_000.0, 9_000.0)])
    (found,) = entered(corner, airspace(SQUARE), bound=1_500.0)
    assert found.least == pytest.approx(2_000.0 / 2**0.5)


def test_it_counts_while_it_is_closed_alone():
    crossing = flat([(-5_000.0, 5_000.0), (15_000.0, 5_000.0)])
    assert entered(crossing, airspace(SQUARE, since=NOW + 76.0)) == ()
    assert entered(crossing, airspace(SQUARE, until=NOW + 24.0)) == ()
    (found,) = entered(crossing, airspace(SQUARE, since=NOW + 50.0))
    assert found.at == NOW + 50.0


def test_it_counts_at_its_levels_alone():
    crossing = flat([(-5_000.0, 5_000.0), (15_000.0, 5_000.0)], altitude=LEVEL)
    below = airspace(SQUARE, high=LEVEL - 100.0 * FT)
    assert entered(crossing, below) == ()
    assert len(entered(crossing, below, spare=200.0 * FT)) == 1
    assert entered(crossing, airspace(SQUARE, low=LEVEL + 1.0)) == ()
    assert len(entered(crossing, airspace(SQUARE, low=LEVEL, high=LEVEL))) == 1
    unknown = flat([(-5_000.0, 5_000.0), (15_000.0, 5_000.0)])
    assert len(entered(unknown, below)) == 1


@pytest.mark.parametrize("seed", range(40))
def test_what_dense_sampling_finds_inside_is_found(seed):
    rng = np.random.default_rng(seed)
    path = drawn_path(rng)
    n = int(rng.integers(3, 9))
    angles, reach = np.sort(rng.uniform(0.0, 2.0 * np.pi, n)), rng.uniform(1_000.0, 20_000.0, n)
    x, y = rng.uniform(-40_000.0, 40_000.0, 2)
    change = LevelChange(at=rng.uniform(0.0, 300.0), to_altitude=LEVEL + 900.0, rate=8.0)
    space = airspace(
        (x + reach * np.sin(angles), y + reach * np.cos(angles)),
        low=LEVEL + rng.uniform(-300.0, 600.0),
        since=NOW + rng.uniform(-200.0, 300.0),
        until=NOW + rng.uniform(100.0, 600.0),
    )
    heights = Heights(altitude=LEVEL, changes=(change,))
    track = path_track(path, start=NOW, until=NOW + 500.0, heights=heights)
    found = entries(track, (space,), begin=NOW, end=NOW + 500.0, bound=0.0, spare=0.0)
    t = np.arange(0.0, 500.0, 0.2)
    flown = path.sample(t)
    inside = np.zeros(len(t), dtype=bool)
    for k, time in enumerate(t.tolist()):
        closed = space.since <= NOW + time <= space.until
        if closed and heights.bounds(time)[1] > space.low:
            inside[k] = winds(flown.x[k], flown.y[k], space)
    if inside.any():
        assert found
        assert found[0].at <= NOW + t[inside][0] + 1e-6
    elif not found:
        assert not inside.any()
    else:  # within the error of the track, or between two samples
        assert found[0].least <= track.error + 50.0


def winds(x, y, space) -> bool:
    """Whether a polygon goes round a point."""
    dx, dy = np.array(space.x) - x, np.array(space.y) - y
    angle = np.arctan2(dx, dy)
    steps = np.diff(np.append(angle, angle[0]))
    return abs(np.sum((steps + np.pi) % (2.0 * np.pi) - np.pi)) > np.pi

"""A track knows what reports can tell, how well, and for how long."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest

from relguide.flying.leader_track import FORGOTTEN, LeaderTrack, standing
from relguide.flying.surveillance import EXACT, Receiver, Report, Surveillance
from relguide.units import DEG

SEEN = Surveillance(kind="adsb", nacp=8, nacv=2)
V, TRACK = 220.0, 2.0
EAST, NORTH = V * sin(TRACK), V * cos(TRACK)


def report_at(t: float, surveillance: Surveillance = SEEN) -> Report:
    """A report without error."""
    sigmas = surveillance.position_sigma, surveillance.velocity_sigma
    return Report(t, EAST * t, NORTH * t, EAST, NORTH, *sigmas)


def flown(seconds: int, surveillance: Surveillance = SEEN) -> LeaderTrack:
    track = LeaderTrack(surveillance, report_at(0.0, surveillance))
    for t in range(1, seconds + 1):
        track.second(float(t), report_at(float(t), surveillance))
    return track


@pytest.mark.parametrize(
    ("age", "named"),
    [
        (0.0, "normal"), (2.0, "normal"), (2.1, "coasting"), (5.0, "coasting"), (6.0, "old"),
        (10.0, "old"), (11.0, "lost"), (24.0, "lost"), (25.0, "gone"), (1e9, "gone"),
    ],
)  # fmt: skip
def test_the_ladder_of_ages(age: float, named: str) -> None:
    assert standing(age) == named


def test_a_straight_flight_is_told_as_it_is() -> None:
    track = flown(60)
    assert (track.x, track.y) == pytest.approx((EAST * 60.0, NORTH * 60.0), abs=0.1)
    assert track.speed == pytest.approx(V)
    assert track.track == pytest.approx(TRACK)
    assert track.rate == pytest.approx(0.0, abs=1e-6)
    assert (track.age, track.standing) == (0.0, "normal")


def test_positions_are_within_their_sigmas_noise_drift_and_lag_together() -> None:
    """Over 60 flights of 10 minutes; the mean along is the lag that nobody knows of."""
    off = []
    for seed in range(60):
        receiver = Receiver(SEEN, np.random.default_rng(seed))
        first = receiver.hear(0.0, 0.0, 0.0, EAST, NORTH)
        assert first is not None
        track = LeaderTrack(SEEN, first)
        for t in range(1, 600):
            track.second(t, receiver.hear(float(t), EAST * t, NORTH * t, EAST, NORTH))
            dx, dy = track.x - EAST * t, track.y - NORTH * t
            along = dx * sin(TRACK) + dy * cos(TRACK)
            across = dx * cos(TRACK) - dy * sin(TRACK)
            place, motion = track.position_sigma, track.velocity_sigma
            turned = (track.track - TRACK) * V
            off.append((across / place.across, along / place.along,
                        turned / motion.across, (track.speed - V) / motion.along))  # fmt: skip
    squares = (np.array(off) ** 2).mean(axis=0)
    assert np.all(squares[:2] > 0.7)
    assert np.all(squares[:2] < 1.15)
    # a flight that is straight all the time is better known than one that may turn
    assert np.all(squares[2:] < 1.0)


def test_silence_makes_it_coast_and_less_sure() -> None:
    track = flown(60)
    before = track.position_sigma, track.velocity_sigma
    for t in range(61, 69):
        track.second(float(t), None)
    assert track.age == 8.0
    assert track.standing == "old"
    assert (track.x, track.y) == pytest.approx((EAST * 68.0, NORTH * 68.0), abs=0.5)
    assert track.position_sigma.across > before[0].across
    assert track.velocity_sigma.across > 2.0 * before[1].across
    track.second(69.0, report_at(69.0))
    assert (track.age, track.standing) == (0.0, "normal")


def test_after_half_a_minute_it_begins_anew() -> None:
    track = flown(60)
    elsewhere = Report(0.0, 5e5, 5e5, -EAST, -NORTH, 37.8, 1.2)
    for t in range(61, 60 + int(FORGOTTEN) + 1):
        track.second(float(t), elsewhere._replace(t=float(t)))  # nobody flies so far in a second
        assert track.age == t - 60.0
    track.second(91.0, elsewhere._replace(t=91.0))
    assert (track.x, track.y, track.age) == (5e5, 5e5, 0.0)
    # a track is continuous: half a turn from where it was
    assert abs(track.track - TRACK) == pytest.approx(pi)


def test_a_turn_during_silence_is_believed() -> None:
    track = flown(60)
    rate, t0, lost = 1.2 * DEG, 60.0, 8
    for t in range(61, 100):
        turned = TRACK + rate * (t - t0)
        x = EAST * t0 - V / rate * (cos(turned) - cos(TRACK))
        y = NORTH * t0 + V / rate * (sin(turned) - sin(TRACK))
        report = Report(t, x, y, V * sin(turned), V * cos(turned), 37.8, 1.2)
        track.second(float(t), None if t < 60 + lost else report)
        assert track.age <= lost
    assert hypot(track.x - x, track.y - y) < 5.0
    assert track.rate == pytest.approx(rate, rel=0.02)
    assert track.surprise < 1.0


def test_exact_reports_are_followed_closely() -> None:
    track = flown(30, EXACT)
    assert max(track.position_sigma) < 0.2
    assert max(track.velocity_sigma) < 0.2


def test_the_same_second_twice_moves_nothing() -> None:
    track = flown(10)
    before = track.x, track.y
    track.second(10.0, None)
    assert (track.x, track.y) == before

"""Reports are as noisy, as late and as often lost as their categories say."""

from itertools import groupby
from math import exp

import numpy as np
import pytest

from relguide.flying.surveillance import (
    DRIFT_TIME,
    DRIFTING,
    EXACT,
    UNCOMPENSATED,
    Receiver,
    Report,
    Surveillance,
)

EAST, NORTH = 180.0, -90.0
CLEAR = {"loss_share": 0.0, "latency": 0.0}


def heard(surveillance: Surveillance, seconds: int, seed: int = 1) -> list[Report | None]:
    """What is received each second of an aircraft that flies straight."""
    receiver = Receiver(surveillance, np.random.default_rng(seed))
    return [receiver.hear(float(t), EAST * t, NORTH * t, EAST, NORTH) for t in range(seconds)]


def off(reports: list[Report | None]) -> np.ndarray:
    """How far positions and velocities are from the truth. shape (n, 4)"""
    return np.array(
        [
            (r.x - EAST * r.t, r.y - NORTH * r.t, r.east - EAST, r.north - NORTH)
            for r in reports
            if r is not None
        ]
    )


def test_exact_surveillance_hears_the_truth_each_second() -> None:
    assert Surveillance() == EXACT
    assert repr(EXACT) == "Surveillance()"
    reports = heard(EXACT, 20)
    assert [r.t for r in reports if r] == list(range(20))
    assert not off(reports).any()
    assert (EXACT.position_sigma, EXACT.velocity_sigma, EXACT.lag) == (0.0, 0.0, 0.0)


def test_sigmas_are_those_of_the_categories() -> None:
    seen = Surveillance(kind="adsb", nacp=8, nacv=1)
    assert seen.position_sigma == pytest.approx(37.83, abs=0.01)  # 92.6 m (95 %)
    assert seen.velocity_sigma == pytest.approx(4.085, abs=0.001)  # 10 m/s (95 %)


def test_noise_is_as_large_as_it_says_and_positions_drift() -> None:
    seen = Surveillance(kind="adsb", nacp=8, nacv=2, **CLEAR)  # type: ignore[arg-type]
    flights = np.array([off(heard(seen, 300, seed)) for seed in range(300)])
    within = np.hypot(flights[:, 0, 0], flights[:, 0, 1]) < 92.6
    assert within.mean() == pytest.approx(0.95, abs=0.03)  # 300 of them: σ 1.3 %
    sigma = np.std(flights, axis=(0, 1))
    assert sigma[:2] == pytest.approx(seen.position_sigma, rel=0.06)
    assert sigma[2:] == pytest.approx(seen.velocity_sigma, rel=0.02)
    for apart in (1, 50, 200):
        shared = (flights[:, apart:] * flights[:, : 300 - apart]).mean(axis=(0, 1)) / sigma**2
        assert shared[:2] == pytest.approx(DRIFTING * exp(-apart / DRIFT_TIME), abs=0.07)
        assert shared[2:] == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize("interval", [1.0, 2.0])
def test_as_many_reports_are_lost_as_it_says_and_silence_ends(interval: float) -> None:
    seen = Surveillance(kind="adsb", interval=interval, loss_share=0.05, burst=6.0)
    reports = heard(seen, 100_000)
    arrived = [r.t for r in reports if r is not None]
    assert len(arrived) == pytest.approx(0.95 * 100_000 / interval, rel=0.005)
    gaps = np.diff(arrived)
    assert gaps.max() == 6.0  # bursts are that long, and no longer
    assert gaps.min() == interval
    assert reports[0] is not None


def test_reports_come_one_by_one_or_in_bursts() -> None:
    single = heard(Surveillance(kind="adsb", loss_share=0.2, burst=2.0), 20_000)
    lengths = {len(list(run)) for lost, run in groupby(r is None for r in single) if lost}
    assert lengths == {1}
    assert all(heard(Surveillance(kind="adsb", loss_share=0.0), 500))


@pytest.mark.parametrize(("compensated", "share"), [(False, 1.0), (True, UNCOMPENSATED)])
def test_a_late_position_is_behind_by_what_is_not_compensated(
    compensated: bool, share: float
) -> None:
    seen = Surveillance(kind="adsb", nacp=11, latency=1.5, compensated=compensated, loss_share=0.0)
    behind = -off(heard(seen, 4_000))[:, :2].mean(axis=0)
    assert behind == pytest.approx([EAST * 1.5 * share, NORTH * 1.5 * share], abs=0.5)
    assert seen.lag == pytest.approx(1.5 * share)


def test_what_a_turning_aircraft_reports_is_where_it_was() -> None:
    """Without compensation, a report is the truth of a latency ago, on the circle."""
    seen = Surveillance(
        kind="adsb", nacp=11, nacv=4, latency=1.4, compensated=False, loss_share=0.0
    )
    receiver = Receiver(seen, np.random.default_rng(3))
    rate, speed = 0.02, 200.0
    errors = []
    for t in range(2_000):
        place = [speed / rate * (1.0 - np.cos(rate * t)), speed / rate * np.sin(rate * t)]
        motion = [speed * np.sin(rate * t), speed * np.cos(rate * t)]
        report = receiver.hear(float(t), *place, *motion)
        assert report is not None
        was = rate * (t - 1.4)
        if t > 2:
            errors.append((
                report.x - speed / rate * (1.0 - np.cos(was)),
                report.y - speed / rate * np.sin(was),
                report.east - speed * np.sin(was), report.north - speed * np.cos(was),
            ))  # fmt: skip
    assert np.mean(errors, axis=0) == pytest.approx(0.0, abs=0.5)
    assert np.std(errors, axis=0)[:2] == pytest.approx(seen.position_sigma, rel=0.25)
    assert np.std(errors, axis=0)[2:] == pytest.approx(seen.velocity_sigma, rel=0.05)


def test_the_same_seed_hears_the_same() -> None:
    seen = Surveillance(kind="adsb")
    assert heard(seen, 200, seed=7) == heard(seen, 200, seed=7)
    assert heard(seen, 200, seed=7) != heard(seen, 200, seed=8)


def test_who_looks_between_reports_hears_nothing() -> None:
    receiver = Receiver(Surveillance(kind="adsb", interval=4.0), np.random.default_rng(1))
    assert receiver.hear(0.0, 0.0, 0.0, EAST, NORTH) is not None
    assert [receiver.hear(float(t), 0.0, 0.0, EAST, NORTH) for t in (1, 2, 3)] == [None] * 3


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"kind": "radar"}, "kind must be 'exact' or 'adsb', not 'radar'"),
        ({"nacp": 12}, "nacp must lie in 1 … 11, not 12"),
        ({"nacp": 8.5}, "nacp must be a whole number of 1 or more, not 8.5"),
        ({"nacv": 0}, "nacv must be a whole number of 1 or more, not 0"),
        ({"nacv": 5}, "nacv must lie in 1 … 4, not 5"),
        ({"latency": -0.1}, "latency must lie in 0 … 5 s, not -0.1 s"),
        ({"compensated": 1}, "compensated must be True or False, not 1"),
        ({"interval": 0.5}, "interval must lie in 1 … 30 s, not 0.5 s"),
        ({"loss_share": 1.0}, "loss_share must lie in 0 … 0.5, not 1"),
        ({"burst": 600}, "burst must lie in 0 … 60 s, not 600 s"),
    ],
)
def test_surveillance_that_is_none_is_refused(wrong: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        Surveillance(**wrong)  # type: ignore[arg-type]

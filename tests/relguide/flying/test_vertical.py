"""Climbs and descents: within the engines, at the speed that is held, and levelled off."""

import numpy as np
import pytest

from relguide import Aircraft, ChangeLevel, Declared, FlyStraight, Guided, World, airframe
from relguide.flying.air import STANDARD_AIR
from relguide.flying.fleet import Fleet
from relguide.flying.vertical import PULL, begin_change, fly_vertical, kept_tas, level_at
from relguide.units import DEG, FT, KT

FL = 100.0 * FT
A306 = airframe("A306")


def flown(pilot: Guided | Declared, level: float, tas: float) -> Fleet:
    one = Aircraft(
        ident="P", airframe=A306, aircraft_type="A306", x=0.0, y=0.0, heading=0.0, tas=tas,
        altitude=level, max_bank=25.0 * DEG, pilot=pilot,
    )  # fmt: skip
    return Fleet(World(aircraft=(one,), links=()), 0.05)


@pytest.mark.parametrize("rise", [-3_000.0, -300.0, 30.0, 900.0])
def test_a_change_is_smooth_keeps_its_rate_and_ends_at_the_level(rise: float) -> None:
    now = begin_change(level_at(9_000.0), 9_000.0 + rise, 8.0, "tas", 230.0, STANDARD_AIR)
    altitudes = [np.array([9_000.0])]
    while not now.is_level:
        now, second = fly_vertical(now, 50.0, 50.0, 20, 0.05)
        altitudes.append(second[1:])
        assert len(altitudes) < 600
    flown = np.concatenate(altitudes)
    speeds = np.diff(flown) / 0.05
    assert flown[-1] == 9_000.0 + rise
    assert np.abs(speeds).max() <= 8.0 + 1e-9
    away = np.abs(flown[2:] - flown[-1]) > 0.1  # the last centimetres are a step
    assert np.abs(np.diff(speeds))[away].max() <= 2.0 * PULL * 0.05
    assert (np.sign(rise) * (flown - 9_000.0) <= abs(rise) + 0.1).all()
    # a declared rate and start are kept within their tolerances
    assert len(altitudes) - 1 <= abs(rise) / (0.8 * 8.0) + 10.0


def test_speeds_held_go_over_to_one_another_at_the_crossover() -> None:
    slow = begin_change(level_at(20_000 * FT), 1.0, 8.0, "cas", 220.0, STANDARD_AIR)
    by_cas = [kept_tas(slow._replace(altitude=fl * FL), A306, STANDARD_AIR) for fl in (200, 260)]
    assert by_cas == pytest.approx(
        [STANDARD_AIR.tas_from_cas(slow.cas, fl * FL) for fl in (200, 260)]
    )
    assert by_cas[1] / by_cas[0] == pytest.approx(1.095, abs=0.01)  # 1.6 % a thousand feet
    fast = begin_change(level_at(240 * FL), 1.0, 8.0, "cas", 235.0, STANDARD_AIR)
    high = kept_tas(fast._replace(altitude=390 * FL), A306, STANDARD_AIR)
    assert STANDARD_AIR.mach(high, 390 * FL) == pytest.approx(A306.m_mo - 0.02)
    down = begin_change(level_at(350 * FL), 1.0, 8.0, "mach", 235.0, STANDARD_AIR)
    low = kept_tas(down._replace(altitude=150 * FL), A306, STANDARD_AIR)
    assert STANDARD_AIR.cas_from_tas(low, 150 * FL) == pytest.approx(A306.v_mo - 10.0 * KT)


def test_a_climb_is_no_steeper_than_its_engines_and_a_descent_no_faster_than_idle() -> None:
    fleet = flown(Guided(), 310 * FL, 235.0)
    for to, sign in ((390 * FL, 1.0), (100 * FL, -1.0)):
        fleet.change_level(0, to, 60.0)
        rates = []
        for t in range(120):
            before = fleet.verticals[0].altitude
            fleet.fly_second(float(t))
            rates.append(sign * (fleet.verticals[0].altitude - before))
        assert 0.5 < max(rates) <= (A306.max_climb if sign > 0.0 else A306.max_descent)
        assert fleet.states[0, 5] > 225.0  # without a loss of speed
    assert max(rates) < 20.0  # idle, without brakes


def test_energy_is_kept_by_an_idle_descent_that_slows_down() -> None:
    """What a descent gives is not lost: faster down, slower in slowing down."""
    slowed = []
    for rate in (0.0, 12.0):
        fleet = flown(Guided(), 200 * FL, 220.0)
        fleet.controls[0, 2] = 150.0
        if rate:
            fleet.change_level(0, 100 * FL, rate)
        for t in range(20):
            fleet.fly_second(float(t))
        slowed.append(220.0 - fleet.states[0, 5])
    assert 0.3 * slowed[0] < slowed[1] < 0.8 * slowed[0]


def test_a_declared_change_is_flown_when_its_time_has_come_and_holds_its_speed() -> None:
    intent = FlyStraight(duration=30.0), ChangeLevel(to_altitude=250 * FL, rate=8.0)
    fleet = flown(Declared(intent=intent), 310 * FL, 210.0)
    cas = STANDARD_AIR.cas_from_tas(210.0, 310 * FL)
    for t in range(320):
        fleet.fly_second(float(t))
        if t == 29:
            assert fleet.verticals[0].altitude == 310 * FL
    assert fleet.verticals[0].altitude == 250 * FL
    assert STANDARD_AIR.cas_from_tas(fleet.states[0, 5], 250 * FL) == pytest.approx(cas, abs=0.5)

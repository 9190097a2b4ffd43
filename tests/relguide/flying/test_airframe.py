"""Types fly as their sources say; those that could not fly are refused."""

from dataclasses import fields, replace
from math import cos, inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.flying.air import Air, pressure
from relguide.flying.airframe import QUANTITIES, Airframe
from relguide.flying.airframe_files import airframe, known_airframes
from relguide.flying.dispersion import DISPERSED
from relguide.units import DEG, FT, G0, KT

A306 = airframe("A306")


def test_every_number_of_an_airframe_has_a_key() -> None:
    numbers = [quantity.field for quantity in QUANTITIES]
    there = [field.name for field in fields(Airframe)]
    assert there == ["designator", "name", *numbers, "usable_lift", "thrust", "thrust_share"]


def test_the_a300_rolls_and_changes_speed_as_its_sources_say() -> None:
    assert A306.max_roll_rate == pytest.approx(3.75 * DEG)
    assert A306.roll_time_constant == 0.5
    assert A306.speed_time_constant == 5.0


@pytest.mark.parametrize(
    ("level", "tas", "faster", "slower"),
    [(100, 150.0, 0.95, 0.55), (180, 200.0, 0.47, 0.71), (310, 200.0, 0.40, 0.62),
     (310, 240.0, 0.26, 0.72), (390, 230.0, 0.15, 0.64)],
)  # fmt: skip
def test_thrust_leaves_less_and_less_on_the_way_up(
    level: int, tas: float, faster: float, slower: float
) -> None:
    altitude = 100.0 * level * FT
    assert A306.excess_acceleration(altitude, tas, Air()) == pytest.approx(faster, abs=0.015)
    assert A306.idle_deceleration(altitude, tas, Air()) == pytest.approx(slower, abs=0.015)


def test_the_last_climb_to_the_top_is_what_its_page_says() -> None:
    """SKYbrary, page A306: 800 ft/min of climb left at Mach 0.78, near FL370 and well loaded."""
    altitude = 35_000.0 * FT
    tas = Air().tas_from_mach(0.78, altitude)
    climb = A306.excess_acceleration(altitude, tas, Air(), 140_000.0) * tas / G0
    assert 0.5 < climb / (800.0 * FT / 60.0) < 1.3


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 30.0), st.floats(-20.0, 20.0))
def test_weight_and_bank_take_from_what_thrust_leaves(
    up: float, share: float, bank: float, warmer: float
) -> None:
    air, altitude = Air(isa_deviation=warmer), up * 35_000.0 * FT
    heavy = 120_000.0 + 20_000.0 * share
    least, most = A306.tas_range(altitude, air, heavy)
    tas = least + share * (most - least)
    lighter = A306.excess_acceleration(altitude, tas, air)
    heavier = A306.excess_acceleration(altitude, tas, air, heavy)
    banked = A306.excess_acceleration(altitude, tas, air, heavy, bank * DEG)
    assert lighter >= heavier - 1e-9
    assert heavier >= banked - 1e-9
    at_idle = A306.idle_deceleration(altitude, tas, air, heavy, bank * DEG)
    assert at_idle > 0.2
    assert at_idle - A306.idle_deceleration(altitude, tas, air, heavy) == pytest.approx(
        heavier - banked, abs=1e-9
    )
    assert A306.tas_range(altitude, air, heavy).least >= A306.tas_range(altitude, air).least


@given(
    st.sampled_from(known_airframes()), st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(-30, 30)
)
def test_parabolas_of_the_speed_give_what_the_tables_do(
    designator: str, up: float, along: float, warmer: float
) -> None:
    kind, air = airframe(designator), Air(isa_deviation=warmer)
    altitude = up * kind.ceiling
    least, most = kind.tas_range(altitude, air)
    tas = least + along * (most - least)
    climb, idle, _, induced = kind.energy(altitude, air)
    # 0.015: of the two jets; propellers' thrust is more than a parabola
    within = 0.04 if designator == "AT76" else 0.015
    for given_by, exact in (
        (climb, kind.excess_acceleration(altitude, tas, air)),
        (idle, -kind.idle_deceleration(altitude, tas, air)),
    ):
        c0, c1, c2 = given_by
        assert c0 + tas * (c1 + tas * c2) - induced / tas**2 == pytest.approx(exact, abs=within)


def test_heavy_aircraft_cannot_fly_as_high() -> None:
    assert A306.tas_range(40_000.0 * FT, Air(), 171_000.0).least == inf
    slow, fast = A306.tas_range(35_000.0 * FT, Air(), 171_000.0)
    assert slow > fast  # lift would do, climb thrust does not
    assert A306.tas_range(31_000.0 * FT, Air(), 171_000.0).most > 240.0


def test_a_bank_needs_more_speed_by_the_root_of_its_load() -> None:
    straight = A306.tas_range(3_000.0, Air()).least
    assert Air().mach(straight, 3_000.0) < 0.4  # where the usable lift is constant
    banked = A306.tas_range(3_000.0, Air(), bank=25.0 * DEG).least
    assert banked == pytest.approx(straight / cos(25.0 * DEG) ** 0.5)


def test_least_speeds_down_low_are_those_of_the_sources() -> None:
    for designator, cas in (("A306", 165.0), ("A310", 171.0), ("AT76", 130.0)):
        least = airframe(designator).tas_range(0.0, Air()).least
        assert Air().cas_from_tas(least, 0.0) == pytest.approx(cas * KT, rel=0.01)


def test_the_atr_is_slower_and_stays_lower() -> None:
    atr = airframe("AT76")
    assert atr.v_mo < A306.v_mo
    assert atr.tas_range(3_000.0, Air()).least < A306.tas_range(3_000.0, Air()).least
    assert atr.ceiling < A306.ceiling


@given(
    st.sampled_from(known_airframes()), st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(-30, 30)
)
def test_every_level_has_speeds_and_least_ones_grow_upward(
    designator: str, one: float, other: float, deviation: float
) -> None:
    kind, air = airframe(designator), Air(isa_deviation=deviation)
    low, high = (share * kind.ceiling for share in sorted((one, other)))
    below, above = kind.tas_range(low, air), kind.tas_range(high, air)
    assert below.least < below.most
    assert above.least < above.most
    assert above.least >= below.least * (1.0 - 1e-9)
    for level, (_, most) in ((low, below), (high, above)):
        mach, cas = air.mach(most, level), air.cas_from_tas(most, level)
        assert mach <= kind.m_mo * (1.0 + 1e-9)
        assert cas <= kind.v_mo * (1.0 + 1e-9)
        kept = kind.excess_acceleration(level, most, air)
        assert kept >= -1e-6
        lift = 2.0 * kind.reference_weight * G0 / (1.4 * pressure(level) * kind.wing_area)
        assert (
            mach == pytest.approx(kind.m_mo)
            or cas == pytest.approx(kind.v_mo)
            or kept == pytest.approx(0.0, abs=1e-6)
            or lift == pytest.approx(kind.usable_lift.square(mach))
        )


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"designator": "Airbus"}, "designator must be the ICAO type designator"),
        ({"name": " "}, "name must not be empty"),
        ({"max_bank": 25.0}, r"max_bank must lie in 0\.0174533 … 1\.0472 rad, not 25 rad"),
        ({"max_roll_rate": 0.0}, "max_roll_rate must lie in"),
        ({"thrust_share": 0.0}, r"thrust_share must lie in 0\.1 … 10"),
        (
            {"reference_weight": 80e3},
            r"reference_weight \(80,000 kg\) must lie in .*90,000 … 171,700",
        ),
        ({"ceiling": 19_800.0}, r"ceiling \(64,961 ft\) must be lower: no speed within v_mo"),
        ({"usable_lift": None}, "usable_lift must be"),
        ({"m_mo": 82.0}, r"m_mo must lie in 0\.1 … 0\.99, not 82\."),
    ],
)
def test_airframes_that_cannot_fly_are_refused(change: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(A306, **change)  # type: ignore[arg-type]


@pytest.mark.parametrize("share", [0.7, 1.3])
@pytest.mark.parametrize("name", DISPERSED)
def test_constants_may_be_a_third_off(name: str, share: float) -> None:
    varied = share * getattr(A306, name)
    assert getattr(replace(A306, **{name: varied}), name) == varied

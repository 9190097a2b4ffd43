"""The air keeps to the tables of the standard atmosphere, and its speeds convert both ways."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.flying.air import (
    HIGHEST_ALTITUDE,
    ISA_DEVIATION,
    LOWEST_ALTITUDE,
    STANDARD_AIR,
    TROPOPAUSE,
    Air,
    pressure,
    pressure_altitude,
)
from relguide.flying.wind_profile import WindLevel, WindProfile
from relguide.planning.wind import CALM, Wind
from relguide.units import FT, KT

altitudes = st.floats(LOWEST_ALTITUDE, HIGHEST_ALTITUDE)
airs = st.builds(Air, isa_deviation=st.floats(-30.0, 30.0))


@pytest.mark.parametrize(
    ("altitude", "temperature", "static", "density", "sound_speed"),
    # ambiance 1.3.1, the standard atmosphere of ICAO Doc 7488, at geopotential altitudes
    [
        (0.0, 288.15, 101_325.0, 1.225000, 340.294),
        (5_000.0, 255.65, 54_019.9, 0.736116, 320.529),
        (10_000.0, 223.15, 26_436.2, 0.412706, 299.463),
        (11_000.0, 216.65, 22_632.0, 0.363918, 295.069),
        (15_000.0, 216.65, 12_044.53, 0.193673, 295.069),
        (20_000.0, 216.65, 5_474.87, 0.0880345, 295.069),
    ],
)
def test_the_standard_atmosphere_is_the_tabulated_one(
    altitude: float, temperature: float, static: float, density: float, sound_speed: float
) -> None:
    assert STANDARD_AIR.temperature(altitude) == pytest.approx(temperature)
    assert pressure(altitude) == pytest.approx(static, rel=3e-6)  # six digits are given
    assert STANDARD_AIR.density(altitude) == pytest.approx(density, rel=3e-6)
    assert STANDARD_AIR.sound_speed(altitude) == pytest.approx(sound_speed, rel=3e-6)


@pytest.mark.parametrize(
    ("tas", "altitude", "cas", "mach"),
    # openap 2.6.2 (aero.tas2cas, tas2mach), whose pressures are 0.03 % lower: rounded constants
    [
        (240.0, 9_449.0, 151.921, 0.795079),
        (120.0, 3_000.0, 103.891, 0.365210),
        (250.0, 12_000.0, 134.842, 0.847258),
        (170.0, 7_620.0, 116.414, 0.548972),
        (90.0, 0.0, 90.0, 0.264477),
    ],
)
def test_speeds_are_those_of_another_program(
    tas: float, altitude: float, cas: float, mach: float
) -> None:
    assert STANDARD_AIR.cas_from_tas(tas, altitude) == pytest.approx(cas, rel=3e-4)
    assert STANDARD_AIR.mach(tas, altitude) == pytest.approx(mach, rel=1e-4)


def test_300_knots_are_mach_0_78_at_the_usual_crossover() -> None:
    crossover = 29_314.0 * FT  # openap 2.6.2, aero.crossover_alt
    by_cas = STANDARD_AIR.tas_from_cas(300.0 * KT, crossover)
    assert by_cas == pytest.approx(STANDARD_AIR.tas_from_mach(0.78, crossover), rel=1e-4)


@given(airs, altitudes, st.floats(0.05, 0.99))
def test_airspeeds_convert_there_and_back(air: Air, altitude: float, mach: float) -> None:
    tas = air.tas_from_mach(mach, altitude)
    assert air.mach(tas, altitude) == pytest.approx(mach)
    back = air.tas_from_cas(air.cas_from_tas(tas, altitude), altitude)
    assert back == pytest.approx(tas, rel=1e-9)  # 1 + q/p loses digits of a low Mach number


@given(airs, altitudes, altitudes)
def test_pressure_falls_with_altitude_and_does_not_care_for_temperature(
    air: Air, one: float, other: float
) -> None:
    low, high = sorted((one, other))
    assert pressure(low) >= pressure(high)
    gas = pressure(low) / (air.density(low) * air.temperature(low))
    assert gas == pytest.approx(287.05287)


@given(altitudes)
def test_each_pressure_has_its_altitude(altitude: float) -> None:
    assert pressure_altitude(pressure(altitude)) == pytest.approx(altitude, abs=1e-6)


def test_the_tropopause_has_no_step() -> None:
    below, above = TROPOPAUSE - 1e-6, TROPOPAUSE + 1e-6
    assert pressure(below) == pytest.approx(pressure(above), rel=1e-9)
    assert STANDARD_AIR.temperature(below) == pytest.approx(STANDARD_AIR.temperature(above))


@given(airs, altitudes, st.floats(20.0, 250.0), st.floats(0.1, 20.0))
def test_faster_is_faster_by_every_measure(
    air: Air, altitude: float, tas: float, more: float
) -> None:
    assert air.cas_from_tas(tas + more, altitude) > air.cas_from_tas(tas, altitude)
    assert air.mach(tas + more, altitude) > air.mach(tas, altitude)


@given(airs, st.floats(40.0, 180.0), altitudes, st.floats(1.0, 1_000.0))
def test_a_calibrated_airspeed_is_a_higher_mach_number_higher_up(
    air: Air, cas: float, altitude: float, climb: float
) -> None:
    high = min(altitude + climb, HIGHEST_ALTITUDE)
    low = high - climb
    if low >= LOWEST_ALTITUDE:
        fast = air.mach(air.tas_from_cas(cas, high), high)
        assert fast > air.mach(air.tas_from_cas(cas, low), low)


def test_warm_air_is_thinner_and_makes_a_mach_number_faster() -> None:
    warm = Air(isa_deviation=15.0)
    assert warm.temperature(9_449.0) == pytest.approx(STANDARD_AIR.temperature(9_449.0) + 15.0)
    assert warm.density(9_449.0) < STANDARD_AIR.density(9_449.0)
    assert warm.tas_from_mach(0.8, 9_449.0) > STANDARD_AIR.tas_from_mach(0.8, 9_449.0)
    # the Mach number of a calibrated airspeed is a matter of pressure alone
    hot, standard = (air.tas_from_cas(150.0, 9_449.0) for air in (warm, STANDARD_AIR))
    assert warm.mach(hot, 9_449.0) == pytest.approx(STANDARD_AIR.mach(standard, 9_449.0))


def test_the_wind_is_the_same_everywhere_and_always() -> None:
    wind = Wind(east=20.0, north=-5.0)
    air = Air(wind=wind)
    assert air.wind_at(0.0, 0.0, 0.0, 0.0) == wind
    assert air.wind_at(1e5, -1e5, 9_449.0, 3_600.0) == wind


def test_who_is_wrong_about_the_air_believes_the_sum() -> None:
    air = Air(wind=Wind(east=20.0, north=-5.0), isa_deviation=10.0)
    believed = air.with_error(wind_error=Wind(east=-3.0, north=1.0), isa_error=-4.0)
    assert believed == Air(wind=Wind(east=17.0, north=-4.0), isa_deviation=6.0)
    assert air.with_error() == air
    with pytest.raises(ValueError, match=r"wind\.speed must lie in"):
        air.with_error(wind_error=Wind(east=140.0))


def test_air_shows_itself_as_code() -> None:
    assert repr(Air()) == "Air()"
    assert repr(Air(isa_deviation=5.0)) == "Air(isa_deviation=5.0)"
    assert Air().wind == CALM


@pytest.mark.parametrize("altitude", [LOWEST_ALTITUDE - 1.0, HIGHEST_ALTITUDE + 1.0])
def test_altitudes_outside_the_formulas_are_refused(altitude: float) -> None:
    with pytest.raises(ValueError, match="altitude must lie in -1000 … 20000 m"):
        pressure(altitude)
    with pytest.raises(ValueError, match="altitude must lie in -1000 … 20000 m"):
        STANDARD_AIR.temperature(altitude)


def test_air_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="isa_deviation must lie in -60 … 60 K, not 288 K"):
        Air(isa_deviation=288.0)
    with pytest.raises(ValueError, match="wind must be a Wind, not 12"):
        Air(wind=12.0)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="gusts must lie in 0 … 10 m/s, not -1 m/s"):
        Air(gusts=-1.0)
    profile = WindProfile(levels=(WindLevel(0.0, Wind(east=5.0)),))
    with pytest.raises(ValueError, match="wind must be left out where a profile gives it"):
        Air(wind=Wind(east=5.0), profile=profile)
    with pytest.raises(ValueError, match="profile must be a WindProfile, not 12"):
        Air(profile=12)  # type: ignore[arg-type]
    assert Air(isa_deviation=ISA_DEVIATION.high).density(11_000.0) > 0.0

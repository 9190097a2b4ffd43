"""Winds by altitude are linear between levels, and files that give them are read or refused."""

from math import hypot
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.flying.air import Air
from relguide.flying.wind_profile import WindLevel, WindProfile, load_profile
from relguide.planning.wind import Wind, wind_from
from relguide.units import DEG, FT, KT

winds = st.builds(Wind, east=st.floats(-60.0, 60.0), north=st.floats(-60.0, 60.0))
profiles = st.lists(
    st.tuples(st.floats(0.0, 15_000.0), winds), min_size=1, max_size=6, unique_by=lambda row: row[0]
).map(lambda rows: WindProfile(levels=tuple(WindLevel(*row) for row in rows)))


@given(profiles)
def test_each_level_has_its_wind_and_the_ends_go_on(profile: WindProfile) -> None:
    for level in profile.levels:
        assert profile.at(level.altitude) == level.wind
    assert profile.at(-1_000.0) == profile.levels[0].wind
    assert profile.at(20_000.0) == profile.levels[-1].wind


@given(profiles, st.floats(-1_000.0, 20_000.0))
def test_no_wind_between_levels_is_stronger_than_at_them(
    profile: WindProfile, altitude: float
) -> None:
    assert profile.at(altitude).speed <= max(w.speed for _, w in profile.levels) * (1.0 + 1e-12)


def test_components_are_linear_between_levels() -> None:
    profile = WindProfile(
        levels=(
            WindLevel(9_000.0, Wind(east=30.0, north=10.0)),
            WindLevel(5_000.0, Wind(east=10.0, north=-10.0)),
        )
    )
    assert profile.at(6_000.0) == Wind(east=15.0, north=-5.0)
    air = Air(profile=profile)
    assert air.wind_at(1e4, -1e4, 8_000.0, 60.0) == Wind(east=25.0, north=5.0)
    assert eval(repr(profile)) == profile


def test_the_winds_of_a_real_flight() -> None:
    """What an A310 met on 2020-06-25 (traffic's zero_gravity): medians by 5,000 ft."""
    measured = ((2_500, 12), (7_500, 21), (12_500, 23), (17_500, 29), (22_500, 31))
    profile = WindProfile(
        levels=tuple(
            WindLevel(feet * FT, wind_from(224.0 * DEG, knots * KT)) for feet, knots in measured
        )
    )
    assert profile.at(0.0).speed == pytest.approx(12.0 * KT)
    assert profile.at(15_000.0 * FT).speed == pytest.approx(26.0 * KT)
    assert profile.at(35_000.0 * FT).speed == pytest.approx(31.0 * KT)
    wind = profile.at(10_000.0 * FT)
    assert wind.east > 0.0 < wind.north  # from the southwest
    assert wind.speed == pytest.approx(22.0 * KT)


def test_who_is_wrong_is_wrong_at_every_level() -> None:
    profile = WindProfile(levels=((0.0, Wind(east=5.0)), (9_000.0, Wind(east=30.0))))  # type: ignore[arg-type]
    believed = Air(profile=profile, gusts=1.5).with_error(wind_error=Wind(north=4.0), isa_error=2.0)
    for altitude in (0.0, 4_000.0, 12_000.0):
        true, wrong = profile.at(altitude), believed.wind_at(0.0, 0.0, altitude, 0.0)
        assert hypot(wrong.east - true.east, wrong.north - true.north) == pytest.approx(4.0)
    assert (believed.isa_deviation, believed.gusts) == (2.0, 0.0)
    with pytest.raises(ValueError, match=r"wind\.speed must lie in"):
        profile.shifted(Wind(east=140.0))


def test_what_is_no_profile_is_refused() -> None:
    with pytest.raises(ValueError, match="at least one altitude"):
        WindProfile(levels=())
    with pytest.raises(ValueError, match="one wind at 100 m, not two"):
        WindProfile(levels=(WindLevel(100.0, Wind()), WindLevel(100.0, Wind(east=1.0))))
    with pytest.raises(ValueError, match="wind of a level must be a Wind, not 3"):
        WindProfile(levels=((100.0, 3.0),))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="pairs of an altitude"):
        WindProfile(levels=(100.0,))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="altitude must lie in"):
        WindProfile(levels=(WindLevel(1e6, Wind()),))


@pytest.mark.parametrize(
    "text",
    [
        "altitude_m,from_deg,speed_mps\n0,270,10\n9000,270,30\n",
        "\ufeffAltitude_M;From_Deg;Speed_MPS\r\n0;270,0;10,0\r\n9000,0;270;30\r\n",
        "place,altitude_ft,u_mps,v_mps\nA,29527.559055,30,0\n\nB,0,10,0\n",
        "flight_level;u;v\n295,27559055;30;0\n0;10;0\n",
        'altitude_m,from_deg,speed_kt\n"0",270,19.438444924\n9000,270,58.315334773\n',
    ],
)
def test_files_are_read_whatever_their_units(text: str, tmp_path: Path) -> None:
    path = tmp_path / "winds.csv"
    path.write_bytes(text.encode())
    profile = load_profile(path)
    assert [level.altitude for level in profile.levels] == pytest.approx([0.0, 9_000.0])
    for level, speed in zip(profile.levels, (10.0, 30.0), strict=True):
        assert (level.wind.east, level.wind.north) == pytest.approx((speed, 0.0), abs=1e-7)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", r"line 1: no column gives the altitude: it has nothing; read are altitude_m"),
        ("height,u,v\n1,2,3\n", r"line 1: no column gives the altitude: it has height, u, v; read"),
        ("altitude_m,from_deg\n1,2\n", r"line 1: no columns give the wind: it has altitude_m, fr"),
        ("altitude_m,u,v\n1,2,x\n", r"line 2: column v: 'x' is not a number"),
        ("altitude_m,u,v\n1,2,\n", r"line 2: column v: '' is not a number"),
        ("altitude_m,u,v\n1,2,nan\n", r"line 2: column v: 'nan' is not a finite number"),
        ("altitude_m,u,v\n0,1,1\n1,2\n", r"line 3: it has 2 columns, its header 3"),
        ("altitude_m,u,v\n1,2,300\n", r"line 2: wind\.speed must lie in 0 … 150 m/s, not 300"),
        ("altitude_m,u,v\n1e6,2,3\n", r"line 2: altitude must lie in -1000 … 50000 m"),
        ("altitude_m,from_deg,speed_kt\n1,270,-3\n", r"line 2: wind speed must lie in 0 … 150"),
        ("altitude_m,from_deg,speed_kt\n1,4e3,3\n", r"from_deg must lie in -720 … 720 °, not 4000"),
        ("altitude_m,u,v\n1,2,3\n1,3,3\n", r"winds\.csv: levels must have one wind at 1 m"),
        ("altitude_m,u,v\n", r"winds\.csv: levels must have at least one altitude"),
    ],
)
def test_files_that_are_wrong_say_where(text: str, sentence: str, tmp_path: Path) -> None:
    path = tmp_path / "winds.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match=sentence):
        load_profile(path)


def test_a_file_that_is_no_text_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "winds.csv"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ValueError, match="is not UTF-8 text"):
        load_profile(path)

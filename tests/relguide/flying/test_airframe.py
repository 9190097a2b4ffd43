"""Every type has a source for each number; wrong files are refused with what would be right."""

import tomllib
from dataclasses import fields, replace
from importlib.resources import files
from math import cos, inf
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.flying.air import Air, pressure
from relguide.flying.airframe import QUANTITIES, Airframe
from relguide.flying.airframe_files import KEYS, airframe, known_airframes, load_airframe
from relguide.flying.dispersion import DISPERSED
from relguide.units import DEG, FT, G0, KT

A306 = airframe("A306")
OURS = files("relguide.flying").joinpath("types")
CONTENT = OURS.joinpath("a306.toml").read_text(encoding="utf-8")


def test_three_types_come_with_the_library() -> None:
    assert known_airframes() == ("A306", "A310", "AT76")
    assert [airframe(known).designator for known in known_airframes()] == list(known_airframes())


@pytest.mark.parametrize("designator", known_airframes())
def test_every_number_has_its_source(designator: str) -> None:
    table = tomllib.loads(OURS.joinpath(f"{designator.lower()}.toml").read_text(encoding="utf-8"))
    sources = table.pop("sources")
    assert set(table) == set(sources) == set(KEYS)
    for key, sentence in sources.items():
        assert sentence.endswith("."), key
        assert len(sentence) > 20, key


def test_every_number_of_an_airframe_has_a_key() -> None:
    numbers = [quantity.field for quantity in QUANTITIES]
    there = [field.name for field in fields(Airframe)]
    assert there == ["designator", "name", *numbers, "usable_lift", "thrust", "thrust_share"]


def test_numbers_are_read_in_the_units_of_their_keys() -> None:
    assert A306.max_bank == pytest.approx(30.0 * DEG)
    assert A306.reference_weight == 120_000.0
    assert A306.thrust.levels[1] == pytest.approx(5_000.0 * FT)
    assert A306.thrust.climb[0][0] == pytest.approx(317_400.0)
    assert A306.v_mo == pytest.approx(335.0 * KT)
    assert A306.m_mo == 0.82
    assert A306.ceiling == pytest.approx(40_000.0 * FT)
    assert A306.max_climb == pytest.approx(3_200.0 * FT / 60.0)


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


def test_a_type_that_is_not_there_is_refused_with_those_that_are() -> None:
    with pytest.raises(ValueError, match=r"no airframe 'B738': choose one of A306, A310, AT76, or"):
        airframe("B738")


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


def test_a_type_of_ones_own_is_loaded(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text(CONTENT.partition("[sources]")[0].replace('"A306"', '"MINE"'), encoding="utf-8")
    assert load_airframe(own) == load_airframe(str(own)) == replace(A306, designator="MINE")


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("m_mo = 0.82\n", "", r"m_mo is missing; it must be a number of 0\.1 … 0\.99\.$"),
        (
            "max_bank_deg = 30.0\n",
            "",
            r"max_bank_deg is missing; it must be a number of 1 … 60 deg\.$",
        ),
        ('name = "Airbus A300-600R"\n', "", r"name is missing; it must be a text\.$"),
        ("v_mo_kt = 335.0", "v_mo = 335.0", r"v_mo is not a key of an airframe; did you mean"),
        (
            "v_mo_kt = 335.0",
            "v_mo_kt = 335.0\ncolour = 3",
            "colour is not a key of an airframe; the keys are designator, name, max_bank_deg",
        ),
        ("v_mo_kt = 335.0", "v_mo_kt = 172_000", r"v_mo_kt must lie in 50 … 600 kt, not 172000 kt"),
        ("m_mo = 0.82", "m_mo = true", "m_mo must be a number, not True"),
        ("m_mo = 0.82", "m_mo = nan", "m_mo must be a finite number, not nan"),
        ("m_mo = 0.82", 'm_mo = "0.82"', "m_mo must be a number, not '0.82'"),
        ('designator = "A306"', "designator = 306", "designator must be a text, not 306"),
        ('designator = "A306"', 'designator = "A300-600R"', "designator must be the ICAO type"),
        ("wing_area_m2 = 260.0", "wing_area_m2 = 2.6", r"wing_area_m2 must lie in 5 … 2000 m²"),
        ("usable_lift = [1.04, ", "usable_lift = [", "usable lift: there must be 8 numbers"),
        ("usable_lift = [1.04", "usable_lift = [104.0", r"usable lift: each must lie in 0\.05 … 3"),
        ("thrust_machs = [0.2, 0.3", "thrust_machs = [0.3, 0.2", "machs must be two or more"),
        ("thrust_machs = [", "thrust_machs = [0.1, ", "climb: there must be 11 rows, .* of 9"),
        ("thrust_machs = [", "thrust_machs = 3 # ", "thrust_machs must be a list, not 3"),
        ("[317.4, ", "[17.4, ", "idle must give less than climb"),
        ("[317.4, ", "['317', ", "climb_thrust_kn must be a number, not '317'"),
        ("usable_lift_machs = [", "lift_machs = [", "lift_machs is not a key of an airframe; did"),
        ("m_mo = 0.82", "m_mo = ", "must be TOML: Invalid value"),
        ("[sources]", "[sources]\nwingspan_m = 'Ruler.'", r"in \[sources\]: wingspan_m is not"),
        ("[sources]", "[[sources]]", "sources must be a table with one sentence a key"),
        ('ceiling_ft = "', 'ceiling_ft = 3 # "', r"sources\.ceiling_ft must be a text, not 3"),
    ],
)
def test_wrong_files_are_refused_by_file_and_key(
    tmp_path: Path, old: str, new: str, sentence: str
) -> None:
    assert old in CONTENT
    own = tmp_path / "own.toml"
    own.write_text(CONTENT.replace(old, new), encoding="utf-8")
    with pytest.raises(ValueError, match=sentence) as refused:
        load_airframe(own)
    assert str(refused.value).startswith(str(own))


def test_what_is_no_text_is_refused_by_file(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_bytes(b"designator = '\xff'")
    with pytest.raises(ValueError, match=r"own\.toml must be a text in UTF-8"):
        load_airframe(own)
    with pytest.raises(FileNotFoundError, match=r"none\.toml"):
        load_airframe(tmp_path / "none.toml")

"""Every type has a source for each number; wrong files are refused with what would be right."""

import tomllib
from dataclasses import fields, replace
from importlib.resources import files
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.flying.air import Air
from relguide.flying.airframe import (
    KEYS,
    QUANTITIES,
    Airframe,
    Quantity,
    airframe,
    known_airframes,
    load_airframe,
)
from relguide.units import DEG, FT, KT

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
    assert ["designator", "name", *numbers] == [field.name for field in fields(Airframe)]


def test_numbers_are_read_in_the_units_of_their_keys() -> None:
    assert A306.max_bank == pytest.approx(30.0 * DEG)
    assert A306.least_cas == pytest.approx(165.0 * KT)
    assert A306.v_mo == pytest.approx(335.0 * KT)
    assert A306.m_mo == 0.82
    assert A306.ceiling == pytest.approx(40_000.0 * FT)
    assert A306.max_climb == pytest.approx(3_200.0 * FT / 60.0)


def test_the_a300_rolls_and_changes_speed_as_its_sources_say() -> None:
    assert A306.max_roll_rate == pytest.approx(3.75 * DEG)
    assert A306.roll_time_constant == 0.5
    assert A306.speed_time_constant == 5.0
    assert (A306.max_acceleration, A306.max_deceleration) == (0.4, 1.0)
    assert A306.idle_deceleration == 0.58


def test_the_atr_is_slower_and_stays_lower() -> None:
    atr = airframe("AT76")
    assert atr.v_mo < A306.v_mo
    assert atr.least_cas < A306.least_cas
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
    for level, (least, most) in ((low, below), (high, above)):
        assert air.cas_from_tas(least, level) == pytest.approx(kind.least_cas)
        mach, cas = air.mach(most, level), air.cas_from_tas(most, level)
        assert mach <= kind.m_mo * (1.0 + 1e-9)
        assert cas <= kind.v_mo * (1.0 + 1e-9)
        assert mach == pytest.approx(kind.m_mo) or cas == pytest.approx(kind.v_mo)


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
        ({"idle_deceleration": 1.2}, r"idle_deceleration \(1\.2 m/s²\) must not exceed"),
        ({"least_cas": 180.0}, r"least_cas \(349\.892 kt\) must be below v_mo \(335 kt\)"),
        ({"ceiling": 19_800.0}, r"ceiling \(64,961 ft\) must be lower: least_cas \(165 kt\) is M"),
        ({"m_mo": 82.0}, r"m_mo must lie in 0\.1 … 0\.99, not 82\."),
    ],
)
def test_airframes_that_cannot_fly_are_refused(change: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(A306, **change)  # type: ignore[arg-type]


@pytest.mark.parametrize("share", [0.7, 1.3])
@pytest.mark.parametrize("quantity", QUANTITIES[:7], ids=lambda quantity: quantity.field)
def test_constants_may_be_a_third_off(quantity: Quantity, share: float) -> None:
    varied = share * getattr(A306, quantity.field)
    assert getattr(replace(A306, **{quantity.field: varied}), quantity.field) == varied


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
        ("least_cas_kt = 165.0", "least_cas_kt = 340", r"least_cas \(340 kt\) must be below v_mo"),
        ("max_deceleration_mps2 = 1.0", "max_deceleration_mps2 = 0.5", "brakes add to idle"),
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

"""Every type has a source for each number; wrong files are refused with what would be right."""

import tomllib
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import pytest

from relguide.flying.airframe_files import KEYS, airframe, known_airframes, load_airframe
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


def test_numbers_are_read_in_the_units_of_their_keys() -> None:
    assert A306.max_bank == pytest.approx(30.0 * DEG)
    assert A306.reference_weight == 120_000.0
    assert A306.thrust.levels[1] == pytest.approx(5_000.0 * FT)
    assert A306.thrust.climb[0][0] == pytest.approx(317_400.0)
    assert A306.v_mo == pytest.approx(335.0 * KT)
    assert A306.m_mo == 0.82
    assert A306.ceiling == pytest.approx(40_000.0 * FT)
    assert A306.max_climb == pytest.approx(3_200.0 * FT / 60.0)


def test_a_type_that_is_not_there_is_refused_with_those_that_are() -> None:
    with pytest.raises(ValueError, match=r"no airframe 'B738': choose one of A306, A310, AT76, or"):
        airframe("B738")


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

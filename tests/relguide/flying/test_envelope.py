"""What cannot be flown is refused in a crew's units, and levels are found where it can."""

import re

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from relguide.flying.air import STANDARD_AIR, Air
from relguide.flying.airframe_files import airframe, known_airframes
from relguide.flying.envelope import (
    FL310,
    SLOW_MARGIN,
    envelope_fault,
    flight_level,
    level_for,
)
from relguide.units import DEG, FT, KT

A306, AT76 = airframe("A306"), airframe("AT76")
airs = st.builds(Air, isa_deviation=st.floats(-20.0, 20.0))


def test_what_can_be_flown_has_no_fault() -> None:
    assert envelope_fault(A306, FL310, STANDARD_AIR, tas=240.0, bank=-25.0 * DEG) == ""
    assert envelope_fault(A306, A306.ceiling, STANDARD_AIR, tas=230.0, bank=30.0 * DEG) == ""


@pytest.mark.parametrize(
    ("level", "tas_kt", "bank_deg", "sentence"),
    [
        (
            310,
            583,
            0,
            "The A306 cannot fly 583 kt at FL310: M 0.82 allows 481 kt there;"
            " choose 481 kt or less.",
        ),
        (
            310,
            486,
            0,
            "The A306 cannot fly 486 kt at FL310: M 0.82 allows 481 kt there;"
            " choose 481 kt or less, or FL280.",
        ),
        (
            100,
            400,
            0,
            "The A306 cannot fly 400 kt at FL100: 335 kt CAS allows 384 kt there;"
            " choose 384 kt or less, or FL130.",
        ),
        (
            310,
            200,
            0,
            "The A306 cannot fly 200 kt at FL310 at 120 t: the least speed is 277 kt there;"
            " choose 277 kt or more, or FL130 or below.",
        ),
        (
            310,
            100,
            0,
            "The A306 cannot fly 100 kt at FL310 at 120 t: the least speed is 277 kt there;"
            " choose 277 kt or more.",
        ),
        (
            310,
            280,
            25,
            "The A306 cannot fly 280 kt at FL310 at 120 t: the least speed with 25° of bank is"
            " 293 kt there; choose 293 kt or more, or FL280 or below.",
        ),
        (430, 450, 0, "The A306 cannot fly at FL430: choose FL400, its ceiling, or below."),
        (310, 450, -35, "The A306 cannot bank by 35°: choose 30° or less."),
    ],
)
def test_faults_say_what_would_be_right(
    level: int, tas_kt: float, bank_deg: float, sentence: str
) -> None:
    fault = envelope_fault(
        A306, 100.0 * level * FT, STANDARD_AIR, tas=tas_kt * KT, bank=bank_deg * DEG
    )
    assert fault == sentence


@pytest.mark.parametrize(
    ("level", "tas_kt", "bank_deg", "weight", "sentence"),
    [
        (
            390,
            190,
            0,
            140e3,
            "The A306 cannot fly 190 kt at FL390 at 140 t: the least speed is 393 kt there;"
            " choose 393 kt or more, or FL040 or below.",
        ),
        (
            350,
            470,
            0,
            168e3,
            "The A306 cannot fly 470 kt at FL350 at 168 t: thrust and lift allow 455 kt there;"
            " choose 455 kt or less, or FL340.",
        ),
        (
            390,
            430,
            25,
            140e3,
            "The A306 cannot fly at FL390 at 140 t: no speed carries it there with 25° of bank;"
            " choose FL380 or below.",
        ),
        (
            350,
            430,
            0,
            171.7e3,
            "The A306 cannot fly at FL350 at 171.7 t: climb thrust keeps no speed there;"
            " choose FL340 or below.",
        ),
    ],
)
def test_weight_takes_speeds_and_levels(
    level: int, tas_kt: float, bank_deg: float, weight: float, sentence: str
) -> None:
    fault = envelope_fault(
        A306, 100.0 * level * FT, STANDARD_AIR, tas=tas_kt * KT, bank=bank_deg * DEG, weight=weight
    )
    assert fault == sentence


@given(
    st.sampled_from(known_airframes()),
    airs,
    st.floats(0.05, 1.0),
    st.floats(40.0, 390.0),
    st.floats(0.0, 1.0),
    st.floats(0.0, 27.0),
)
def test_what_a_fault_advises_can_be_flown(
    designator: str, air: Air, share: float, tas: float, heavy: float, bank: float
) -> None:
    kind = airframe(designator)
    altitude = share * kind.ceiling
    weight = kind.least_weight + heavy * (kind.most_weight - kind.least_weight)

    def fault_at(level: float, tas: float) -> str:
        return envelope_fault(kind, level, air, tas=tas, bank=bank * DEG, weight=weight)

    fault = fault_at(altitude, tas)
    least, most = kind.tas_range(altitude, air, weight, bank * DEG)
    if bool(fault) == (least <= tas <= most):  # not even a whole knot lies between
        assert most - least < 2.0 * KT
    assume(fault)
    advised = re.search(r"choose (\d+) kt or (?:less|more)", fault)
    if advised:
        assert fault_at(altitude, int(advised[1]) * KT) == ""
        for level in re.findall(r"or FL(\d+)", fault):
            assert fault_at(int(level) * 100.0 * FT, tas) == ""
    else:
        below = re.search(r"choose FL(\d+) or below", fault)
        assert below
        least, most = kind.tas_range(int(below[1]) * 100.0 * FT, air, weight, bank * DEG)
        assert least < most


def test_the_preferred_level_is_kept_where_it_serves() -> None:
    assert level_for(A306, STANDARD_AIR, slowest=150.0, fastest=240.0) == FL310
    odd = 9_600.0
    assert level_for(A306, STANDARD_AIR, slowest=150.0, fastest=240.0, preferred=odd) == odd


@pytest.mark.parametrize(
    ("slowest_kt", "fastest_kt", "level"), [(260, 480, 260), (240, 400, 220), (194, 350, 90)]
)
def test_slow_leaders_take_a_flight_down(slowest_kt: int, fastest_kt: int, level: int) -> None:
    found = level_for(A306, STANDARD_AIR, slowest=slowest_kt * KT, fastest=fastest_kt * KT)
    assert flight_level(found) == f"FL{level:03d}"


def test_an_atr_never_flies_where_airliners_do() -> None:
    assert level_for(AT76, STANDARD_AIR, slowest=110.0, fastest=130.0) == AT76.ceiling


@given(st.sampled_from(known_airframes()), airs, st.floats(60.0, 240.0), st.floats(0.0, 60.0))
def test_a_level_is_the_nearest_that_serves_or_there_is_none(
    designator: str, air: Air, slowest: float, more: float
) -> None:
    kind, fastest = airframe(designator), slowest + more
    wholes = [step * 1000.0 * FT for step in range(1, round(kind.ceiling / (1000.0 * FT)) + 1)]
    serving = [
        level
        for level in wholes
        if SLOW_MARGIN * kind.tas_range(level, air).least <= slowest
        and fastest <= kind.tas_range(level, air).most
    ]
    if serving:
        found = level_for(kind, air, slowest=slowest, fastest=fastest)
        distances = [abs(level - FL310) for level in serving]
        assert abs(found - FL310) == pytest.approx(min(distances), abs=1.0)
        assert envelope_fault(kind, found, air, tas=slowest) == ""
        assert envelope_fault(kind, found, air, tas=fastest) == ""
    else:
        with pytest.raises(ValueError, match=rf"The {designator} can fly .* at no level"):
            level_for(kind, air, slowest=slowest, fastest=fastest)


@pytest.mark.parametrize(
    ("slowest_kt", "fastest_kt", "sentence"),
    [
        (
            194,
            480,
            "The A306 can fly both 194 kt and 480 kt at no level: the one needs FL090 or below,"
            " the other FL260 … FL310; choose speeds closer together.",
        ),
        (
            150,
            300,
            "The A306 can fly 150 kt at no level: choose 170 kt or more,"
            " its slowest at FL010 with 2 % in hand.",
        ),
        (
            300,
            600,
            "The A306 can fly 600 kt at no level: choose 489 kt or less, its fastest at FL270.",
        ),
    ],
)
def test_speeds_without_a_level_are_refused_with_what_would_be_right(
    slowest_kt: int, fastest_kt: int, sentence: str
) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        level_for(A306, STANDARD_AIR, slowest=slowest_kt * KT, fastest=fastest_kt * KT)


def test_the_slowest_must_not_be_the_faster() -> None:
    with pytest.raises(ValueError, match="fastest must lie in 200 … 400 m/s, not 150 m/s"):
        level_for(A306, STANDARD_AIR, slowest=200.0, fastest=150.0)


def test_levels_are_said_as_crews_say_them() -> None:
    assert [flight_level(feet * FT) for feet in (1_000, 9_000, 31_000)] == [
        "FL010",
        "FL090",
        "FL310",
    ]
    assert flight_level(FL310) == "FL310"

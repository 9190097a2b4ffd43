"""Whatever is given: an answer, or a ValueError with a sentence, and never much work."""

import re
from dataclasses import fields, replace
from decimal import Decimal
from fractions import Fraction
from math import inf, isfinite, nan, nextafter, pi, radians
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide import (
    CALM,
    LEFT,
    RIGHT,
    Arc,
    BoundaryArc,
    FlyStraight,
    Leader,
    NoPlan,
    Plan,
    Pursuer,
    Reason,
    Situation,
    Straight,
    Trajectory,
    TurnTo,
    Wind,
    alternatives,
    candidates,
    certify,
    plan,
    wind_from,
)
from relguide.planning.inputs import expect_within
from relguide.planning.limits import DISTANCE, HEADING, POSITION, TAS, WIND
from relguide.planning.optimality import check
from relguide.planning.regular import (
    RegularTrajectory,
    Triplet,
    regular_from_trajectory,
    trajectory_from_regular,
)
from relguide.planning.regular_evaluation import evaluate
from relguide.planning.words import HORIZON
from relguide.units import DEG

PURSUER = Pursuer(x=-20e3, y=9e3, heading=1.0, tas=240.0, max_bank=25 * DEG)
LEADER = Leader(x=0.0, y=0.0, heading=0.0, tas=200.0)
SITUATION = Situation(pursuer=PURSUER, leader=LEADER, slot_distance=12e3, min_separation=9e3)
STRAIGHT = FlyStraight(duration=60.0)
TURN = TurnTo(heading=1.0, turn=RIGHT, bank=20 * DEG)
PATH = Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=(Straight(length=1e3),))

NO_NUMBERS = (
    True,
    np.True_,
    None,
    "12",
    b"12",
    1j,
    (1.0,),
    np.array([1.0]),
    np.array(1.0),
    Decimal(1),
    object(),
    nan,
    inf,
    -inf,
    np.float32(inf),
    10**400,
    -(10**400),
)
"""None of these is a number that one could fly."""


@pytest.mark.parametrize(
    "whole",
    [PURSUER, LEADER, SITUATION, STRAIGHT, TURN, CALM, PATH],
    ids=lambda w: type(w).__name__,
)
@pytest.mark.parametrize("value", NO_NUMBERS, ids=lambda value: repr(value).split(" at ")[0])
def test_what_is_no_number_is_refused_by_name(whole: Any, value: object) -> None:
    for field in fields(whole):
        if isinstance(getattr(whole, field.name), float):
            with pytest.raises(ValueError, match=rf"{field.name} must be a (finite )?number"):
                replace(whole, **{field.name: value})


@pytest.mark.parametrize(
    "value", [12_000, np.float32(12_000), np.int64(12_000), np.float64(12_000), Fraction(12_000)]
)
def test_other_numbers_become_floats(value: Any) -> None:
    given = replace(SITUATION, slot_distance=value, pursuer=replace(PURSUER, x=value))
    assert type(given.slot_distance) is type(given.pursuer.x) is float
    assert given == replace(SITUATION, pursuer=replace(PURSUER, x=12_000.0))


def test_there_is_one_zero() -> None:
    assert str(replace(PURSUER, x=-0.0).x) == "0.0"


@pytest.mark.parametrize("name", ["x", "y", "heading", "tas"])
@pytest.mark.parametrize("whole", [PURSUER, LEADER], ids=lambda w: type(w).__name__)
def test_floats_within_the_limits_are_judged_as_any_number_is(whole: Any, name: str) -> None:
    """Aircraft of plain floats are judged in one look, which must judge as `expect_within` does."""
    limits = {"heading": HEADING, "tas": TAS}.get(name, POSITION)
    edges = {*limits[:2], *limits.ends, *(-end for end in limits.ends), 0.0, 5e-324, 1.0, 250.0}
    tried = [
        toward for edge in edges for toward in (edge, nextafter(edge, inf), nextafter(edge, -inf))
    ]
    for value in (*tried, -0.0, nan, inf, -inf):
        try:
            right = repr(expect_within(f"{type(whole).__name__.lower()}.{name}", value, *limits))
        except ValueError as refused:
            with pytest.raises(ValueError, match=f"^{re.escape(str(refused))}$"):
                replace(whole, **{name: value})
        else:
            assert repr(getattr(replace(whole, **{name: value}), name)) == right


@pytest.mark.parametrize("turn", [0, 2, 1.0, "left", None, True, nan, (1,), np.array([1, -1])])
def test_a_turn_is_left_or_right(turn: Any) -> None:
    for make in (
        lambda: replace(TURN, turn=turn),
        lambda: Triplet(turn=turn, turn_angle=1.0, length=1.0),
        lambda: replace(PATH, segments=(Arc(turn=turn, turn_angle=1.0, radius=1e3),)),
        lambda: replace(PATH, segments=(BoundaryArc(side=turn, bends=((1.0, 0.0),)),)),
    ):
        with pytest.raises(ValueError, match="must be LEFT"):
            make()
    assert replace(TURN, turn=np.int64(-1)) == replace(TURN, turn=RIGHT)


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: replace(SITUATION, pursuer=LEADER),
        lambda: replace(SITUATION, leader=None),
        lambda: replace(SITUATION, wind=(1.0, 2.0)),
        lambda: replace(LEADER, intent="LR"),
        lambda: replace(LEADER, intent=(STRAIGHT, 60.0)),
        lambda: replace(LEADER, intent=STRAIGHT),
        lambda: replace(PURSUER, heading=1e7),
        lambda: wind_from(inf, 10.0),
        lambda: wind_from(0.0, -10.0),
        lambda: wind_from("north", 10.0),
        lambda: Wind(east=1e308, north=1e308),
        lambda: plan(None),
        lambda: plan(PURSUER),
        lambda: candidates({}),
        lambda: certify(None, SITUATION),
        lambda: certify(PATH, None),
        lambda: check(None, SITUATION),
        lambda: check(PATH, PATH),
        lambda: check(PATH, SITUATION, samples=10**12),
        lambda: PATH.pose_at(nan),
        lambda: PATH.pose_at("soon"),
        lambda: replace(PATH, tas=0.0),
        lambda: replace(PATH, tas=5e-324),
        lambda: replace(PATH, segments=[Straight(length=1.0)]),
        lambda: replace(PATH, segments=("S",)),
        lambda: replace(PATH, segments=(Straight(length=1e308),) * 2),
        lambda: replace(PATH, segments=(Arc(turn=LEFT, turn_angle=-1.0, radius=-5.0),)),
        lambda: replace(PATH, segments=(Arc(turn=LEFT, turn_angle=1.0, radius=0.0),)),
        lambda: replace(PATH, segments=(BoundaryArc(side=LEFT, bends=()),)),
        lambda: replace(PATH, segments=(BoundaryArc(side=LEFT, bends=((2.0, 0.0), (-1.0, 0.0))),)),
        lambda: Triplet(turn=LEFT, turn_angle=-1.0, length=0.0),
        lambda: RegularTrajectory(triplets=((1, 0.5, 10.0),)),
        lambda: regular_from_trajectory(SITUATION, turn_radius=9e3),
        lambda: regular_from_trajectory(PATH, turn_radius=None),
        lambda: trajectory_from_regular(PATH, SITUATION),
        lambda: evaluate(PATH, SITUATION),
    ],
)
def test_what_cannot_be_is_refused(wrong: Any) -> None:
    with pytest.raises(ValueError, match=r"\.$"):
        wrong()


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high)


def lengths(most: float) -> st.SearchStrategy[float]:
    corners = [0.0, -0.0, 5e-324, -5e-324, 1e-300, 1e-9, most, -most]
    return st.one_of(st.sampled_from(corners), numbers(-most, most))


headings = st.one_of(
    st.sampled_from(
        [0.0, -0.0, 5e-324, -1e-17, 1e-9, 0.5 * pi, pi, nextafter(pi, 0.0), 2.0 * pi, -pi, 3.0 * pi]
    ),
    numbers(0.0, 2.0 * pi),
)
banks = st.one_of(st.sampled_from([1 * DEG, 60 * DEG]), numbers(1.0, 60.0).map(radians))
speeds = st.one_of(st.sampled_from([30.0, 400.0]), numbers(30.0, 400.0))
durations = st.one_of(st.sampled_from([0.0, 5e-324, 1e-12, 86_400.0]), numbers(0.0, 1000.0))


@st.composite
def anything(draw: st.DrawFn) -> Situation:
    """The whole box that is accepted, its corners and its degenerate places before all."""
    tas, heading = draw(speeds), draw(headings)
    leader_tas = draw(
        st.one_of(st.sampled_from([tas, nextafter(tas, 0.0), nextafter(tas, inf)]), speeds)
    )
    pieces = st.one_of(
        st.builds(FlyStraight, duration=durations),
        st.builds(
            TurnTo,
            heading=st.one_of(
                headings, st.sampled_from([heading, heading + 1e-9, heading + pi, heading - 5e-10])
            ),
            turn=st.sampled_from([LEFT, RIGHT]),
            bank=banks,
        ),
    )
    distance = abs(draw(lengths(DISTANCE.high)))
    nearest = draw(st.one_of(st.sampled_from([0.0, distance]), numbers(0.0, distance)))
    x, y = draw(lengths(0.5 * POSITION.high)), draw(lengths(0.5 * POSITION.high))
    bearing = draw(st.sampled_from([heading, heading + pi, heading + 0.5 * pi]))
    off_x, off_y = draw(
        st.one_of(
            st.just((0.0, 0.0)),
            st.sampled_from([nearest, nearest * (1.0 + 1e-9), distance]).map(
                lambda d: (d * float(np.sin(bearing)), d * float(np.cos(bearing)))
            ),
            st.tuples(lengths(0.5 * POSITION.high), lengths(0.5 * POSITION.high)),
        )
    )
    blown = draw(st.one_of(st.just(0.0), numbers(0.0, min(WIND.high, 0.9 * leader_tas))))
    return Situation(
        pursuer=Pursuer(
            x=x + off_x,
            y=y + off_y,
            heading=draw(st.one_of(st.sampled_from([heading, heading + pi]), headings)),
            tas=tas,
            max_bank=draw(banks),
        ),
        leader=Leader(
            x=x,
            y=y,
            heading=heading,
            tas=min(max(leader_tas, 30.0), 400.0),
            intent=tuple(draw(st.one_of(st.just([]), st.lists(pieces, max_size=4)))),
        ),
        slot_distance=distance,
        min_separation=nearest,
        wind=wind_from(draw(headings), blown),
    )


@pytest.mark.slow
@settings(max_examples=300)
@given(situation=anything())
def test_all_that_is_accepted_is_answered(situation: Situation) -> None:
    clear_answer(situation)


def clear_answer(situation: Situation) -> Plan | NoPlan:
    """The answer, which must be clear."""
    answer = plan(situation)
    match answer:
        case NoPlan(message=message):
            assert message.endswith(".")
            assert "nan" not in message
        case Plan(optimality=optimality, certificate=certificate):
            time = answer.time_to_converge
            assert 0.0 <= time <= HORIZON
            # 1e-9 R of rounding is left out of a path
            assert optimality.lower_bound <= time + 2e-9 * situation.pursuer.turn_radius
            assert certificate.holds
            assert isfinite(certificate.lower_bound)
    return answer


def near_equal(
    *, tas: float, leader_tas: float, x: float, y: float, heading: float, bank_deg: float,
    leader_heading: float, slot_distance: float, min_separation: float,
) -> Situation:  # fmt: skip
    return Situation(
        pursuer=Pursuer(x=x, y=y, heading=heading, tas=tas, max_bank=bank_deg * DEG),
        leader=Leader(x=0.0, y=0.0, heading=leader_heading, tas=leader_tas),
        slot_distance=slot_distance,
        min_separation=min_separation,
    )


HARDEST = {
    # paths of 10¹⁸ s, of which every digit is rounding: the certificate halved without end
    "an_ulp_slower": near_equal(
        tas=272.1898354009719, leader_tas=272.18983540097184, x=-212475.26362542092,
        y=460226.93086296367, heading=0.41061591936185293, bank_deg=25.0,
        leader_heading=3.41540529136991, slot_distance=200e3, min_separation=140e3,
    ),
    "some_ulps_faster": near_equal(
        tas=30.0, leader_tas=30.00000000000003, x=0.0, y=-21022.4456363, heading=3.0,
        bank_deg=60.0, leader_heading=0.0, slot_distance=200e3, min_separation=0.0,
    ),
    # the search beside the limit asked whether such paths clear it
    "head_on_an_ulp_faster": near_equal(
        tas=30.0, leader_tas=30.000000000000004, x=-9.517619025353042e-13, y=95176.19025353041,
        heading=pi, bank_deg=25.0, leader_heading=-1e-17, slot_distance=103127.67672256786,
        min_separation=90643.990717648,
    ),
    # two centimetres apart at equal speed: so were the alternatives
    "two_centimetres_behind": near_equal(
        tas=398.3520591776493, leader_tas=398.3520591776494, x=-0.0189160187263042,
        y=0.00139830782, heading=1.6445210717989738, bank_deg=28.2, leader_heading=1.64452107179897,
        slot_distance=0.018981078775320823, min_separation=0.014997066039490105,
    ),
    # a plan that waits for the slot, and beside it a path of thousands of hours
    "waits_for_the_slot": Situation(
        pursuer=Pursuer(
            x=-88958.66, y=-1e6, heading=3.3887623889153224, tas=334.63013137517675,
            max_bank=25 * DEG,
        ),
        leader=Leader(
            x=0.0, y=0.0, heading=1.4195093006653126, tas=334.6301379293355,
            intent=(
                TurnTo(heading=-1.7220833529244806, turn=RIGHT, bank=1 * DEG),
                TurnTo(heading=3.3887623889153224, turn=LEFT, bank=60 * DEG),
            ),
        ),
        slot_distance=1862.0566739348305, min_separation=0.0,
        wind=Wind(east=-145.44131381662126, north=36.699104012156646),
    ),
    "twenty_full_turns": replace(
        SITUATION,
        leader=replace(
            LEADER,
            intent=tuple(
                TurnTo(heading=-1e-8 * (i + 1), turn=RIGHT, bank=1 * DEG) for i in range(20)
            ),
        ),
    ),
    "twenty_days": replace(
        SITUATION, leader=replace(LEADER, intent=(*(FlyStraight(duration=86_400.0),) * 19, TURN))
    ),
}  # fmt: skip
"""The longest that fuzzing has found; each once took seconds, or for ever."""


@pytest.mark.parametrize("name", HARDEST)
def test_the_hardest_are_answered(name: str) -> None:
    answer = clear_answer(HARDEST[name])
    if isinstance(answer, Plan):
        alternatives(answer)
        check(answer, HARDEST[name])


def test_what_takes_for_ever_is_said_to() -> None:
    for name in ("an_ulp_slower", "twenty_days"):
        answer = plan(HARDEST[name])
        assert isinstance(answer, NoPlan)
        assert answer.reason is Reason.BEYOND_HORIZON


@pytest.mark.parametrize("length", [1e9, 1e15, 1e100, 1e300])
def test_a_path_of_any_length_is_judged(length: float) -> None:
    path = replace(PATH, x=9_001.0, tas=200.0, segments=(Straight(length=length),))
    beside = certify(path, SITUATION)
    assert beside.lower_bound <= beside.least_separation <= 9_001.0
    turns = (Arc(turn=LEFT, turn_angle=length * 1e-4, radius=1e4),)
    circling = certify(replace(path, segments=turns), SITUATION)
    assert circling.lower_bound <= circling.least_separation <= 9_001.0


def test_a_path_of_days_is_not_checked() -> None:
    following = replace(PATH, y=-12e3, segments=(Straight(length=1e12),))
    with pytest.raises(ValueError, match="12 h at most"):
        check(following, SITUATION)

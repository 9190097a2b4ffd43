"""Amid others: how near a flight ahead comes, and what plans take of each."""

from dataclasses import replace
from math import hypot, inf

import numpy as np
import pytest

from relguide.flying.belief import Belief
from relguide.flying.guidance.amid import Nearing, keeps_clear, nearings, others_after
from relguide.flying.guidance.announcements import Alerted
from relguide.flying.guidance.escape import escape, kept_on_heading
from relguide.flying.guidance.forecast import Forecast
from relguide.flying.guidance.memory import StandingAlert
from relguide.flying.guidance.monitor import Outlook, judge_others
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.guidance.situations import situation_now
from relguide.flying.seen_others import SeenOther
from relguide.kernels.flight.flight_records import Body
from relguide.planning.aircraft import Traffic
from relguide.planning.cells import Cell, Disc
from relguide.planning.wind import CALM
from relguide.units import DEG, NM
from tests.relguide.flying.guidance.beliefs import behind, observe
from tests.relguide.flying.guidance.test_forecast import make_forecast

BELIEF, ASSIGNMENT = observe(behind(along=60_000.0, tas=230.0))
LIMIT = 5.0 * NM


def seen(
    ident: str = "BAW12", *, x: float, y: float, heading: float, bank: float = 0.0
) -> SeenOther:
    return SeenOther(
        ident=ident,
        body=Body(x, y, heading * DEG, bank * DEG, 0.0, 220.0, 0.0),
        heading=heading * DEG,
        wind=CALM,
        min_separation=LIMIT,
    )


def straight_on(belief: Belief = BELIEF, seconds: int = 300) -> Forecast:
    """The pursuer flies on as it flies now."""
    own = np.tile(np.array(belief.own), (seconds + 1, 1))
    own[:, 1] += belief.own.tas * np.arange(seconds + 1.0)  # it flies north
    return make_forecast([20_000.0] * seconds)._replace(t=belief.t, own=own)


CROSSING = seen(x=30_000.0, y=BELIEF.own.y + 36_000.0, heading=270.0)


def test_the_nearest_is_found_between_the_seconds() -> None:
    belief = replace(BELIEF, others=(CROSSING,))
    (near,) = nearings(straight_on(), belief, ASSIGNMENT)
    t = np.linspace(0.0, 300.0, 300_001)
    own_y = BELIEF.own.y + BELIEF.own.tas * t
    apart = np.hypot(BELIEF.own.x - (30_000.0 - 220.0 * t), own_y - CROSSING.body.y)
    k = int(np.argmin(apart))
    assert near.least == pytest.approx(apart[k], abs=0.01)
    assert near.at == pytest.approx(t[k], abs=0.1)
    assert near.breaks == pytest.approx(t[np.flatnonzero(apart < LIMIT)[0]], abs=1.0)
    assert near.now == pytest.approx(hypot(30_000.0, 36_000.0))


def test_the_least_spare_comes_first_whatever_its_minimum() -> None:
    wide = replace(CROSSING, ident="WIDE", min_separation=20_000.0)
    cell = Cell(ident="CB1", shape=Disc(x=90_000.0, y=0.0, radius=5_000.0))
    belief = replace(BELIEF, others=(CROSSING, wide), cells=(cell,))
    found = nearings(straight_on(), belief, ASSIGNMENT)
    assert [near.ident for near in found] == ["WIDE", "BAW12", "CB1"]
    assert [near.spare for near in found] == sorted(near.spare for near in found)


def test_a_cell_is_met_where_it_will_be() -> None:
    """It comes from the left at 20 m/s, and grows by 10 m/s."""
    cell = Cell(
        ident="CB1",
        shape=Disc(x=-9_000.0, y=BELIEF.own.y + 46_000.0, radius=4_000.0),
        east=20.0,
        growth=10.0,
    )
    (near,) = nearings(straight_on(), replace(BELIEF, cells=(cell,)), ASSIGNMENT)
    t = np.arange(301.0)
    far = np.hypot(9_000.0 - 20.0 * t, BELIEF.own.tas * t - 46_000.0) - 4_000.0 - 10.0 * t
    assert near.least == pytest.approx(far.min(), abs=1e-6)
    assert near.breaks == t[np.flatnonzero(far < 0.0)[0]]
    assert near.sentence == "Weather CB1 is in the way"


def test_one_that_turns_unannounced_may_turn_on_within_a_minute() -> None:
    """Straight on it stays abeam."""
    own = BELIEF.own
    turning = seen(x=own.x - 12_000.0, y=own.y, heading=0.0, bank=25.0)
    belief = replace(BELIEF, others=(turning,))
    (expected,) = nearings(straight_on(), belief, ASSIGNMENT)
    (feared,) = nearings(straight_on(), belief, ASSIGNMENT, turning_on=True)
    assert expected.breaks == inf
    assert feared.breaks <= DEFAULT.caution


def test_what_is_kept_beside_a_minimum_is_asked_where_there_is_room() -> None:
    apart = LIMIT + 150.0
    abeam = seen(x=BELIEF.own.x + apart, y=BELIEF.own.y, heading=0.0)
    beside = replace(abeam, body=abeam.body._replace(tas=BELIEF.own.tas), margin=200.0)
    assert keeps_clear(straight_on(), replace(BELIEF, others=(beside,)), ASSIGNMENT) is None
    nearer = replace(beside, body=beside.body._replace(heading=-0.5 * DEG), heading=-0.5 * DEG)
    belief = replace(BELIEF, others=(nearer,))
    assert keeps_clear(straight_on(), belief, ASSIGNMENT) is not None


def test_plans_give_each_a_berth_but_can_begin_where_the_aircraft_is() -> None:
    pursuer = situation_now(BELIEF, ASSIGNMENT).pursuer
    near = seen("NEAR", x=pursuer.x + LIMIT + 100.0, y=pursuer.y, heading=0.0)
    lost = seen("LOST", x=pursuer.x - LIMIT + 100.0, y=pursuer.y, heading=0.0)
    cell = Cell(ident="CB1", shape=Disc(x=pursuer.x, y=pursuer.y + 6_100.0, radius=6_000.0))
    belief = replace(BELIEF, others=(CROSSING, near, lost), cells=(cell,))
    far, close, already, weather = others_after(belief, pursuer, 0.0, 400.0)
    assert isinstance(far, Traffic)
    assert far.min_separation == LIMIT + 400.0
    assert isinstance(close, Traffic)
    assert close.min_separation == pytest.approx(LIMIT + 99.0)
    assert isinstance(already, Traffic)
    assert already.min_separation == LIMIT
    assert isinstance(weather, Cell)
    assert isinstance(weather.shape, Disc)
    assert weather.shape.radius == pytest.approx(6_099.0)


def test_those_at_another_level_are_left_out_of_plans() -> None:
    belief = replace(BELIEF, others=(replace(CROSSING, counts=()),))
    assert situation_now(belief, ASSIGNMENT).others == ()
    assert nearings(straight_on(), belief, ASSIGNMENT)[0].least == inf


def test_an_escape_keeps_clear_of_all() -> None:
    """Head-on, with another abeam on the side to which it would turn."""
    own = BELIEF.own
    oncoming = seen("ONE", x=own.x, y=own.y + 34_000.0, heading=180.0)
    alone = escape(replace(BELIEF, others=(oncoming,)), ASSIGNMENT, LIMIT)
    assert alone.least_separation >= LIMIT
    side = 1.0 if 0.0 < alone.heading < np.pi else -1.0
    abeam = seen("TWO", x=own.x + side * (LIMIT + 2_000.0), y=own.y, heading=0.0)
    belief = replace(BELIEF, others=(oncoming, abeam))
    both = escape(belief, ASSIGNMENT, LIMIT)
    assert both.least_separation >= LIMIT
    assert (both.heading - np.pi) * (alone.heading - np.pi) < 0.0  # to the other side
    kept, of = kept_on_heading(belief, ASSIGNMENT, alone.heading)
    assert (kept < LIMIT, of) == (True, "TWO")


def test_an_escape_keeps_out_of_weather() -> None:
    own = BELIEF.own
    cell = Cell(ident="CB1", shape=Disc(x=own.x + 2_000.0, y=own.y + 40_000.0, radius=12_000.0))
    belief = replace(BELIEF, cells=(cell,))
    assert kept_on_heading(belief, ASSIGNMENT, 0.0).ident == "CB1"
    out = escape(belief, ASSIGNMENT, LIMIT)
    assert out.least_separation >= LIMIT
    assert out.heading > np.pi  # the shorter way round it is to the left


def judge(*seconds: tuple[float, float]) -> list[tuple[float, str, str, bool]]:
    """What is said of one other, second by second: how far off it is, and will be in 40 s."""
    standing: tuple[tuple[Nearing, StandingAlert], ...] = ()
    said: list[tuple[float, str, str, bool]] = []
    for t, (now, least) in enumerate(seconds):
        belief = replace(BELIEF, t=float(t), others=(CROSSING,))
        (near,) = nearings(straight_on(belief), belief, ASSIGNMENT)
        near = near._replace(
            now=now, least=least, at=t + 40.0, breaks=t + 35.0 if least < LIMIT else inf
        )
        outlook = Outlook(straight_on(belief), inf, belief.t, inf, (near,))
        standing, events = judge_others(standing, outlook, belief, ASSIGNMENT)
        for event in events:
            assert isinstance(event, Alerted)
            assert event.ident == "BAW12"
            said.append((float(t), event.level, event.message, event.cleared))
    return said


def test_an_alert_on_another_names_it_and_is_cleared() -> None:
    clear, soon, lost = (12_000.0, 11_000.0), (12_000.0, 9_000.0), (9_200.0, 9_000.0)
    assert judge(clear, soon, soon, lost, *[clear] * 5) == [
        (1.0, "caution", "BAW12 in 35 s: below 5.00 NM, down to 4.86 NM.", False),
        (3.0, "warning", "BAW12: 4.97 NM, less than 5.00 NM.", False),
        (6.0, "warning", "BAW12: the separation is kept again.", True),
    ]


def test_the_alert_on_one_that_need_not_be_watched_any_more_ends_and_says_so() -> None:
    amid = replace(BELIEF, others=(CROSSING,))
    (near,) = nearings(straight_on(amid), amid, ASSIGNMENT)
    outlook = Outlook(straight_on(BELIEF), inf, BELIEF.t, inf)
    standing, (ended,) = judge_others(
        ((near, StandingAlert("caution", BELIEF.t)),), outlook, BELIEF, ASSIGNMENT
    )
    assert standing == ()
    assert isinstance(ended, Alerted)
    assert (ended.ident, ended.level, ended.cleared) == ("BAW12", "caution", True)
    assert ended.message == "BAW12: the separation is kept again."

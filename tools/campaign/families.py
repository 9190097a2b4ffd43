"""The families of flights: where both begin, what the leader does, and what is not known of it.

A flight is drawn from the name of its family and its number alone. In all of them the pursuer
begins within 60 km and no closer than d_min, V_L/V_P is 0.6 … 0.98, d_min 3 … 5.5 NM, and
D is up to 3 NM more; the wind blows from anywhere with up to 50 m/s. The pursuer can fly its own
speed at its level, and the leader's.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import cos, pi, sin, sqrt
from zlib import crc32

import numpy as np

from relguide import Arc, Plan, plan
from relguide.flying.air import STANDARD_AIR
from relguide.flying.airframe import airframe
from relguide.flying.flight import IntentKnown, LeaderHeading, LeaderSpeed, Scenario
from relguide.flying.leaders.declared import TurnChoice
from relguide.flying.orders import Command
from relguide.kernels.base.angles import wrap
from relguide.planning.situation import (
    CALM,
    FlyStraight,
    IntentPiece,
    Leader,
    Pursuer,
    Situation,
    TurnTo,
    wind_from,
)
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.units import DEG, NM, Metre, MetrePerSecond, Second
from tools.campaign import recordings
from tools.campaign.case import Case

Draw = np.random.Generator
REACH: Metre = 60_000.0
"""The pursuer begins no farther away."""
ALTITUDE: Metre = 7_500.0
"""Of both, but behind a recorded leader [m]: FL246, where an A300 flies 124 … 244 m/s."""
LONGEST: Second = 7_200.0
"""A slow gain on a fast leader takes an hour and a half; then a flight has had its chance."""
FASTEST: MetrePerSecond = 244.0
LEAST_FOLLOWED: MetrePerSecond = 127.0
"""Leaders begin no slower; on command they do slow down below what a pursuer can fly [m/s]."""
STRONGEST_WIND = 50.0
"""[m/s]."""
NEAR_LIMIT: Metre = 0.5 * NM
"""A plan so close to d_min is near the limit …"""
FIRST_TURN: Second = 25.0
"""… if its first turn takes so long: time enough for a heading error to add up."""
CONSTANTS = (
    "max_roll_rate",
    "roll_time_constant",
    "speed_time_constant",
    "speed_brake_drag",
)
"""Of an aircraft, all unknown to guidance in the family `aircraft`. The bank limit is a setting of
the autopilot, and known."""
SPREAD = 0.3
"""How far they are off at most."""
ENERGY = ("thrust_share", "zero_lift_drag", "induced_drag")
"""Unknown as well, and …"""
ENERGY_SPREAD = 0.05
"""… so far off at most: speed is the difference of thrust and drag."""
POOR_BRAKES = 0.0
"""Factor: speed brakes that stay in. Every other aircraft has them."""
IN_HAND = 1.1
"""Behind a recorded leader the pursuer flies faster than its least speed by this factor."""
SLOWEST = 60.0
"""Slowest leader on command [m/s]: about to land."""


def draw(family: str, number: int) -> Case:
    """A flight.

    Raises:
        ValueError: if there is no such family, or its data is not installed.
    """
    if family not in FAMILIES:
        raise ValueError(f"There is no family {family!r}; there are {', '.join(FAMILIES)}.")
    rng = np.random.default_rng([crc32(family.encode()), number])
    return FAMILIES[family](rng, family, number)


def _draw_declared(rng: Draw, family: str, number: int) -> Case:
    """Intent known; straight and turning by turns."""
    intent = _turns(rng) if number % 2 else ()
    return _case(family, number, _situation(rng, intent))


def _draw_undeclared(rng: Draw, family: str, number: int) -> Case:
    """The leader turns once to three times without a word."""
    return _case(family, number, _situation(rng, _turns(rng)), intent_known=False)


def _draw_commands(rng: Draw, family: str, number: int) -> Case:
    """The leader is ordered about in flight: to turn, to turn back, to slow down, to go faster."""
    situation = _situation(rng, _turns(rng) if rng.random() < 0.5 else ())
    times = np.sort(rng.uniform(30.0, 1200.0, rng.integers(1, 5)))
    orders = tuple((float(round(t)), _command(rng, situation.leader)) for t in times)
    case = _case(family, number, situation, intent_known=bool(rng.random() < 0.5))
    return replace(case, orders=orders, scenario=replace(case.scenario, after_joining=300.0))


def _draw_near_limit(rng: Draw, family: str, number: int) -> Case:
    """A plan that passes d_min closely, with a long first turn; half in calm, half turning."""
    while True:
        # D well beyond d_min: it is not the slot that is near the limit
        situation = _situation(rng, _turns(rng) if number % 2 else (), extra=(1.0, 3.0))
        if number % 4 < 2:
            situation = replace(situation, wind=CALM)
        answer = plan(situation)
        if not isinstance(answer, Plan):
            continue
        first, found = answer.trajectory.segments[0], answer.certificate
        turns = isinstance(first, Arc) and first.length / situation.pursuer.tas >= FIRST_TURN
        if turns and found.least_separation <= situation.min_separation + NEAR_LIMIT:
            return _case(family, number, situation)


def _draw_aircraft(rng: Draw, family: str, number: int) -> Case:
    """An aircraft that guidance knows badly; intent known."""
    case = _case(family, number, _situation(rng, _turns(rng) if rng.random() < 0.5 else ()))
    factors = {name: float(rng.uniform(1.0 - SPREAD, 1.0 + SPREAD)) for name in CONSTANTS}
    factors |= {
        name: float(rng.uniform(1.0 - ENERGY_SPREAD, 1.0 + ENERGY_SPREAD)) for name in ENERGY
    }
    if number % 2:
        factors["speed_brake_drag"] = POOR_BRAKES
    return replace(case, factors=factors)


def _draw_follow(rng: Draw, family: str, number: int) -> Case:
    """On the route behind the leader, joined in a few minutes; then the leader does something."""
    situation = _situation(rng, ())
    leader, pursuer = situation.leader, situation.pursuer
    faster = pursuer.tas - leader.tas
    back = situation.slot_distance + 20.0 * faster + 1.5 * faster**2 + 500.0
    situation = replace(
        situation,
        pursuer=replace(
            pursuer,
            x=-back * sin(leader.heading),
            y=-back * cos(leader.heading),
            heading=leader.heading,
        ),
    )
    case = _case(family, number, situation)
    return replace(
        case,
        orders=_manoeuvre(rng, leader, float(rng.uniform(300.0, 500.0))),
        scenario=replace(case.scenario, after_joining=1500.0, duration_limit=2400.0),
    )


def _draw_full_turns(rng: Draw, family: str, number: int) -> Case:
    """A turn of 355° and more, as declared or as ordered."""
    turn = LEFT if rng.random() < 0.5 else RIGHT
    angle = float(rng.uniform(350.0, 359.5)) * DEG
    situation = _situation(rng, ())
    begins = float(round(rng.uniform(60.0, 900.0)))
    leader = situation.leader
    heading = wrap(leader.heading - turn * angle)
    if number % 2:
        order = LeaderHeading(heading=heading, direction="left" if turn == LEFT else "right")
        case = _case(family, number, situation, intent_known=bool(number % 4 == 1))
        return replace(case, orders=((begins, order),))
    bank = float(rng.uniform(15.0, 25.0)) * DEG
    intent = FlyStraight(duration=begins), TurnTo(heading=heading, turn=turn, bank=bank)
    declared = replace(situation, leader=replace(leader, intent=intent))
    return _case(family, number, declared)


def _draw_recorded(rng: Draw, family: str, number: int) -> Case:
    """Behind a recorded leader of the Paris area; over all of them, then over them again."""
    track = recordings.track(number)
    first = track.state_at(0.0)
    fastest = max(track.state_at(t).ground_speed for t in (0.0, 60.0, 180.0))
    least, most = airframe("A306").tas_range(first.altitude, STANDARD_AIR)
    tas = float(np.clip(fastest / rng.uniform(0.6, 0.98), IN_HAND * least, most - 1.0))
    drawn = _situation(rng, ())
    x, y = drawn.pursuer.x, drawn.pursuer.y
    situation = replace(
        drawn,
        pursuer=replace(drawn.pursuer, x=first.x + x, y=first.y + y, tas=tas),
        leader=Leader(x=first.x, y=first.y, heading=first.track, tas=first.ground_speed),
        wind=wind_from(float(rng.uniform(0.0, 2.0 * pi)), float(rng.uniform(0.0, 15.0))),
    )
    case = _case(family, number, situation, intent_known=False, altitude=first.altitude)
    return replace(
        case,
        scenario=replace(
            case.scenario,
            leader_source=track,
            leader_ident=track.ident,
            leader_type=track.aircraft_type or "unknown",
            after_joining=3600.0,
        ),
    )


FAMILIES: Mapping[str, Callable[[Draw, str, int], Case]] = {
    "declared": _draw_declared,
    "undeclared": _draw_undeclared,
    "commands": _draw_commands,
    "near_limit": _draw_near_limit,
    "aircraft": _draw_aircraft,
    "recorded": _draw_recorded,
    "follow": _draw_follow,
    "full_turns": _draw_full_turns,
}
"""By name; their docstrings say what they are."""


def _case(
    family: str,
    number: int,
    situation: Situation,
    *,
    intent_known: bool = True,
    altitude: Metre = ALTITUDE,
) -> Case:
    described = (FAMILIES[family].__doc__ or "").splitlines()[0]
    return Case(
        family=family,
        number=number,
        scenario=Scenario(
            name=family,
            title=f"{family} {number}",
            description=described,
            situation=situation,
            intent_known=intent_known,
            altitude=altitude,
            duration_limit=LONGEST,
        ),
    )


def _situation(
    rng: Draw, intent: tuple[IntentPiece, ...], *, extra: tuple[float, float] = (0.0, 3.0)
) -> Situation:
    """A start; D exceeds d_min by so many nautical miles."""
    tas = min(float(rng.uniform(180.0, 250.0)), FASTEST)
    min_separation = float(rng.uniform(3.0, 5.5)) * NM
    bearing = float(rng.uniform(0.0, 2.0 * pi))
    # evenly over the ring between d_min and the farthest start
    away = sqrt(float(rng.uniform(min_separation**2, REACH**2)))
    return Situation(
        pursuer=Pursuer(
            x=away * sin(bearing),
            y=away * cos(bearing),
            heading=float(rng.uniform(0.0, 2.0 * pi)),
            tas=tas,
            max_bank=25.0 * DEG,
        ),
        leader=Leader(
            x=0.0,
            y=0.0,
            heading=float(rng.uniform(0.0, 2.0 * pi)),
            tas=max(tas * float(rng.uniform(0.6, 0.98)), LEAST_FOLLOWED),
            intent=intent,
        ),
        slot_distance=min_separation + float(rng.uniform(*extra)) * NM,
        min_separation=min_separation,
        wind=wind_from(float(rng.uniform(0.0, 2.0 * pi)), float(rng.uniform(0.0, STRONGEST_WIND))),
    )


def _turns(rng: Draw) -> tuple[IntentPiece, ...]:
    """One to three turns, each after a straight."""
    pieces: list[IntentPiece] = []
    for _ in range(rng.integers(1, 4)):
        pieces.append(FlyStraight(duration=float(rng.uniform(0.0, 600.0))))
        pieces.append(
            TurnTo(
                heading=float(rng.uniform(0.0, 2.0 * pi)),
                turn=LEFT if rng.random() < 0.5 else RIGHT,
                bank=float(rng.uniform(15.0, 25.0)) * DEG,
            )
        )
    return tuple(pieces)


def _command(rng: Draw, leader: Leader) -> Command:
    drawn = rng.random()
    if drawn < 0.4:
        return LeaderHeading(heading=float(rng.uniform(0.0, 2.0 * pi)), direction=_direction(rng))
    if drawn < 0.5:
        return LeaderHeading(heading=wrap(leader.heading + pi), direction=_direction(rng))
    if drawn < 0.9:
        return LeaderSpeed(tas=max(leader.tas * float(rng.uniform(0.4, 1.15)), SLOWEST))
    return IntentKnown(known=bool(rng.random() < 0.5))


def _direction(rng: Draw) -> TurnChoice:
    choices: tuple[TurnChoice, ...] = ("left", "right", "shorter")
    return choices[rng.integers(3)]


def _manoeuvre(rng: Draw, leader: Leader, t: Second) -> tuple[tuple[Second, Command], ...]:
    """What a leader that is followed does from a time on: one of five."""
    t = float(round(t))
    match rng.integers(5):
        case 0:
            return ((t, _speed(leader, rng.uniform(0.5, 0.95))),)
        case 1:
            back = wrap(leader.heading + float(rng.uniform(150.0, 210.0)) * DEG)
            return ((t, LeaderHeading(heading=back, direction=_direction(rng))),)
        case 2:  # as to land
            onto = wrap(leader.heading + float(rng.uniform(-90.0, 90.0)) * DEG)
            return (
                (t, _speed(leader, 0.75)),
                (t + 90.0, LeaderHeading(heading=onto)),
                (t + 180.0, _speed(leader, 0.55)),
                (t + 330.0, _speed(leader, 0.4)),
            )
        case 3:  # slow, and on again
            return (
                (t, _speed(leader, rng.uniform(0.7, 0.9))),
                (t + float(round(rng.uniform(60.0, 300.0))), _speed(leader, 1.0)),
            )
        case _:  # a turn across the wind
            aside = wrap(leader.heading + float(rng.choice([-90.0, 90.0])) * DEG)
            return ((t, LeaderHeading(heading=aside)),)


def _speed(leader: Leader, share: float) -> LeaderSpeed:
    return LeaderSpeed(tas=max(leader.tas * float(share), SLOWEST))

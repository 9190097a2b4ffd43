"""The families of flights: where both begin, what the leader does, and what is not known of it.

A flight is drawn from the name of its family and its number alone. In all of them the pursuer
begins within 60 km and no closer than d_min, V_L/V_P is 0.6 … 0.98, d_min 3 … 5.5 NM, and
D is up to 3 NM more; the wind blows from anywhere with up to 50 m/s. The pursuer can fly its own
speed at its level, and the leader's.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import cos, pi, sin
from zlib import crc32

import numpy as np

from relguide.campaign import recordings
from relguide.campaign.case import Case
from relguide.campaign.leader_orders import draw_command, draw_manoeuvre
from relguide.campaign.starts import Draw, draw_situation, draw_turns
from relguide.flying.air import STANDARD_AIR
from relguide.flying.airframe_files import airframe
from relguide.flying.flight import LeaderHeading, Scenario
from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT, Arc
from relguide.planning.wind import CALM, wind_from
from relguide.units import DEG, NM, Metre, Second

ALTITUDE: Metre = 7_500.0
"""Of both, but behind a recorded leader [m]: FL246, where an A300 flies 124 … 244 m/s."""
LONGEST: Second = 7_200.0
"""A slow gain on a fast leader takes an hour and a half; then a flight has had its chance."""
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


def draw(family: str, number: int, seed: int = 0) -> Case:
    """A flight of one of `FAMILIES`.

    Args:
        family: its name.
        number: of the flight.
        seed: of all flights; 0 draws those of docs/flight.md.

    Raises:
        ValueError: if there is no such family, or its data is not installed.
    """
    if family not in FAMILIES:
        raise ValueError(f"There is no family {family!r}; there are {', '.join(FAMILIES)}.")
    return FAMILIES[family](stream(family, number, seed), family, number)


def stream(family: str, number: int, seed: int, key: str = "") -> Draw:
    """The random numbers of a flight, or of one quantity that is varied of it: its own each."""
    words = [seed, *_words(family), number, *_words(key)]
    return np.random.default_rng(words if seed or key else words[1:])


def _words(name: str) -> list[int]:
    return [crc32(name.encode())] if name else []


def _draw_declared(rng: Draw, family: str, number: int) -> Case:
    """Intent known; straight and turning by turns."""
    intent = draw_turns(rng) if number % 2 else ()
    return _case(family, number, draw_situation(rng, intent))


def _draw_undeclared(rng: Draw, family: str, number: int) -> Case:
    """The leader turns once to three times without a word."""
    return _case(family, number, draw_situation(rng, draw_turns(rng)), intent_known=False)


def _draw_commands(rng: Draw, family: str, number: int) -> Case:
    """The leader is ordered about in flight: to turn, to turn back, to slow down, to go faster."""
    situation = draw_situation(rng, draw_turns(rng) if rng.random() < 0.5 else ())
    times = np.sort(rng.uniform(30.0, 1200.0, rng.integers(1, 5)))
    orders = tuple((float(round(t)), draw_command(rng, situation.leader)) for t in times)
    case = _case(family, number, situation, intent_known=bool(rng.random() < 0.5))
    return replace(case, orders=orders, scenario=replace(case.scenario, after_joining=300.0))


def _draw_near_limit(rng: Draw, family: str, number: int) -> Case:
    """A plan that passes d_min closely, with a long first turn; half in calm, half turning."""
    while True:
        # D well beyond d_min: it is not the slot that is near the limit
        situation = draw_situation(rng, draw_turns(rng) if number % 2 else (), extra=(1.0, 3.0))
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
    case = _case(family, number, draw_situation(rng, draw_turns(rng) if rng.random() < 0.5 else ()))
    factors = {name: float(rng.uniform(1.0 - SPREAD, 1.0 + SPREAD)) for name in CONSTANTS}
    factors |= {
        name: float(rng.uniform(1.0 - ENERGY_SPREAD, 1.0 + ENERGY_SPREAD)) for name in ENERGY
    }
    if number % 2:
        factors["speed_brake_drag"] = POOR_BRAKES
    return replace(case, factors=factors)


def _draw_follow(rng: Draw, family: str, number: int) -> Case:
    """On the route behind the leader, joined in a few minutes; then the leader does something."""
    situation = draw_situation(rng, ())
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
        orders=draw_manoeuvre(rng, leader, float(rng.uniform(300.0, 500.0))),
        scenario=replace(case.scenario, after_joining=1500.0, duration_limit=2400.0),
    )


def _draw_full_turns(rng: Draw, family: str, number: int) -> Case:
    """A turn of 355° and more, as declared or as ordered."""
    turn = LEFT if rng.random() < 0.5 else RIGHT
    angle = float(rng.uniform(350.0, 359.5)) * DEG
    situation = draw_situation(rng, ())
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
    drawn = draw_situation(rng, ())
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
        noise_seed=number,
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

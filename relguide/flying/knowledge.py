"""What one aircraft knows of another: what that declared, whether it flies it, and how it flies.

The leader as it declared to fly is a fleet of its own, flown on beside the true one.
"""

from dataclasses import replace
from math import hypot
from typing import NamedTuple

import numpy as np

from relguide.flying.belief import Belief, FlownTrack
from relguide.flying.fleet import Fleet
from relguide.flying.leaders.declared import Program, remaining, straight_heading
from relguide.flying.perception import CERTAIN, Perceived, Perception
from relguide.flying.world import Declared, World
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight.flight_records import Body, Drift, limits_at
from relguide.kernels.flight.program import STRAIGHT, fly_program
from relguide.kernels.flight.second import PROGRAMMED
from relguide.planning.intent import IntentPiece
from relguide.planning.wind import Wind
from relguide.units import DEG, NM, Metre, Radian, Second

OFF_INTENT: Metre = 0.5 * NM
"""So far from where it declared that it would be, a leader does not fly its intent [m]."""
OFF_HEADING: Radian = 10.0 * DEG
"""… nor so far off the heading that it declared [rad]."""
NEAR_HEADING: Radian = 5.0 * DEG
"""So near the heading that it declared, a leader is on it but for what is not known of the wind
[rad]."""
NO_PROGRAM = np.zeros((0, 3))
ROLLS_BEFORE: Second = 8.0
"""An aircraft begins to roll so long before a declared turn at the earliest [s]."""
DECLARED_STEPS = 4
"""Of a second, in which a leader is flown on as it declared."""


class Flown(NamedTuple):
    """What an aircraft declared, and how far it has come."""

    program: Program
    cursor: int
    """The piece being flown; beyond the last on the final leg."""

    def is_straight(self, t: Second) -> bool:
        """Whether it flies straight, and does not roll into a turn yet."""
        rows, k = self.program.rows, self.cursor
        if k == len(rows):
            return True
        return bool(rows[k, 0] == STRAIGHT and rows[k, 1] - t > ROLLS_BEFORE)


def as_declared(fleet: Fleet, j: int, intent: tuple[IntentPiece, ...]) -> Fleet:
    """Aircraft j alone, as it declared that it would fly."""
    alone = replace(fleet.world.aircraft[j], pilot=Declared(intent=intent))
    calm = replace(fleet.world.air, gusts=0.0)
    return Fleet(World(aircraft=(alone,), links=(), air=calm), fleet.step)


def declared_by(fleet: Fleet, j: int, declared: Fleet | None) -> Flown | None:
    """What aircraft j declared and how far it has come; `None` where it declared nothing."""
    source, k = (fleet, j) if declared is None else (declared, 0)
    if source.pilots[k] != PROGRAMMED:
        return None
    return Flown(source.declared[k], int(source.cursors[k]))


def fly_declared(
    fleet: Fleet, j: int, declared: Flown, body: Body, wind: Drift, t: Second
) -> tuple[Body, int]:
    """Aircraft j a second on from flight time t, as it declared, and the piece it then flies.

    Args:
        fleet: all that fly.
        j: which.
        declared: its program, and the piece it flies at t.
        body: it, at t.
        wind: as it is believed.
        t: flight time [s].
    """
    dt, program, cursor = 1.0 / DECLARED_STEPS, declared.program, declared.cursor
    for k in range(DECLARED_STEPS):
        body, cursor = fly_program(
            program.rows, cursor, program.held, body, fleet.believed_limits[j], wind,
            t + k * dt, dt, body.tas,
        )  # fmt: skip
    return Body(*body), cursor


def breaks_its_word(fleet: Fleet, j: int, declared: Fleet) -> bool:
    """Whether aircraft j is far from where it declared that it would be."""
    here, there = fleet.states[j], declared.states[0]
    if hypot(here[0] - there[0], here[1] - there[1]) > OFF_INTENT:
        return True
    return abs(wrap_signed(float(here[2] - there[2]))) > OFF_HEADING


def perceive(fleet: Fleet, perception: Perception, i: int, j: int, t: Second) -> Perceived:
    """What aircraft i perceives of aircraft j and of the air now."""
    measured = fleet.blew(i) if t > 0.0 else None
    return perception.see(t, fleet.body(j), fleet.drift(j), measured)


def belief_of(
    fleet: Fleet,
    i: int,
    j: int,
    track: FlownTrack,
    t: Second,
    known: bool,
    declared: Fleet | None = None,
    seen: Perceived | None = None,
) -> Belief:
    """What aircraft i knows of itself and of aircraft j.

    Args:
        fleet: all that fly.
        i: the pursuer.
        j: its leader.
        track: the leader's flown path.
        t: flight time [s].
        known: whether the leader's intent is.
        declared: the leader alone, as it declared to fly; `None` if it flies what it declared.
        seen: what i perceives of j and the air; `None` if it sees the truth.
    """
    leader = fleet.body(j) if seen is None else seen.leader
    source, k = (fleet, j) if declared is None else (declared, 0)
    program, cursor = source.declared[k], int(source.cursors[k])
    known = known and bool(source.pilots[k] == PROGRAMMED)
    can = limits_at(fleet.limits, j)
    intent = remaining(program, cursor, leader, can, t) if known else ()
    rows, held = program.rows, program.held
    holds = straight_heading(program, cursor)
    if known and seen is not None:
        # on a straight it holds what is seen of its heading: the wind there is not known better
        straight = cursor == len(rows) or rows[cursor, 0] == STRAIGHT
        if straight and abs(leader.heading - holds) < NEAR_HEADING:
            holds = leader.heading
        rows, cursor, held = rows[cursor:], 0, holds
    own = fleet.body(i)
    wind = fleet.wind(i) if seen is None else Wind(east=seen.wind.east, north=seen.wind.north)
    return Belief(
        t=t,
        own=own,
        limits=fleet.believed(i),
        leader=leader,
        leader_limits=fleet.believed_limits[j],
        intent=intent,
        intent_known=known,
        program=rows if known else NO_PROGRAM,
        cursor=cursor if known else 0,
        held=held if known else leader.heading,
        holds=holds if known else leader.heading,
        leader_tas=leader.tas,
        track=track,
        wind=wind,
        leader_age=0.0 if seen is None else seen.age,
        spread=CERTAIN if seen is None else seen.spread,
    )

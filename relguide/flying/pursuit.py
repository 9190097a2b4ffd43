"""One pursuer and its leader in flight: what a closed loop keeps of them from second to second."""

from dataclasses import dataclass, replace
from math import hypot
from typing import NamedTuple

import numpy as np

from relguide.flying.abilities import dependable_deceleration, limits_of
from relguide.flying.aircraft_documents import ClosestOther, FlownByHand, Loss
from relguide.flying.belief import SEEMS, SPARE, Belief, FlownTrack, coasting
from relguide.flying.engagement import Engagement
from relguide.flying.fleet import Fleet
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.forecast import Forecast
from relguide.flying.guidance.memory import LONG_AGO, Advice, Memory, begin
from relguide.flying.knowledge import (
    Flown,
    as_declared,
    belief_of,
    declared_by,
    fly_declared,
    perceive,
)
from relguide.flying.logbook import PairNames
from relguide.flying.orders import NewTask
from relguide.flying.perception import Perceived, Perception
from relguide.flying.queues import behind_head
from relguide.flying.seen_others import SeenOther
from relguide.flying.slots import line_of
from relguide.flying.world import Link, World
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight.flight_records import Body, Drift, move_to
from relguide.planning.heights import Heights
from relguide.planning.levels import levels_with
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

AS_DECLARED: Metre = 150.0
"""Reports of a leader in a turn may lag so far behind what it declared [m]."""
PLACED_BY_REPORTS = 0.1
"""Share of what its reported place is off that is made good each second: its speed is not known
exactly, and a turn takes a minute."""
TURNED_AS_DECLARED: Radian = 15.0 * DEG
"""… and so far behind its heading [rad]."""
SPEED_IN_HAND = 0.98
"""Share of the fastest that can be flown at a level, which plans are flown at there."""
LEAST_DECELERATION = 0.1
"""What is counted on in a descent, with brakes [m/s²]."""
MARGIN_STEP: Metre = 25.0
"""A margin that changes by less stays [m]."""


class LeaderView(NamedTuple):
    """What was last said of a leader."""

    shown: Belief
    """From which its route was drawn."""
    turning: bool = False
    """Whether it turns, and that was announced."""
    rerouted: bool = False
    """Whether a command changed its flight since its route was drawn."""
    turn_ordered: bool = False
    """Whether it was announced that it will turn, and it has not begun to."""
    changed: str = ""
    """What it last did unannounced, for the cause of a loss; empty if nothing."""
    changed_at: Second = LONG_AGO
    """When, flight time [s]."""


class FlightMetrics(NamedTuple):
    """Figures of a flight so far: what guidance has reached, and how it was flown."""

    least_separation: Metre
    heading_swing: Radian = 0.0
    """Total variation of the pursuer's heading until joined."""
    track: Metre = 0.0
    """Flown over the ground until joined."""
    bank_reversals: int = 0
    """From one side to the other, until joined."""
    engaged_at: Second = 0.0
    """When guidance was last engaged [s]."""
    planned_time: Second = 0.0
    """Time to converge of the plan at engagement; 0 if there was none [s]."""
    promised: Second = 0.0
    """Time until joined that it promised; 0 if there was none [s]."""
    replans: int = 0
    replans_announced: int = 0
    joined: bool = False
    join_time: Second = 0.0
    """When it first joined, if it has [s]."""
    following_since: Second = 0.0
    """When it last began to follow, if it has [s]."""
    alerted: tuple[Second, ...] = ()
    """When the alert that stands was given first; empty if none stands."""
    others_alerted: tuple[tuple[str, Second], ...] = ()
    """The same of each of the others, by ident."""
    unable: tuple[Second, ...] = ()
    """When `Unable` was said first since the last plan; empty if it was not."""
    unheard: tuple[Second, ...] = ()
    """When it was said that nothing is heard of the leader; empty while it is heard."""
    losses: tuple[Loss, ...] = ()
    along_error: Metre = 0.0
    """Largest along the route while it followed."""
    across_error: Metre = 0.0
    """Largest beside it."""
    by_hand: FlownByHand | None = None
    """`None` while the autopilot has flown all the time."""
    least_other: ClosestOther | None = None
    """Of all others the one that it came nearest to, measured by what is to be kept."""


@dataclass(slots=True)
class Pursuit:
    """One pursuer and its leader in flight."""

    link: Link
    names: PairNames
    flown: Link
    """What guidance flies: the link itself, or in a queue one behind its head."""
    pursuer: int
    """Which of the fleet."""
    leader: int
    """Which of the fleet guidance goes by: the leader, or in a queue its head."""
    ahead: int
    """Which of the fleet is the link's leader."""
    behind: frozenset[str]
    """Idents of all that follow this pursuer, or one that does."""
    assignment: Assignment
    track: FlownTrack
    perception: Perception | None
    """`None` where the pursuer sees the truth."""
    seen: Perceived | None
    """What it last perceived; `None` as above."""
    known: bool
    """Whether the leader's intent is."""
    declared: Fleet | None
    """The leader as it declared to fly; `None` if it flies what it declared, or is found not to."""
    view: LeaderView
    memory: Memory
    metrics: FlightMetrics
    idle_deceleration: float
    """What the data of the pursuer's type give [m/s²]."""
    advice: Advice | None = None
    shown_forecast: Forecast | None = None
    fits: tuple[Metre, float] = (0.0, 0.0)
    """For which level [m], and in which descent [m/s²], the assignment is."""
    autopilot: bool = True
    """Whether the autopilot flies; if not, the crew does by hand."""
    director: bool = False
    """Whether the flight director is on."""
    asked: tuple[NewTask, ...] = ()
    """What the crew asked of its guidance just now, in order."""
    lost: bool = False
    """Whether the separation is below d_min."""
    seen_others: tuple[SeenOther, ...] = ()
    """All other aircraft, as it last saw them."""
    shown_ahead: tuple[Second, SeenOther] | None = None
    """In a queue, the leader of the link as its route was last drawn, and when, flight time [s]."""
    lost_others: frozenset[str] = frozenset()
    """The idents of others that it is too close to."""
    braked: tuple[MetrePerSecond, ...] = ()
    """The airspeeds of the last seconds, all of them with braking asked for in earnest [m/s]."""
    reckoned: tuple[Body, Flown] | None = None
    """The leader by what it declared, since it last flew straight, and how far it has come; `None`
    where that is no guide."""
    seen_at: Second = 0.0
    """When that was, flight time [s]."""
    doubted: int = 0
    """For how many seconds the leader has not flown what it declared."""
    fan_due: Second = 0.0
    """When the fan that is open is to be made anew, flight time; 0 while none is open [s]."""
    heard: Belief | None = None
    """What was last heard of the leader; `None` while its reports are received."""

    @property
    def queued(self) -> bool:
        """Whether guidance goes by another aircraft than the link's leader."""
        return self.leader != self.ahead

    @property
    def watched(self) -> PairNames:
        """The pursuer, and the aircraft that its guidance goes by."""
        return PairNames(self.flown.pursuer, self.flown.leader)

    def belief(self, fleet: Fleet, t: Second) -> Belief:
        """What the pursuer knows now."""
        if self.heard is not None:
            return coasting(self.heard, t, fleet.body(self.pursuer))
        return self._with_heights(self._seen(fleet, t), fleet, t)

    def _with_heights(self, seen: Belief, fleet: Fleet, t: Second) -> Belief:
        """The same with both altitudes, and with the changes of level that both will make."""
        declared = declared_by(fleet, self.leader, self.declared) if seen.intent_known else None
        leader = fleet.heights(self.leader, t, None if declared is None else declared.program)
        own = fleet.heights(self.pursuer, t)
        if leader == own:
            return replace(seen, own_heights=own, leader_heights=leader)
        if declared is None:
            leader = Heights(altitude=leader.altitude)
        if self.memory.engagement == "engaged":
            own = Heights(altitude=own.altitude, changes=levels_with(leader, own.altitude))
        climb = fleet.verticals[self.leader].speed
        return replace(seen, own_heights=own, leader_heights=leader, leader_climb=climb)

    def _seen(self, fleet: Fleet, t: Second) -> Belief:
        seen = self.seen
        if self.perception is not None and (seen is None or t > self.seen_at):
            seen = self._see(fleet, self.perception, t)
            self.seen, self.seen_at = seen, t
        return belief_of(
            fleet, self.pursuer, self.leader, self.track, t, self.known, self.declared, seen
        )

    def _see(self, fleet: Fleet, perception: Perception, t: Second) -> Perceived:
        """What is perceived now; in a declared turn the leader as it declared.

        Reports of a turn lag behind it, and a heading that is two seconds old puts the leg behind
        the turn aside by half a kilometre. From the straight before it the turn is known as well
        as that straight is.
        """
        seen = perceive(fleet, perception, self.pursuer, self.leader, t)
        declared = declared_by(fleet, self.leader, self.declared) if self.known else None
        if declared is None or (seen.leader.bank == 0.0 and declared.is_straight(t)):
            self.reckoned = None if declared is None else (seen.leader, declared)
            return seen
        if self.reckoned is None:
            return seen
        before, flown = self.reckoned
        if flown.program is not declared.program:  # it was ordered to something else just now
            flown = declared
        body, cursor = fly_declared(fleet, self.leader, flown, before, seen.wind, t - 1.0)
        off = hypot(body.x - seen.leader.x, body.y - seen.leader.y)
        turned = abs(wrap_signed(body.heading - seen.leader.heading))
        if off > AS_DECLARED + SEEMS * seen.spread.place or turned > TURNED_AS_DECLARED:
            self.reckoned = None
            return seen
        x = body.x + PLACED_BY_REPORTS * (seen.leader.x - body.x)
        y = body.y + PLACED_BY_REPORTS * (seen.leader.y - body.y)
        self.reckoned = move_to(body, x, y), flown._replace(cursor=cursor)
        return seen._replace(leader=self.reckoned[0])


def keep_margin(one: Pursuit, belief: Belief) -> None:
    """Keep as much beside d_min as what is believed now, and the crew's hand, are uncertain."""
    margin = belief.spread.margin
    if not one.autopilot:
        margin += one.assignment.settings.by_hand_margin
    if abs(margin - one.assignment.margin) > MARGIN_STEP:
        one.assignment = replace(one.assignment, margin=margin)


def as_it_is_flown(one: Pursuit, belief: Belief) -> Belief:
    """What is believed, with the crew's part: the speed that it selected, and whether it flies."""
    limits = one.assignment.can(belief.limits)
    if one.autopilot and limits is belief.limits:
        return belief
    return replace(belief, limits=limits, by_hand=not one.autopilot)


def fit_to_level(one: Pursuit, fleet: Fleet) -> None:
    """Ask for what can be flown at the present level: not so fast, or slower than before."""
    limits = fleet.believed(one.pursuer)
    fits = fleet.limits_for[one.pursuer], min(round(fleet.paid[one.pursuer], 1), 0.0)
    if fits == one.fits:
        return
    asked, tas = one.assignment, fleet.world.aircraft[one.pursuer].tas
    tas = max(min(tas, SPEED_IN_HAND * limits.max_tas), limits.min_tas)
    idle = max(dependable_deceleration(limits, tas), LEAST_DECELERATION)
    one.fits = fits
    one.idle_deceleration = idle
    one.assignment = replace(asked, tas=tas, min_tas=limits.min_tas, idle_deceleration=idle)


def begin_pursuit(
    world: World, fleet: Fleet, link: Link, engagement: Engagement = "engaged", seed: int = 0
) -> Pursuit:
    """A link at the start of a flight.

    Args:
        world: as it begins.
        fleet: its aircraft.
        link: one of its links.
        engagement: how far guidance is engaged.
        seed: of what is not perceived exactly.
    """
    flown = behind_head(link, world.links, world.settings.separation_buffer)
    i, j = world.index(flown.pursuer), world.index(flown.leader)
    perception, seen = None, None
    leader, drift = fleet.body(j), fleet.drift(j)
    if world.perceives:
        own, air = world.aircraft[i], world.believed_air or world.air
        wind = air.wind_at(own.x, own.y, own.altitude, 0.0)
        rng = np.random.default_rng([seed, i, j])
        believed = Drift(wind.east, wind.north)
        perception = Perception(world.surveillance, believed, world.air.gusts, rng)
        perception.listen(leader, drift, fleet.drift(i))
        seen = perceive(fleet, perception, i, j, 0.0)
        leader, drift = seen.leader, seen.wind
    track = FlownTrack(leader, drift, 0.0, flown.slot_distance + SPARE)
    intent = flown.declared_intent
    declared = None if intent is None else as_declared(fleet, j, intent)
    belief = belief_of(fleet, i, j, track, 0.0, flown.intent_known, declared, seen)
    assignment = assignment_of(world, flown)
    by_hand = fleet.is_by_hand(i)
    return Pursuit(
        link=link,
        names=PairNames(link.pursuer, link.leader),
        flown=flown,
        pursuer=i,
        leader=j,
        ahead=world.index(link.leader),
        behind=frozenset(
            other.pursuer
            for other in world.links
            if other is not link and link in line_of(other, world.links)
        ),
        assignment=assignment,
        track=track,
        perception=perception,
        seen=seen,
        known=belief.intent_known,
        declared=declared,
        view=LeaderView(belief),
        memory=begin(belief, engagement),
        metrics=FlightMetrics(fleet.apart(i, world.index(link.leader))),
        idle_deceleration=assignment.idle_deceleration,
        fits=(world.aircraft[i].altitude, 0.0),
        autopilot=not by_hand,
        director=by_hand,
    )


def assignment_of(world: World, link: Link) -> Assignment:
    """What a link asks of its pursuer."""
    pursuer = world.aircraft[world.index(link.pursuer)]
    can, air = pursuer.known_airframe, world.believed_air or world.air
    limits = limits_of(pursuer, can, air)
    return Assignment(
        aircraft_type=can.designator,
        tas=pursuer.tas,
        asked_bank=pursuer.max_bank,
        max_bank=pursuer.autopilot_bank,
        idle_deceleration=dependable_deceleration(limits, pursuer.tas),
        min_tas=limits.min_tas,
        slot_distance=link.slot_distance,
        min_separation=link.min_separation,
        spacing=link.spacing,
        settings=world.settings,
    )

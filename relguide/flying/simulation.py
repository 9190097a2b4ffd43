"""simulate(world, …): the one closed loop of the library, for any number of aircraft.

    world → what each pursuer believes → guidance (once a second) → a second flown → documents

Everything else that flies a plan, live or not, iterates over these documents.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from itertools import count
from typing import NamedTuple

import numpy as np

from relguide.flying.aircraft_documents import AircraftCard, LinkCard
from relguide.flying.belief import Belief, FlownTrack
from relguide.flying.cards import wind_card
from relguide.flying.documents import (
    Document,
    FlightEnded,
    FlightStarted,
    LeaderChanged,
    LeaderRoute,
    SeparationLost,
    Unable,
)
from relguide.flying.guidance.advise import advise
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.forecast import Forecast
from relguide.flying.guidance.memory import Advice, Memory, begin
from relguide.flying.logbook import (
    Milestones,
    Names,
    Tally,
    count_event,
    count_loss,
    event_document,
    forecast_document,
    leader_route,
    link_result,
    sample,
)
from relguide.flying.orders import Command, LeaderHeading, LeaderSpeed, no_commands, obey
from relguide.flying.world import Fleet, Link, World
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight.second import REVERSALS, SWING, TRACK
from relguide.planning.plan import Planner, plan
from relguide.units import DEG, KT, Metre, MetrePerSecond, Radian, RadianPerSecond, Second

ROUTE_TURNED: Radian = 1.0 * DEG
"""A route drawn a degree off ends 2 % of its length aside [rad]."""
ROUTE_SPEED: MetrePerSecond = 2.0 * KT
"""What the display rounds to [m/s]."""
TURN_SEEN: RadianPerSecond = 0.3 * DEG
"""A quarter of an airliner's: a turn, not a correction [rad/s]."""
TURN_OVER: RadianPerSecond = 0.1 * DEG
"""A turn that slow is over [rad/s]."""
DOUBTED_FOR = 5
"""So many seconds off its intent, a leader is no longer relied on."""
RECENT: Second = 120.0
"""A loss so soon after something new of the leader is put down to it [s]."""


class LeaderView(NamedTuple):
    """What was last said of a leader."""

    shown: Belief
    """From which its route was drawn."""
    turning: bool
    """Whether it turns, and that was announced."""
    commanded: bool
    """Whether a command changed its flight since its route was drawn."""
    changed: str
    """What it last did unannounced, for the cause of a loss; empty if nothing."""
    changed_at: Second
    """When, flight time [s]."""


@dataclass(slots=True)
class LinkState:
    """One pursuer and its leader in flight."""

    link: Link
    names: Names
    pursuer: int
    leader: int
    assignment: Assignment
    track: FlownTrack
    known: bool
    view: LeaderView
    memory: Memory
    tally: Tally
    advice: Advice | None = None
    milestones: Milestones = field(default_factory=Milestones)
    shown_forecast: Forecast | None = None
    lost: bool = False
    told: Fleet | None = None
    """The leader as it declared to fly; `None` if it flies what it declared, or is found not to."""
    doubted: int = 0
    """For how many seconds the leader has not flown what it declared."""


def simulate(
    world: World,
    planner: Planner = plan,
    *,
    scenario: str = "own",
    title: str = "A world of one's own",
    planner_name: str = "exact",
    commands: Callable[[Second], Iterable[Command]] = no_commands,
    step: Second = 0.05,
    sample_period: Second = 0.05,
    seed: int = 0,
    until: Second = 3600.0,
    after_joining: Second = 120.0,
) -> Iterator[Document]:
    """Fly a world and say what happens, in order of time.

    Args:
        world: who flies, in what air, and who is to join whom.
        planner: makes the plans of all pursuers; they are judged before they are flown.
        scenario: the flight's name.
        title: the same for people.
        planner_name: who makes the plans, as their cards say.
        commands: polled once a second with the flight time; they are for the first link's leader.
        step: integration step [s]; a whole number of steps makes a second.
        sample_period: between samples [s]; a whole number of steps.
        seed: from which the world was drawn; written into the first document.
        until: the flight ends here at the latest [s].
        after_joining: how long it goes on once all pursuers have joined [s].

    Yields:
        `FlightStarted` first, `FlightEnded` last. What the planner raises is passed on as it is.
    """
    a_sample = whole_steps(sample_period, step)
    whole_steps(1.0, step)
    fleet = Fleet(world, step)
    yield _started(world, planner_name, scenario, title, step, seed)
    states = [_begin(world, fleet, link) for link in world.links]
    for one in states:
        yield _route(one, one.view.shown)
    for second in count():
        t = float(second)
        for command in commands(t):
            yield from _obey(command, fleet, states, t)
        for one in states:
            yield from _guide(one, fleet, planner, t)
        edge = fleet.beyond_edge()
        if edge:
            message = f"{edge} leaves the plane of this flight, and with it what can be planned."
            yield Unable(t=t, ident=states[0].names.pursuer, reason="geometry", message=message)
        ends = bool(edge) or _is_over(states, t, min(until, fleet.recorded_until()), after_joining)
        if ends:
            yield _sample(states, fleet, t, 0.0, None)
            break
        fleet.fly_second(t)
        documents: list[Document] = []
        for one in states:
            documents += _count(one, fleet, t)
        for k in range(-second * fleet.steps % a_sample, fleet.steps, a_sample):
            documents.append(_sample(states, fleet, t, k * step, k))
        yield from sorted(documents, key=lambda document: document.t)
    results = tuple(
        link_result(t, one.names, one.milestones, one.tally, one.memory.fallbacks) for one in states
    )
    yield FlightEnded(t=t, results=results)


def whole_steps(duration: Second, step: Second) -> int:
    """How many steps a duration has.

    Raises:
        ValueError: if it is not a whole number of them.
    """
    steps = round(duration / step) if step > 0.0 else 0
    if steps < 1 or abs(steps * step - duration) > 1e-9:
        raise ValueError(f"{duration:g} s must be a whole number of steps of {step:g} s.")
    return steps


def assignment_of(world: World, link: Link) -> Assignment:
    """What a link asks of its pursuer."""
    pursuer = world.aircraft[world.index(link.pursuer)]
    can = pursuer.known_airframe
    least, most = can.tas_range(pursuer.altitude, world.believed_air or world.air)
    return Assignment(
        ident=link.pursuer,
        leader_ident=link.leader,
        aircraft_type=can.designator,
        tas=pursuer.tas,
        max_bank=pursuer.max_bank,
        idle_deceleration=can.idle_deceleration,
        min_tas=least,
        max_tas=most,
        slot_distance=link.slot_distance,
        min_separation=link.min_separation,
        spacing=link.spacing,
        settings=world.settings,
    )


def _started(
    world: World, planner: str, scenario: str, title: str, step: Second, seed: int
) -> FlightStarted:
    return FlightStarted(
        t=0.0,
        scenario=scenario,
        title=title,
        planner=planner,
        aircraft=tuple(
            AircraftCard(
                ident=aircraft.ident,
                aircraft_type=aircraft.aircraft_type,
                max_bank=aircraft.max_bank,
            )
            for aircraft in world.aircraft
        ),
        links=tuple(
            LinkCard(
                pursuer=link.pursuer,
                leader=link.leader,
                slot_distance=link.slot_distance,
                min_separation=link.min_separation,
                spacing="time" if link.spacing > 0.0 else "distance",
            )
            for link in world.links
        ),
        wind=wind_card(world.air.wind),
        step=step,
        seed=seed,
    )


def _begin(world: World, fleet: Fleet, link: Link) -> LinkState:
    i, j = world.index(link.pursuer), world.index(link.leader)
    track = fleet.begin_track(link)
    told = None if link.told is None else fleet.as_told(j, link.told)
    belief = fleet.belief(i, j, track, 0.0, link.intent_known, told)
    return LinkState(
        told=told,
        link=link,
        names=Names(link.pursuer, link.leader),
        pursuer=i,
        leader=j,
        assignment=assignment_of(world, link),
        track=track,
        known=belief.intent_known,
        view=LeaderView(belief, turning=False, commanded=False, changed="", changed_at=-RECENT),
        memory=begin(belief),
        tally=Tally(fleet.apart(i, j)),
    )


def _obey(
    command: Command, fleet: Fleet, states: list[LinkState], t: Second
) -> Iterator[LeaderChanged]:
    first = states[0]
    known, said = obey(command, fleet, first.leader, first.known, t)
    for one in states:
        if one.leader == first.leader:
            one.known = known
            if isinstance(command, LeaderHeading):
                one.told = None  # what it is ordered to do is what it declares from now on
            if isinstance(command, LeaderHeading | LeaderSpeed):
                changed = "The leader was ordered to turn."
                if isinstance(command, LeaderSpeed):
                    changed = "The leader was ordered to another speed."
                one.view = one.view._replace(commanded=True, changed=changed, changed_at=t)
    yield from said


def _guide(one: LinkState, fleet: Fleet, planner: Planner, t: Second) -> Iterator[Document]:
    """One act of guidance, and what is new of the leader."""
    one.track.add(fleet.body(one.leader), fleet.drift, t)
    yield from _doubt(one, fleet, t)
    belief = fleet.belief(one.pursuer, one.leader, one.track, t, one.known, one.told)
    one.view, news = _look_at_leader(one, belief)
    yield from news
    one.memory, advice = advise(one.memory, belief, one.assignment, planner)
    for event in advice.events:
        document = event_document(t, one.names, event)
        one.milestones = count_event(one.milestones, document)
        yield document
    if advice.forecast is not one.shown_forecast:
        one.shown_forecast = advice.forecast
        yield forecast_document(t, one.names.pursuer, advice.forecast)
    if advice.joined and not one.milestones.joined:
        one.milestones = one.milestones._replace(joined=True, join_time=t)
    one.advice = advice
    fleet.control(one.pursuer, advice.control)


def _doubt(one: LinkState, fleet: Fleet, t: Second) -> Iterator[LeaderChanged]:
    """Find out a leader that does not fly what it declared; from then on its intent is unknown."""
    if one.told is None or not one.known:
        return
    one.doubted = one.doubted + 1 if fleet.breaks_its_word(one.leader, one.told) else 0
    if one.doubted >= DOUBTED_FOR:
        one.told, one.known = None, False
        message = "The leader does not fly what it declared; its intent is no longer relied on."
        one.view = one.view._replace(changed="The leader broke its word.", changed_at=t)
        yield LeaderChanged(t=t, ident=one.names.leader, change="intent_broken", message=message)
    else:
        one.told.fly_second(t)


def _count(one: LinkState, fleet: Fleet, t: Second) -> list[Document]:
    """The figures a second later, and whether separation was lost in it."""
    least = fleet.least_apart(one.pursuer, one.leader)
    row = fleet.tallies[one.pursuer]
    tally = one.tally
    if least < tally.least_separation:
        tally = tally._replace(least_separation=least)
    if not one.milestones.joined:
        tally = tally._replace(
            heading_swing=float(row[SWING]),
            track=float(row[TRACK]),
            bank_reversals=int(row[REVERSALS]),
        )
    one.tally = tally
    limit = one.link.min_separation
    if least >= limit:
        one.lost = one.lost and fleet.apart(one.pursuer, one.leader) < limit
        return []
    if one.lost:
        one.milestones = count_loss(one.milestones, least)
        return []
    one.lost = True
    k, apart = _first_below(fleet, one, limit)
    own = fleet.state(one.pursuer, k)
    document = SeparationLost(
        t=t + k * fleet.step,
        ident=one.names.pursuer,
        other=one.names.leader,
        separation=apart,
        x=own.x,
        y=own.y,
        cause=_cause(one, t),
        announced=_announced(one.milestones),
    )
    one.milestones = count_event(one.milestones, document)
    one.milestones = count_loss(one.milestones, least)
    return [document]


def _announced(milestones: Milestones) -> tuple[Second, ...]:
    """When what stands was said first, alert or `Unable`; empty if nothing stands."""
    said = (*milestones.alerted, *milestones.unable)
    return (min(said),) if said else ()


def _first_below(fleet: Fleet, one: LinkState, limit: Metre) -> tuple[int, Metre]:
    """At which step of the last second the separation is below d_min, and what it is."""
    apart = np.hypot(*(fleet.trace[one.pursuer, :, :2] - fleet.trace[one.leader, :, :2]).T)
    below = np.flatnonzero(apart < limit)
    k = int(below[0]) if len(below) else int(np.argmin(apart))
    return min(k, fleet.steps - 1), float(apart[k])


def _cause(one: LinkState, t: Second) -> str:
    """Why separation was lost, in a sentence."""
    if t - one.view.changed_at < RECENT and one.view.changed:
        return one.view.changed
    if one.memory.mode in ("heading", "escape"):
        return "There was no path that kept it."
    return "What was flown is not what was forecast."


def _look_at_leader(
    one: LinkState, seen: Belief
) -> tuple[LeaderView, tuple[LeaderChanged | LeaderRoute, ...]]:
    """Announce a turn that was not to be expected, and draw the route anew if it changed."""
    view, news = _notice_turn(one, seen)
    if view.commanded or _route_is_news(view.shown, seen):
        return view._replace(shown=seen, commanded=False), (*news, _route(one, seen))
    return view, news


def _notice_turn(one: LinkState, seen: Belief) -> tuple[LeaderView, tuple[LeaderChanged, ...]]:
    """Whether the leader turns, and the news if it begins to without having announced it."""
    view, rate = one.view, seen.leader_turn_rate
    if view.turning or abs(rate) < TURN_SEEN:
        turning = view.turning and abs(rate) > TURN_OVER
        changed_at = seen.t if turning and not seen.intent_known else view.changed_at
        if turning == view.turning and changed_at == view.changed_at:
            return view, ()
        return view._replace(turning=turning, changed_at=changed_at), ()
    if seen.intent_known or view.commanded:
        return view._replace(turning=True), ()
    side = "right" if rate > 0.0 else "left"
    message = f"The leader turns {side}."
    said = LeaderChanged(t=seen.t, ident=one.names.leader, change="heading", message=message)
    changed = f"The leader turned {side} unannounced."
    return view._replace(turning=True, changed=changed, changed_at=seen.t), (said,)


def _route(one: LinkState, seen: Belief) -> LeaderRoute:
    return leader_route(
        seen.t, one.names, seen.leader_after(0.0), intent_known=seen.intent_known, wind=seen.wind
    )


def _route_is_news(shown: Belief, seen: Belief) -> bool:
    """Whether the route last shown is no longer what is expected."""
    if shown.intent_known != seen.intent_known:
        return True
    if abs(shown.leader.tas - seen.leader.tas) > ROUTE_SPEED:
        return True
    return abs(wrap_signed(seen.final_heading - shown.final_heading)) > ROUTE_TURNED


def _is_over(states: list[LinkState], t: Second, until: Second, after_joining: Second) -> bool:
    if t >= until:
        return True
    return all(
        one.memory.mode == "follow" and t - one.milestones.following_since >= after_joining
        for one in states
    )


def _sample(
    states: list[LinkState], fleet: Fleet, t: Second, since: Second, step: int | None
) -> Document:
    """All aircraft at a step of the last second; where they are now if no step is given."""
    links = [
        (one.names, one.advice, one.tally.least_separation)
        for one in states
        if one.advice is not None
    ]
    aircraft = [
        (aircraft.ident, fleet.state(i, step)) for i, aircraft in enumerate(fleet.world.aircraft)
    ]
    return sample(t + since, aircraft, fleet.wind, links, since)

"""fly(scenario, planner): the one closed loop of the library.

    leader → what the pursuer knows → guidance (once a second) → autopilot → aircraft (each step)

Everything else that flies a plan, live or not, iterates over these documents.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import count
from math import hypot
from typing import Literal, NamedTuple, assert_never

from relguide.flying.aircraft import A300, AircraftModel, AircraftState
from relguide.flying.aircraft import step as fly_step
from relguide.flying.aircraft_documents import AircraftCard, LinkCard
from relguide.flying.assignment import TURN_SEEN, Assignment, Observation
from relguide.flying.autopilot import Autopilot
from relguide.flying.cards import wind_card
from relguide.flying.documents import (
    Document,
    FlightStarted,
    LeaderChanged,
    LeaderRoute,
)
from relguide.flying.guidance import advise
from relguide.flying.leader import FlyingLeader, LeaderFlight, advance_leader, leader_on_track
from relguide.flying.logbook import (
    Milestones,
    Names,
    Tally,
    count_event,
    count_step,
    event_document,
    flight_ended,
    leader_route,
    sample,
)
from relguide.flying.memory import Advice, begin
from relguide.flying.orders import Command, obey
from relguide.flying.orders import IntentKnown as IntentKnown
from relguide.flying.orders import LeaderHeading as LeaderHeading
from relguide.flying.orders import LeaderSpeed as LeaderSpeed
from relguide.flying.orders import no_commands as no_commands
from relguide.flying.tracks import RecordedTrack
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.turn import turn_rate
from relguide.planning.inputs import expect, expect_function, number, text, truth, whole, within
from relguide.planning.limits import TAS
from relguide.planning.plan import Plan, Planner
from relguide.planning.situation import Situation, TurnTo, Wind
from relguide.units import DEG, KT, Metre, MetrePerSecond, Radian, RadianPerSecond, Second

ROUTE_TURNED: Radian = 1.0 * DEG  # a route drawn a degree off ends 2 % of its length aside
ROUTE_SPEED: MetrePerSecond = 2.0 * KT  # what the display rounds to
TURN_OVER: RadianPerSecond = 0.1 * DEG
TEXTS = ("name", "title", "description", "pursuer_ident", "leader_ident", "leader_type")
"""Fields of a scenario that people read."""
ALTITUDES: tuple[Metre, Metre] = (-500.0, 30_000.0)
"""Where aircraft fly [m]: from below the Dead Sea's shore to above any of them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredLeader:
    """A leader that flies the intent of the scenario's situation."""

    kind: Literal["declared"] = "declared"


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A flight that can be flown: where both begin, and what the leader will do."""

    name: str
    title: str
    description: str
    situation: Situation
    """At t = 0, with the leader's true intent."""
    intent_known: bool = True
    """Whether the pursuer knows it."""
    leader_source: DeclaredLeader | RecordedTrack = DeclaredLeader()
    """A recorded leader takes the place of the situation's; its intent is not known."""
    pursuer_ident: str = "PURSUER"
    leader_ident: str = "LEADER"
    leader_type: str = A300.aircraft_type
    altitude: Metre = 9449.0
    """Of the pursuer, and of a leader that is not recorded [m]; FL310."""
    duration_limit: Second = 3600.0
    """The flight ends here at the latest [s]."""
    after_joining: Second = 120.0
    """How long it goes on once joined [s]."""

    def __post_init__(self) -> None:
        """Refuse what cannot be flown."""
        for name in TEXTS:
            text(name, getattr(self, name))
        expect("situation", self.situation, Situation)
        expect("leader_source", self.leader_source, DeclaredLeader, RecordedTrack)
        truth("intent_known", self.intent_known)
        if self.pursuer_ident == self.leader_ident:
            raise ValueError(
                f"pursuer_ident and leader_ident must differ, not both be {self.leader_ident!r}."
            )
        within("altitude", self.altitude, *ALTITUDES, "m")
        if number("duration_limit", self.duration_limit) <= 0.0:
            raise ValueError(f"duration_limit must be above 0 s, not {self.duration_limit}.")
        if number("after_joining", self.after_joining) < 0.0:
            raise ValueError(f"after_joining must be 0 s or more, not {self.after_joining}.")


def fly(
    scenario: Scenario,
    planner: Planner,
    *,
    commands: Callable[[Second], Iterable[Command]] = no_commands,
    step: Second = 0.05,
    sample_period: Second = 0.05,
    seed: int = 0,
) -> Iterator[Document]:
    """Fly a scenario and say what happens, in order of time.

    Args:
        scenario: what to fly.
        planner: asked once a second, but not in the last turn, nor while the plan flown arrives as
            the slot opens: then no answer could be better.
        commands: polled at each step with the flight time; its commands take effect at once.
        step: integration step [s]; a whole number of steps makes a second.
        sample_period: between samples [s]; a whole number of steps.
        seed: written into the first document; nothing is random yet.

    Yields:
        `FlightStarted` first, `FlightEnded` last. What the planner raises is passed on as it is.
    """
    expect("scenario", scenario, Scenario)
    expect_function("planner", planner)
    expect_function("commands", commands)
    seed, step = whole("seed", seed, 0), number("step", step)
    a_second, a_sample = _whole(1.0, step), _whole(number("sample_period", sample_period), step)
    return _fly(scenario, planner, commands, step, a_second, a_sample, seed)


def _fly(
    scenario: Scenario,
    planner: Planner,
    commands: Callable[[Second], Iterable[Command]],
    step: Second,
    a_second: int,
    a_sample: int,
    seed: int,
) -> Iterator[Document]:
    wind, assignment, names = scenario.situation.wind, _assignment(scenario), _names(scenario)
    pursuer, leader = _pursuer(scenario), _leader(scenario)
    pilot = Autopilot(model=assignment.model)
    leader_pilot = Autopilot(model=_leader_model(scenario))
    known = scenario.intent_known and isinstance(leader, FlyingLeader)
    yield _announce_start(scenario, planner, step, seed)
    seen = _observe(0.0, pursuer, leader, known)
    memory = begin(seen, assignment)
    yield _route(seen, names, wind)
    view = _LeaderView(shown=seen, turning=False, commanded=False)
    separation = hypot(pursuer.x - leader.state.x, pursuer.y - leader.state.y)
    tally, milestones = Tally(separation, 0.0, 0.0, 0, 0), Milestones()
    for n in count():
        t = n * step
        for command in commands(t):
            leader, known, answers = obey(
                command, leader, names.leader, known, t, assignment.model.max_bank
            )
            if isinstance(command, LeaderHeading | LeaderSpeed):
                view = view._replace(commanded=True)
            yield from answers
        if n % a_second == 0:
            seen = _observe(t, pursuer, leader, known)
            view, news = _look_at_leader(view, seen, names, wind)
            yield from news
            memory, advice = advise(memory, seen, assignment, planner)
            for event in advice.events:
                document = event_document(t, names.pursuer, event)
                milestones = count_event(milestones, document)
                yield document
        if n % a_sample == 0:
            since = (n % a_second) * step
            yield sample(t, names, pursuer, leader.state, advice, since, tally, wind)
        rested = t - milestones.following_since >= scenario.after_joining
        if (rested and advice.mode == "follow") or t >= _limit(scenario, leader) - 0.5 * step:
            break
        before = pursuer
        pursuer = _fly_step(pursuer, pilot, advice, assignment, step)
        leader = advance_leader(leader, leader_pilot, t, wind=wind, duration=step)
        tally = count_step(tally, before, pursuer, leader.state, milestones.joined)
    yield flight_ended(t, names, milestones, tally, memory.fallbacks)


def _fly_step(
    pursuer: AircraftState, pilot: Autopilot, advice: Advice, assignment: Assignment, step: Second
) -> AircraftState:
    """The pursuer a step later, flown by its autopilot as advised."""
    return fly_step(
        assignment.model,
        pursuer,
        aileron=pilot.aileron(advice.reference, pursuer, step),
        commanded_tas=advice.commanded_tas,
        wind_east=assignment.wind.east,
        wind_north=assignment.wind.north,
        duration=step,
    )


def _announce_start(scenario: Scenario, planner: Planner, step: Second, seed: int) -> FlightStarted:
    situation = scenario.situation
    answer = planner(situation)
    return FlightStarted(
        t=0.0,
        scenario=scenario.name,
        title=scenario.title,
        planner=answer.planner if isinstance(answer, Plan) else "exact",
        aircraft=(
            AircraftCard(
                ident=scenario.pursuer_ident,
                aircraft_type=A300.aircraft_type,
                max_bank=situation.pursuer.max_bank,
            ),
            AircraftCard(
                ident=scenario.leader_ident,
                aircraft_type=scenario.leader_type,
                max_bank=_leader_model(scenario).max_bank,
            ),
        ),
        links=(
            LinkCard(
                pursuer=scenario.pursuer_ident,
                leader=scenario.leader_ident,
                slot_distance=situation.slot_distance,
                min_separation=situation.min_separation,
                spacing="distance",
            ),
        ),
        wind=wind_card(situation.wind),
        step=step,
        seed=seed,
    )


def _names(scenario: Scenario) -> Names:
    return Names(scenario.pursuer_ident, scenario.leader_ident)


def _pursuer(scenario: Scenario) -> AircraftState:
    """The pursuer at t = 0, wings level."""
    pursuer = scenario.situation.pursuer
    return AircraftState(
        pursuer.x, pursuer.y, wrap(pursuer.heading), 0.0, 0.0, pursuer.tas, scenario.altitude
    )


def _assignment(scenario: Scenario) -> Assignment:
    situation = scenario.situation
    return Assignment(
        model=_model(scenario),
        tas=situation.pursuer.tas,
        max_bank=situation.pursuer.max_bank,
        slot_distance=situation.slot_distance,
        min_separation=situation.min_separation,
        wind=situation.wind,
    )


def _leader(scenario: Scenario) -> LeaderFlight:
    match scenario.leader_source:
        case RecordedTrack() as track:
            return leader_on_track(track, 0.0, scenario.situation.wind)
        case DeclaredLeader():
            leader = scenario.situation.leader
            heading = wrap(leader.heading)
            state = AircraftState(
                leader.x, leader.y, heading, 0.0, 0.0, leader.tas, scenario.altitude
            )
            return FlyingLeader(
                state=state, pieces=leader.intent, since=0.0, heading=heading, tas=leader.tas
            )
        case _:
            assert_never(scenario.leader_source)


def _model(scenario: Scenario) -> AircraftModel:
    """The pursuer: an A300 that can fly what the situation asks for."""
    pursuer = scenario.situation.pursuer
    return replace(
        A300,
        max_bank=pursuer.max_bank,
        min_tas=min(A300.min_tas, 0.8 * pursuer.tas),
        max_tas=max(A300.max_tas, pursuer.tas),
    )


def _leader_model(scenario: Scenario) -> AircraftModel:
    """The leader: an A300 that can bank as its intent asks, and slows down without brakes."""
    leader = scenario.situation.leader
    banks = [piece.bank for piece in leader.intent if isinstance(piece, TurnTo)]
    return replace(
        A300,
        max_bank=max(A300.max_bank, *banks, 0.0),
        max_deceleration=0.5 * A300.max_deceleration,
        min_tas=TAS.low,
        max_tas=TAS.high,
    )


def _limit(scenario: Scenario, leader: LeaderFlight) -> Second:
    """When the flight ends at the latest [s]: a recording cannot be flown beyond its end."""
    if isinstance(leader, FlyingLeader):
        return scenario.duration_limit
    return min(scenario.duration_limit, leader.track.duration)


def _observe(t: Second, pursuer: AircraftState, leader: LeaderFlight, known: bool) -> Observation:
    state = leader.state
    return Observation(
        t=t,
        pursuer=pursuer,
        leader=state,
        leader_turn_rate=turn_rate(state.tas, state.bank),
        intent=leader.remaining_intent(t) if known else (),
        intent_known=known,
    )


class _LeaderView(NamedTuple):
    """What the display was last shown of the leader."""

    shown: Observation
    """From which its route was drawn."""
    turning: bool
    """Whether it turns, and that was announced."""
    commanded: bool
    """Whether a command changed its flight since its route was drawn."""


def _look_at_leader(
    view: _LeaderView, seen: Observation, names: Names, wind: Wind
) -> tuple[_LeaderView, tuple[LeaderChanged | LeaderRoute, ...]]:
    """Announce a turn that was not to be expected, and draw the route anew if it changed."""
    turning, news = _notice_turn(view, seen, names)
    if view.commanded or _route_is_news(view.shown, seen):
        return _LeaderView(seen, turning, commanded=False), (*news, _route(seen, names, wind))
    return view._replace(turning=turning), news


def _notice_turn(
    view: _LeaderView, seen: Observation, names: Names
) -> tuple[bool, tuple[LeaderChanged, ...]]:
    """Whether the leader turns, and the news if it begins to without having announced it."""
    rate = seen.leader_turn_rate
    if view.turning or abs(rate) < TURN_SEEN:
        return view.turning and abs(rate) > TURN_OVER, ()
    if seen.intent_known or view.commanded:
        return True, ()
    side = "right" if rate > 0.0 else "left"
    message = f"The leader turns {side}."
    return True, (LeaderChanged(t=seen.t, ident=names.leader, change="heading", message=message),)


def _route(seen: Observation, names: Names, wind: Wind) -> LeaderRoute:
    return leader_route(
        seen.t, names, seen.leader, seen.intent, intent_known=seen.intent_known, wind=wind
    )


def _route_is_news(shown: Observation, seen: Observation) -> bool:
    """Whether the route last shown is no longer what is expected."""
    if shown.intent_known != seen.intent_known:
        return True
    if abs(shown.leader.tas - seen.leader.tas) > ROUTE_SPEED:
        return True
    final, before = seen.final_heading, shown.final_heading
    return abs(wrap_signed(final - before)) > ROUTE_TURNED


def _whole(duration: Second, step: Second) -> int:
    """How many steps a duration has."""
    steps = round(duration / step) if step > 0.0 else 0
    if steps < 1 or abs(steps * step - duration) > 1e-9:
        raise ValueError(f"{duration:g} s must be a whole number of steps of {step:g} s.")
    return steps

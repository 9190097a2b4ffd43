"""fly(scenario, planner): a flight of a pursuer and its leader, and of others in their queue.

A `Scenario` says where both begin and what the leader will do; `fly` makes a world of it and
simulates it.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal, assert_never

from relguide.flying.air import Air
from relguide.flying.airframe import Airframe
from relguide.flying.airframe_files import airframe, known_airframes
from relguide.flying.documents import Document
from relguide.flying.engagement import Engagement
from relguide.flying.envelope import envelope_fault
from relguide.flying.fans import Wants, no_fans
from relguide.flying.followers import Follower, expect_followers
from relguide.flying.guidance.settings import DEFAULT, Settings
from relguide.flying.guidances import Guidance, expect_guidance
from relguide.flying.orders import Command
from relguide.flying.orders import IntentKnown as IntentKnown
from relguide.flying.orders import LeaderData as LeaderData
from relguide.flying.orders import LeaderHeading as LeaderHeading
from relguide.flying.orders import LeaderLevel as LeaderLevel
from relguide.flying.orders import LeaderSpeed as LeaderSpeed
from relguide.flying.orders import PursuerHeading as PursuerHeading
from relguide.flying.orders import SetEngagement as SetEngagement
from relguide.flying.orders import no_commands as no_commands
from relguide.flying.pilot_model import PilotModel
from relguide.flying.queues import queue_up
from relguide.flying.simulation import simulate, whole_steps
from relguide.flying.surveillance import EXACT, Surveillance
from relguide.flying.tracks import RecordedTrack
from relguide.flying.wind_profile import WindProfile
from relguide.flying.world import FLOWN_POSITION, Aircraft, Declared, Guided, Link, Recorded, World
from relguide.planning.aircraft import Leader, Pursuer, Traffic
from relguide.planning.cells import Cell
from relguide.planning.inputs import (
    expect,
    expect_function,
    expect_whole,
    expect_within,
    number,
    text,
    truth,
)
from relguide.planning.intent import IntentPiece, TurnTo
from relguide.planning.limits import ALTITUDE, SPACING
from relguide.planning.outcome import Plan, Planner
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.wind import CALM
from relguide.units import DEG, Kilogram, Metre, MetrePerSecond, Radian, Second

TEXTS = ("name", "title", "description", "pursuer_ident", "leader_ident", "leader_type")
"""Fields of a scenario that people read."""
LEADER_BANK: Radian = 30.0 * DEG
"""What a leader's autopilot may use, if its intent asks for no more [rad]."""
DEFAULT_TYPE = "A306"


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredLeader:
    """A leader that flies the intent of the scenario's situation.

    Examples:
        >>> rg.scenario("fig_6b").leader_source
        DeclaredLeader(kind='declared')
    """

    kind: Literal["declared"] = "declared"


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A flight that can be flown: where all begin, and what the leader will do.

    Examples:
        >>> from dataclasses import replace
        >>> gusty = replace(rg.scenario("fig_6b"), name="gusty", gusts=1.5, pursuer_weight=130e3)
        >>> gusty.air.gusts  # [m/s]
        1.5
    """

    name: str
    title: str
    description: str
    situation: Situation
    """At t = 0, with the leader's true intent; other traffic flies what it declares."""
    intent_known: bool = True
    """Whether the pursuer knows it."""
    declared_intent: tuple[IntentPiece, ...] | None = None
    """What the leader declared, if it is not what it flies: it breaks its word."""
    leader_source: DeclaredLeader | RecordedTrack = DeclaredLeader()
    """A recorded leader takes the place of the situation's; its intent is not known."""
    pursuer_ident: str = "PURSUER"
    leader_ident: str = "LEADER"
    pursuer_type: str = DEFAULT_TYPE
    """ICAO designator of one of the types that are known."""
    pursuer_weight: Kilogram = 0.0
    """[kg]; 0 for the reference weight of its type."""
    leader_type: str = DEFAULT_TYPE
    """Of a leader that is not recorded; of another only its designator is shown."""
    altitude: Metre = 9449.0
    """Of both, where the situation does not say [m]; FL310."""
    isa_deviation: float = 0.0
    """Temperature above the standard atmosphere's [K]."""
    profile: WindProfile | None = None
    """The wind by altitude that blows in place of the situation's."""
    gusts: MetrePerSecond = 0.0
    """σ of gusts along and across an aircraft's heading [m/s]."""
    believed_air: Air | None = None
    """What guidance believes of the air at the start; the truth, if left out."""
    surveillance: Surveillance = EXACT
    """How the pursuer sees its leader."""
    spacing: Second = 0.0
    """Time behind the leader to keep once joined [s]; 0 to keep D."""
    by_hand: PilotModel | None = None
    """The pilot that flies it by hand along the flight director's bar; `None`: the autopilot does,
    until the crew takes control."""
    ahead: tuple[Follower, ...] = ()
    """A queue behind the leader, whose last aircraft the pursuer joins; the first one first."""
    followers: tuple[Follower, ...] = ()
    """A queue behind the pursuer."""
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
        taken = {self.pursuer_ident, self.leader_ident}
        for name in ("ahead", "followers"):
            queue = expect_followers(name, getattr(self, name), taken)
            object.__setattr__(self, name, queue)
        expect_within("altitude", self.altitude, *ALTITUDE)
        expect_within("spacing", self.spacing, *SPACING)
        if self.believed_air is not None:
            expect("believed_air", self.believed_air, Air)
        expect("surveillance", self.surveillance, Surveillance)
        if self.by_hand is not None:
            expect("by_hand", self.by_hand, PilotModel)
        if number("duration_limit", self.duration_limit) <= 0.0:
            raise ValueError(f"duration_limit must be above 0 s, not {self.duration_limit}.")
        if number("after_joining", self.after_joining) < 0.0:
            raise ValueError(f"after_joining must be 0 s or more, not {self.after_joining}.")
        pursuer, leader = self.situation.pursuer, self.situation.leader
        begin: list[tuple[str, Pursuer | Leader | Traffic]] = [
            (self.pursuer_ident, pursuer),
            (self.leader_ident, leader),
        ]
        begin += [(one.ident, one) for one in self.situation.others if isinstance(one, Traffic)]
        for ident, one in begin:
            expect_within(f"x of {ident}", one.x, *FLOWN_POSITION)
            expect_within(f"y of {ident}", one.y, *FLOWN_POSITION)
        airframe(self.pursuer_type).expect_weight("pursuer_weight", self.pursuer_weight)
        fault = envelope_fault(
            airframe(self.pursuer_type),
            self.altitude if pursuer.altitude is None else pursuer.altitude,
            self.air,
            tas=pursuer.tas,
            bank=pursuer.max_bank,
            weight=self.pursuer_weight,
        )
        if fault:
            raise ValueError(fault)

    @property
    def air(self) -> Air:
        """The air it is flown in."""
        return Air(
            wind=self.situation.wind if self.profile is None else CALM,
            profile=self.profile,
            isa_deviation=self.isa_deviation,
            gusts=self.gusts,
        )


def fly(
    scenario: Scenario,
    planner: Planner = plan,
    *,
    commands: Callable[[Second], Iterable[Command]] = no_commands,
    step: Second = 0.05,
    sample_period: Second = 0.05,
    seed: int = 0,
    settings: Settings = DEFAULT,
    engagement: Engagement = "engaged",
    guidance: Guidance = "relguide",
    planner_name: str | None = None,
    wants_fan: Wants = no_fans,
) -> Iterator[Document]:
    """Fly a scenario and say what happens, in order of time.

    Examples:
        >>> *_, end = rg.fly(rg.scenario("fig_6b"), rg.plan, sample_period=1.0)
        >>> end.message
        'Joined, and followed for 120 s.'

        With orders by flight time:

        >>> orders = {
        ...     60.0: [rg.LeaderHeading(heading=2.0), rg.LeaderSpeed(tas=190.0)],
        ...     90.0: [rg.LeaderLevel(altitude=9_000.0), rg.IntentKnown(known=True)],
        ...     120.0: [rg.SetSpacing(slot_distance=12e3), rg.PursuerBank(bank=0.35)],
        ...     150.0: [rg.LeaderData(received=False), rg.SetDirector(on=False)],
        ... }
        >>> from dataclasses import replace
        >>> begins = replace(rg.scenario("fig_6a"), duration_limit=160.0)
        >>> flown = rg.fly(begins, commands=lambda t: orders.get(t, ()), sample_period=1.0)
        >>> [said.change for said in flown if isinstance(said, rg.LeaderChanged)]
        ['heading', 'speed', 'level', 'intent_received']

    Args:
        scenario: what to fly.
        planner: the exact one if left out. It is asked at engagement, whenever the leader does
            something new, and for better paths as `Settings.ask_every` says. Its plans are judged
            before they are flown.
        commands: polled once a second with the flight time [s]; its commands take effect at once.
        step: integration step [s]; a whole number of steps makes a second.
        sample_period: between samples [s]; a whole number of steps.
        seed: 0 flies the types as their data say; any other draws the pursuer's constants within
            10 % of them, unknown to its guidance.
        settings: of guidance.
        engagement: how far guidance is engaged at the start; commands change it.
        guidance: relguide's, or a baseline, which asks no planner.
        planner_name: who makes the plans, as `FlightStarted` says; if left out, a planner other
            than `plan` is asked once more, to learn what name its plans give it.
        wants_fan: asked with the flight time [s] when a fan of joins (`FanChanged`) is due, while
            the leader's intent is not known; by default there is none.

    Yields:
        `FlightStarted` first, `FlightEnded` last. What the planner raises is passed on as it is.
    """
    if isinstance(scenario, str):
        raise ValueError(f"scenario must be a Scenario: scenario({scenario!r}) makes one by name.")
    expect("scenario", scenario, Scenario)
    if isinstance(planner, str):
        raise ValueError(
            "planner must be a function, as plan is: relguide.learn.planners.make_planner("
            f"{planner!r}) makes one by name."
        )
    expect_function("planner", planner)
    expect_function("commands", commands)
    expect_function("wants_fan", wants_fan)
    expect("settings", settings, Settings)
    expect_guidance(guidance)
    seed, step = expect_whole("seed", seed, 0), number("step", step)
    whole_steps(1.0, step)
    whole_steps(number("sample_period", sample_period), step)
    return _fly(
        scenario,
        planner,
        commands,
        step,
        sample_period,
        seed,
        settings,
        engagement,
        guidance,
        planner_name,
        wants_fan,
    )


def _fly(
    scenario: Scenario,
    planner: Planner,
    commands: Callable[[Second], Iterable[Command]],
    step: Second,
    sample_period: Second,
    seed: int,
    settings: Settings,
    engagement: Engagement,
    guidance: Guidance,
    planner_name: str | None,
    wants_fan: Wants,
) -> Iterator[Document]:
    if planner_name is None:
        by_plans = guidance == "relguide"
        planner_name = _name_of(planner, scenario.situation) if by_plans else guidance
    yield from simulate(
        world_of(scenario, settings, seed),
        planner,
        scenario=scenario.name,
        title=scenario.title,
        planner_name=planner_name,
        commands=commands,
        step=step,
        sample_period=sample_period,
        seed=seed,
        until=scenario.duration_limit,
        after_joining=scenario.after_joining,
        engagement=engagement,
        guidance=guidance,
        wants_fan=wants_fan,
    )


def _name_of(planner: Planner, situation: Situation) -> str:
    """The name that a planner gives itself in its plans."""
    answer = None if planner is plan else planner(situation)
    return answer.planner if isinstance(answer, Plan) else "exact"


def world_of(scenario: Scenario, settings: Settings = DEFAULT, seed: int = 0) -> World:
    """The world of a scenario: two aircraft, their queue and its links, and all others.

    Args:
        scenario: what is to be flown.
        settings: of guidance.
        seed: as in `fly`.
    """
    situation, leader = scenario.situation, scenario.situation.leader
    first = Follower(
        ident=scenario.pursuer_ident,
        pursuer=situation.pursuer,
        aircraft_type=scenario.pursuer_type,
        weight=scenario.pursuer_weight,
    )
    banks = [piece.bank for piece in leader.intent if isinstance(piece, TurnTo)]
    match scenario.leader_source:
        case RecordedTrack() as track:
            pilot: Declared | Recorded = Recorded(track=track)
        case DeclaredLeader():
            pilot = Declared(intent=leader.intent)
        case _:
            assert_never(scenario.leader_source)
    return World(
        aircraft=(
            replace(
                first.aircraft(scenario.altitude, seed), pilot=Guided(by_hand=scenario.by_hand)
            ),
            Aircraft(
                ident=scenario.leader_ident,
                airframe=_leader_airframe(scenario.leader_type),
                aircraft_type=scenario.leader_type,
                x=leader.x,
                y=leader.y,
                heading=leader.heading,
                tas=leader.tas,
                altitude=scenario.altitude if leader.altitude is None else leader.altitude,
                max_bank=max(LEADER_BANK, *banks, 0.0),
                pilot=pilot,
            ),
            *(
                one.aircraft(scenario.altitude, seed + k if seed else 0)
                for k, one in enumerate((*scenario.ahead, *scenario.followers), start=1)
            ),
            *(
                _traffic(other, scenario)
                for other in situation.others
                if isinstance(other, Traffic)
            ),
        ),
        links=_links(scenario),
        air=scenario.air,
        believed_air=scenario.believed_air,
        surveillance=scenario.surveillance,
        settings=settings,
        cells=tuple(other for other in situation.others if isinstance(other, Cell)),
    )


def _traffic(other: Traffic, scenario: Scenario) -> Aircraft:
    """Other traffic, which flies what it has declared; at the level of the two if it says none."""
    banks = [piece.bank for piece in other.intent if isinstance(piece, TurnTo)]
    return Aircraft(
        ident=other.ident,
        airframe=airframe(DEFAULT_TYPE),
        aircraft_type=DEFAULT_TYPE,
        x=other.x,
        y=other.y,
        heading=other.heading,
        tas=other.tas,
        altitude=scenario.altitude if other.altitude is None else other.altitude,
        max_bank=max(LEADER_BANK, *banks, 0.0),
        pilot=Declared(intent=other.intent),
        min_separation=other.min_separation,
    )


def _links(scenario: Scenario) -> tuple[Link, ...]:
    """Each behind the one before it; the link of the scenario's pursuer comes first."""
    situation, own = scenario.situation, scenario.pursuer_ident
    queue = (
        *(one.ident for one in scenario.ahead),
        own,
        *(one.ident for one in scenario.followers),
    )
    links = queue_up(
        queue,
        scenario.leader_ident,
        slot_distance=situation.slot_distance,
        min_separation=situation.min_separation,
        spacing=scenario.spacing,
        intent_known=scenario.intent_known,
        declared_intent=scenario.declared_intent,
    )
    return tuple(sorted(links, key=lambda link: link.pursuer != own))


def _leader_airframe(designator: str) -> Airframe:
    """How a leader rolls and changes speed: as its type if that is known, else as an A300."""
    return airframe(designator if designator in known_airframes() else DEFAULT_TYPE)

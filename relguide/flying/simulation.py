"""simulate(world, …): the one closed loop of the library, for any number of aircraft.

    world → what each pursuer believes → guidance (once a second) → a second flown → documents

Everything else that flies a plan, live or not, iterates over these documents.
"""

from collections.abc import Callable, Collection, Generator, Iterable, Iterator
from functools import partial
from itertools import count
from typing import get_args

from relguide.flying.aircraft_ahead import mind_ahead, to_keep_clear_of, watch_ahead
from relguide.flying.aircraft_documents import AircraftCard, LinkCard
from relguide.flying.assigning import obey_tasks
from relguide.flying.belief import Belief
from relguide.flying.braking import learn_braking
from relguide.flying.by_hand import bars_of, mind_reaction
from relguide.flying.cards import wind_card
from relguide.flying.crew import obey_crew
from relguide.flying.documents import (
    CommandGiven,
    Document,
    EndReason,
    Engagement,
    FlightEnded,
    FlightStarted,
    Sample,
    Unable,
)
from relguide.flying.fans import Wants, follow_fan, no_fans
from relguide.flying.fleet import Fleet
from relguide.flying.guidance.choice import Guide, guide_by
from relguide.flying.guidance.level import follow_level
from relguide.flying.guidances import Guidance, expect_guidance
from relguide.flying.leader_watch import (
    doubt_leader,
    expected_route,
    note_command,
    watch_leader,
)
from relguide.flying.logbook import (
    LinkState,
    cell_card,
    event_document,
    forecast_document,
    sample,
)
from relguide.flying.metrics import count_event, count_steps, link_result
from relguide.flying.optimum import optimum
from relguide.flying.ordered import obey
from relguide.flying.orders import (
    Command,
    CrewCommand,
    Stick,
    expect_engagement,
    no_commands,
    order_fault,
)
from relguide.flying.pursuit import (
    Pursuit,
    as_it_is_flown,
    begin_pursuit,
    fit_to_level,
    keep_margin,
)
from relguide.flying.sky import Sky
from relguide.flying.world import Aircraft, Guided, World
from relguide.planning.inputs import expect, expect_function, expect_whole, number, text
from relguide.planning.outcome import Planner
from relguide.planning.plan import plan
from relguide.planning.wind import Wind
from relguide.units import Metre, Radian, Second

Fan = Callable[[Pursuit, Belief], Iterator[Document]]
"""What is said of joins after turns that a leader has not announced."""


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
    engagement: Engagement = "engaged",
    guidance: Guidance = "relguide",
    wants_fan: Wants = no_fans,
) -> Iterator[Document]:
    """Fly a world and say what happens, in order of time.

    Examples:
        >>> from dataclasses import replace
        >>> leader = rg.Aircraft(
        ...     ident="A", airframe=rg.airframe("A306"), aircraft_type="A306", pilot=rg.Declared(),
        ...     x=0.0, y=0.0, heading=1.5708, tas=200.0, altitude=9_449.0, max_bank=0.4)
        >>> own = replace(leader, ident="B", x=-40e3, y=20e3, tas=230.0, pilot=rg.Guided())
        >>> link = rg.Link(pursuer="B", leader="A", slot_distance=10e3, min_separation=9_260.0)
        >>> world = rg.World(aircraft=(leader, own), links=(link,))
        >>> def reports(t):
        ...     return [rg.LeaderReport(
        ...         x=200.0 * (t + 1.0), y=0.0, track=1.5708, ground_speed=200.0, altitude=9_449.0)]
        >>> *_, end = rg.simulate(world, commands=reports, sample_period=1.0)
        >>> end.message
        'Joined, and followed for 120 s.'

    Args:
        world: who flies, in what air, and who is to join whom.
        planner: makes the plans of all pursuers; they are judged before they are flown.
        scenario: the flight's name.
        title: the same for people.
        planner_name: who makes the plans, as their cards say.
        commands: polled once a second with the flight time [s]; each is for the aircraft that it
            names, or else for the first link.
        step: integration step [s]; a whole number of steps makes a second.
        sample_period: between samples [s]; a whole number of steps.
        seed: from which the world was drawn; written into the first document.
        until: the flight ends here at the latest [s].
        after_joining: how long it goes on once all pursuers have joined [s].
        engagement: how far guidance is engaged at the start.
        guidance: of all pursuers: relguide's, or a baseline, which asks no planner and is named in
            its place.
        wants_fan: asked with the flight time [s] when a fan of joins is due, while a leader's
            intent is not known; by default there is none.

    Yields:
        `FlightStarted` first, `FlightEnded` last. What the planner raises is passed on as it is.
    """
    expect("world", world, World)
    expect_function("planner", planner)
    expect_function("commands", commands)
    expect_function("wants_fan", wants_fan)
    for name, value in (("scenario", scenario), ("title", title), ("planner_name", planner_name)):
        text(name, value)
    expect_whole("seed", seed, 0)
    step, until = number("step", step), number("until", until)
    a_sample = whole_steps(number("sample_period", sample_period), step)
    whole_steps(1.0, step)
    if until <= 0.0:
        raise ValueError(f"until must be above 0 s, not {until:g} s.")
    after_joining = number("after_joining", after_joining)
    if after_joining < 0.0:
        raise ValueError(f"after_joining must be 0 s or more, not {after_joining:g} s.")
    expect_engagement(engagement)
    expect_guidance(guidance)
    fan = partial(follow_fan, planner=planner, wants=wants_fan)
    guide = guide_by(guidance, planner)
    by = planner_name if guidance == "relguide" else guidance
    start = _start_document(world, by, scenario, title, step, seed)
    return _simulate(
        world, guide, fan, start, commands, step, a_sample, until, after_joining, engagement
    )


def _simulate(
    world: World,
    guide: Guide,
    fan: Fan,
    start: FlightStarted,
    commands: Callable[[Second], Iterable[Command]],
    step: Second,
    a_sample: int,
    until: Second,
    after_joining: Second,
    engagement: Engagement,
) -> Iterator[Document]:
    fleet = Fleet(world, step, start.seed)
    yield start
    pursuits = [begin_pursuit(world, fleet, link, engagement, start.seed) for link in world.links]
    for one in pursuits:
        if not one.queued:
            yield expected_route(one, one.view.shown)
    sky = Sky(world, fleet, start.seed)
    later: list[Command] = []
    for second in count():
        t = float(second)
        for command in (*later, *commands(t)):
            yield from _obey(command, fleet, pursuits, t)
        later = []
        for one in pursuits:
            yield from _guide(one, pursuits, fleet, sky, guide, fan, t)
        end = _end(pursuits, fleet, t, until, after_joining)
        if end is not None:
            yield from _finish(pursuits, fleet, t, *end)
            return
        least = [one.metrics.least_separation for one in pursuits]
        sampled = range(-second * fleet.steps % a_sample, fleet.steps, a_sample)
        if any(fleet.is_by_stick(one.pursuer) for one in pursuits):
            later = yield from _fly_by_stick(pursuits, fleet, commands, sampled, t)
        else:
            fleet.fly_second(t)
            documents: list[Document] = []
            for one in pursuits:
                documents += count_steps(one, fleet, t)
            for k in sampled:
                now = _sample(pursuits, least, fleet, t, k * step, k)
                least = [seen.least_separation for seen in now.guidance]
                documents.append(now)
            yield from sorted(documents, key=lambda document: document.t)
        sky.fly_second(t)


def _fly_by_stick(
    pursuits: list[Pursuit],
    fleet: Fleet,
    commands: Callable[[Second], Iterable[Command]],
    sampled: Collection[int],
    t: Second,
) -> Generator[Document, None, list[Command]]:
    """A second flown step by step: a stick moves at once, all else is for the next second.

    Returns:
        What was ordered and is still to be done.
    """
    later: list[Command] = []
    fleet.begin_second(t)
    for k in range(fleet.steps):
        now = t + k * fleet.step
        if k in sampled:
            least = [one.metrics.least_separation for one in pursuits]
            yield _sample(pursuits, least, fleet, t, now - t, k)
        if k > 0:
            for command in commands(now):
                if isinstance(command, Stick):
                    yield from _obey(command, fleet, pursuits, now)
                else:
                    later.append(command)
        fleet.fly_steps(t, k, k + 1)
        for one in pursuits:
            yield from count_steps(one, fleet, now)
    return later


def whole_steps(duration: Second, step: Second) -> int:
    """How many steps a duration has.

    Raises:
        ValueError: if it is not a whole number of them.
    """
    steps = round(duration / step) if step > 0.0 else 0
    if steps < 1 or abs(steps * step - duration) > 1e-9:
        raise ValueError(f"{duration:g} s must be a whole number of steps of {step:g} s.")
    return steps


def _start_document(
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
                autopilot_bank=_autopilot_bank(aircraft),
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
                spacing_time=link.spacing,
            )
            for link in world.links
        ),
        wind=wind_card(_wind_at_start(world)),
        step=step,
        seed=seed,
        cells=tuple(map(cell_card, world.cells)),
    )


def _wind_at_start(world: World) -> Wind:
    """The wind where the first pursuer begins; at the first aircraft where there is none."""
    first = world.aircraft[world.index(world.links[0].pursuer) if world.links else 0]
    return world.air.wind_at(first.x, first.y, first.altitude, 0.0)


def _obey(command: Command, fleet: Fleet, pursuits: list[Pursuit], t: Second) -> Iterator[Document]:
    """Who is ordered does so; all pursuers of a leader hear of it."""
    expect("A command", command, *get_args(Command))
    world = fleet.world
    links = [(link.pursuer, link.leader) for link in world.links]
    fault = order_fault(command, [aircraft.ident for aircraft in world.aircraft], links)
    if fault:
        raise ValueError(fault)
    yield CommandGiven(t=t, command=command)
    if isinstance(command, CrewCommand):
        for one in _pursuits_of(command.ident, pursuits):
            yield from obey_crew(one, command, fleet, t)
        return
    if not (command.ident or links):
        return
    ordered = world.index(command.ident or links[0][1])
    behind = [one for one in pursuits if ordered in (one.leader, one.ahead)]
    known, said = obey(command, fleet, ordered, any(one.known for one in behind), t)
    for one in behind:
        one.known = known
        note_command(one, command, t)
    yield from said


def _pursuits_of(ident: str, pursuits: list[Pursuit]) -> list[Pursuit]:
    """The pursuit of an aircraft; the first one if `ident` is empty."""
    return [one for one in pursuits if ident == one.names.pursuer] if ident else pursuits[:1]


def _guide(
    one: Pursuit,
    pursuits: list[Pursuit],
    fleet: Fleet,
    sky: Sky,
    guide: Guide,
    fan: Fan,
    t: Second,
) -> Iterator[Document]:
    """One act of guidance, and what is new of the leader."""
    learn_braking(one, fleet)
    yield from doubt_leader(one, fleet, t)
    belief = sky.seen_by(one, pursuits, one.belief(fleet, t))
    one.seen_others = belief.others
    belief = to_keep_clear_of(one, belief)
    one.track.add(belief.leader, belief.drift, t)
    yield from watch_leader(one, belief)
    yield from watch_ahead(one, belief)
    keep_margin(one, belief)
    fit_to_level(one, fleet)
    yield from obey_tasks(one, pursuits, fleet, belief, guide.reassign, t)
    belief = as_it_is_flown(one, belief)
    one.memory, advice = guide.advise(one.memory, belief, one.assignment)
    advice = mind_ahead(one, pursuits, belief, advice)
    for event in advice.events:
        document = event_document(t, one.watched, event)
        one.metrics = count_event(one.metrics, document, one.names.leader)
        yield document
    mind_reaction(one, fleet, advice.events, t)
    if advice.forecast is not None and advice.forecast is not one.shown_forecast:
        one.shown_forecast = advice.forecast
        yield forecast_document(t, one.names.pursuer, advice.forecast, belief.spread)
    if advice.joined and not one.metrics.joined:
        one.metrics = one.metrics._replace(joined=True, join_time=t)
    one.advice = advice
    yield from fan(one, belief)
    fleet.control(one.pursuer, advice.control)
    level = follow_level(one.memory, belief, one.assignment)
    if level is not None:
        fleet.change_level(one.pursuer, level.to, level.rate)


def _end(
    pursuits: list[Pursuit], fleet: Fleet, t: Second, until: Second, after_joining: Second
) -> tuple[EndReason, str] | None:
    """Why the flight ends now, and the same in a sentence; `None` if it goes on."""
    edge = fleet.beyond_edge()
    if edge:
        return (
            "plane_left",
            f"{edge} leaves the plane of this flight, and with it what can be planned.",
        )
    if pursuits and all(
        one.memory.mode == "follow" and t - one.metrics.following_since >= after_joining
        for one in pursuits
    ):
        return "joined", f"Joined, and followed for {after_joining:.0f} s."
    if t >= fleet.recorded_until():
        return "recording_over", f"The leader's recording ends after {t:.0f} s."
    if t >= until:
        return "time_over", f"The flight ends at its time limit of {until:.0f} s."
    return None


def _finish(
    pursuits: list[Pursuit], fleet: Fleet, t: Second, reason: EndReason, message: str
) -> Iterator[Document]:
    """Where all are at the end, and how it went."""
    if reason == "plane_left":
        for one in pursuits:
            yield Unable(t=t, ident=one.names.pursuer, reason="geometry", message=message)
    least = [one.metrics.least_separation for one in pursuits]
    yield _sample(pursuits, least, fleet, t, 0.0, None)
    results = tuple(
        link_result(
            t,
            one.names,
            one.metrics,
            one.memory.fallbacks,
            optimum(fleet.world, one.flown) if one.metrics.joined else 0.0,
        )
        for one in pursuits
    )
    yield FlightEnded(t=t, reason=reason, message=message, results=results)


def _sample(
    pursuits: list[Pursuit],
    least: list[Metre],
    fleet: Fleet,
    t: Second,
    since: Second,
    step: int | None,
) -> Sample:
    """All aircraft at a step of the last second; where they are now if no step is given.

    `least` are the least separations before: the whole second is flown, but not shown yet.
    """
    links = [
        LinkState(
            names=one.names,
            advice=one.advice,
            least=before,
            autopilot=one.autopilot,
            director=one.director,
            bars=bars_of(one, fleet, step),
            least_tas=fleet.level_limits[one.pursuer].min_tas,
        )
        for one, before in zip(pursuits, least, strict=True)
        if one.advice is not None
    ]
    aircraft = [
        (aircraft.ident, fleet.state(i, step), fleet.wind(i, step))
        for i, aircraft in enumerate(fleet.world.aircraft)
    ]
    return sample(t + since, aircraft, links, since)


def _autopilot_bank(aircraft: Aircraft) -> Radian:
    return aircraft.autopilot_bank if isinstance(aircraft.pilot, Guided) else 0.0

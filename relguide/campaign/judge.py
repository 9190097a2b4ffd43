"""Flying a case, and its documents as one row of figures: all that a campaign knows of flying."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from math import hypot
from time import thread_time

import numpy as np

from relguide.campaign.case import Case
from relguide.campaign.evasion import AHEAD, best_turn
from relguide.campaign.hand_flying import with_autopilot
from relguide.campaign.instant import EVERY, instant
from relguide.campaign.losses import losses_of, warnings_of
from relguide.campaign.paths import (
    Floats,
    circles,
    count_circles,
    distance_from,
    lone_circles,
    path_in_air,
    reversals,
    reversals_of,
    turns_flown,
    without_corrections,
)
from relguide.campaign.row import Row
from relguide.flying.aircraft_documents import GuidanceSample, HeadingReference
from relguide.flying.documents import (
    Alert,
    Document,
    FlightEnded,
    ForecastChanged,
    LeaderRoute,
    PlanChanged,
    Sample,
    Unable,
)
from relguide.flying.orders import Command
from relguide.flying.scripted_crew import begun, with_crew
from relguide.flying.simulation import simulate
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.wind import Wind
from relguide.units import DEG, Metre, Second


def fly_case(case: Case) -> Row:
    """Fly it, by hand and by the autopilot. What guidance or the planner raises is passed on."""
    begun = thread_time()
    documents = tuple(documents_of(case))
    row = row_of(case, documents, thread_time() - begun)
    if case.scenario.by_hand is None:
        return row
    by_autopilot = replace(case, scenario=replace(case.scenario, by_hand=None))
    return with_autopilot(row, documents, tuple(documents_of(by_autopilot)))


def documents_of(case: Case, sample_period: Second = EVERY) -> Iterator[Document]:
    """What the flight of a case says, in order of time."""
    scenario = case.scenario
    engagement, script = begun(case.crew) if case.crew else ("engaged", ())
    flown = partial(
        simulate,
        case.world(),
        plan,
        scenario=scenario.name,
        title=scenario.title,
        sample_period=sample_period,
        seed=case.noise_seed,
        until=scenario.duration_limit,
        after_joining=scenario.after_joining,
        engagement=engagement,
        guidance=case.guidance,
    )
    return with_crew(script, flown, _orders(case.orders))


def failed_row(family: str, number: int, error: BaseException) -> Row:
    """The row of a flight that could not be drawn, or ended with an exception."""
    return Row(
        family=family, number=number, planned=False, intent_known=False, joined=False, flown_s=0.0,
        join_s=None, planned_s=None, promised_s=None, join_over_plan=None, join_over_promise=None,
        least_share=0.0, start_share=0.0, below_s=0.0, losses=(), silent_losses=0,
        shown_replans=0, all_replans=0, reversals=0, extra_reversals=None, unplanned_reversals=None,
        swing_deg=0.0, loops=0, lone_loops=0, heading_jump_deg=0.0, cross_track_m=0.0,
        off_forecast_m=None, fastest_mps=0.0, alerts=0, cpu_s=0.0,
        error=f"{type(error).__name__}: {error}",
    )  # fmt: skip


def row_of(case: Case, documents: tuple[Document, ...], cpu: Second) -> Row:
    """The figures of a flight."""
    last = documents[-1]
    assert isinstance(last, FlightEnded)
    (end,) = last.results
    situation = case.scenario.situation
    optimum = end.optimum if end.optimum and case.leader_as_declared else None
    samples = [instant(document) for document in documents if isinstance(document, Sample)]
    changed = [document for document in documents if isinstance(document, PlanChanged)]
    by_crew = bool(case.crew) and bool(changed)
    engaged = changed[0] if end.planned_time > 0.0 or by_crew else None
    planned = engaged.plan.time_to_converge if engaged else None
    promised = engaged.promised if engaged else None
    joined = end.join_time if end.joined else None
    since = joined - engaged.t if engaged and joined else None
    warnings = tuple(warnings_of(documents))
    losses = tuple(losses_of(situation.min_separation, samples, end, warnings))
    paths = [(document.t, document.plan.segments) for document in changed]
    flown = list(turns_flown(paths, last.t if joined is None else joined))
    turns = without_corrections(angle for angle, _ in flown)
    loops = count_circles((s.pursuer.turn_rate for s in samples), EVERY) - max(
        count_circles((s.leader.turn_rate for s in samples), EVERY),
        circles(zip(turns, (seconds for _, seconds in flown), strict=True)),
    )
    return Row(
        family=case.family,
        number=case.number,
        planned=engaged is not None,
        intent_known=case.scenario.intent_known,
        joined=end.joined,
        flown_s=last.t,
        join_s=joined,
        planned_s=planned,
        promised_s=promised,
        join_over_plan=since / planned if since and planned else None,
        join_over_promise=since / promised if since and promised else None,
        optimum_s=optimum,
        over_optimum_s=_over_optimum(case, optimum, joined),
        why_not_joined="" if end.joined else _why_not(documents),
        join_over_last_promise=_join_over_last_promise(changed, joined),
        least_share=end.least_separation / situation.min_separation,
        start_share=_start_share(situation),
        below_s=sum(loss.seconds for loss in losses),
        losses=losses,
        silent_losses=sum(loss.announced_s is None for loss in losses),
        shown_replans=end.replans_announced,
        all_replans=end.replans,
        reversals=end.bank_reversals,
        extra_reversals=end.bank_reversals - reversals_of(engaged.plan.segments)
        if engaged
        else None,
        unplanned_reversals=end.bank_reversals - reversals(turns) if engaged else None,
        along_error_m=end.along_error,
        across_error_m=end.across_error,
        swing_deg=end.heading_swing / DEG,
        loops=max(loops, 0),
        lone_loops=lone_circles(
            [s.pursuer.turn_rate for s in samples], [s.leader.turn_rate for s in samples], EVERY
        )
        if loops > 0
        else 0,
        heading_jump_deg=_heading_jump(documents) / DEG,
        cross_track_m=_cross_track(documents, situation.wind, announced_only=False),
        off_announced_m=_cross_track(documents, situation.wind, announced_only=True),
        off_forecast_m=_off_forecast(documents),
        fastest_mps=max(s.pursuer.tas for s in samples),
        alerts=sum(isinstance(document, Alert | Unable) for document in documents),
        cpu_s=cpu,
        best_turn_share=best_turn(situation) / situation.min_separation
        if losses and engaged is None and losses[0].t_s < AHEAD
        else None,
    )


def _over_optimum(case: Case, optimum: Second | None, joined: Second | None) -> Second | None:
    """How much later it joined; `None` where it joined before the leader's last turn was over.

    The optimum is to the final leg: there it would be compared with another leg.
    """
    leader = case.scenario.situation.leader
    turned = sum(segment.length for segment in leader.trajectory.segments) / leader.tas
    if optimum is None or joined is None or joined < turned:
        return None
    return joined - optimum


def _why_not(documents: Sequence[Document]) -> str:
    """Why it has not joined: what guidance was unable to do, else how it ended and in what mode.

    One that flies on until it leaves the plane is unable once more there: what made it fly on
    counts.
    """
    last = documents[-1]
    assert isinstance(last, FlightEnded)
    left = ""
    for document in reversed(documents):
        match document:
            case Unable(t=t, reason=reason):
                left = left or f"unable: {reason}"
                if last.reason != "plane_left" or t < last.t:
                    return f"unable: {reason}"
            case PlanChanged():
                break
            case _:
                pass
    modes = [one.guidance[0].mode for one in reversed(documents) if isinstance(one, Sample)]
    return left or (f"{last.reason} in {modes[0]}" if modes else last.reason)


def _join_over_last_promise(changed: Sequence[PlanChanged], joined: Second | None) -> float | None:
    """From the plan last announced until joined, by what it promised; `None` without either."""
    made = [document for document in changed if document.announced]
    if joined is None or not made or made[-1].t >= joined or made[-1].promised <= 0.0:
        return None
    return (joined - made[-1].t) / made[-1].promised


def _heading_jump(documents: Iterable[Document]) -> float:
    """Largest change of the held heading between two samples with nothing said between [rad]."""
    largest, held, said = 0.0, None, False
    for document in documents:
        match document:
            case Sample(guidance=(GuidanceSample(reference=HeadingReference(heading=heading)),)):
                if held is not None and not said:
                    largest = max(largest, abs(wrap_signed(heading - held)))
                held, said = heading, False
            case Sample():
                held, said = None, False
            case LeaderRoute() | ForecastChanged() | PlanChanged(announced=False):
                pass
            case _:
                said = True
    return largest


def _cross_track(documents: Iterable[Document], wind: Wind, *, announced_only: bool) -> Metre:
    """Largest distance from the path of the last plan, until it ends or is no longer flown."""
    largest, made, ends = 0.0, 0.0, 0.0
    flown: Floats | None = None
    for document in documents:
        match document:
            case PlanChanged(t=t, plan=card, announced=announced):
                if announced_only and not announced:
                    continue
                flown, made, ends = path_in_air(card.segments, wind), t, t + card.time_to_converge
            case Sample(
                t=t, aircraft=(here, _), guidance=(GuidanceSample(mode="converge" | "capture"),)
            ) if flown is not None:
                if t <= ends:
                    since = t - made
                    x, y = here.x - wind.east * since, here.y - wind.north * since
                    largest = max(largest, distance_from(flown, x, y))
    return largest


def _off_forecast(documents: Iterable[Document]) -> Metre | None:
    """Largest distance from where the last forecast had the pursuer at that time, if any did."""
    largest: float | None = None
    forecast: ForecastChanged | None = None
    for document in documents:
        match document:
            case ForecastChanged():
                forecast = document
            case Sample(t=t, aircraft=(here, _)) if forecast and t <= forecast.times[-1]:
                x = float(np.interp(t, forecast.times, forecast.x))
                y = float(np.interp(t, forecast.times, forecast.y))
                largest = max(largest or 0.0, hypot(here.x - x, here.y - y))
            case _:
                pass
    return largest


def _orders(
    orders: tuple[tuple[Second, Command], ...],
) -> Callable[[Second], Iterable[Command]]:
    """Commands, each at its time."""
    left = list(orders)

    def due(t: Second) -> Iterable[Command]:
        now = []
        while left and left[0][0] <= t + 1e-9:
            now.append(left.pop(0)[1])
        return now

    return due


def _start_share(situation: Situation) -> float:
    pursuer, leader = situation.pursuer, situation.leader
    return hypot(pursuer.x - leader.x, pursuer.y - leader.y) / situation.min_separation

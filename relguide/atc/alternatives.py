"""suggest(situation, ask, picture, now): acceptable manoeuvres in place of one that is not.

Later starts, other paths, a larger D, other levels on the way: each is planned, made a manoeuvre,
and validated as the one that was asked for. None is offered that was not.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import cos, inf, sin
from time import perf_counter
from typing import Literal, NamedTuple, TypeVar

import numpy as np

from relguide.atc.cards import track_card
from relguide.atc.documents import AlternativeManoeuvre
from relguide.atc.picture import Picture
from relguide.atc.probe import SHOWN
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.atc.tracks import plan_track
from relguide.atc.validate import least_from_others, validate
from relguide.planning.aircraft import Leader, Traffic
from relguide.planning.alternatives import Alternative, alternatives
from relguide.planning.cells import Cell
from relguide.planning.heights import heights_of
from relguide.planning.intent import ChangeLevel, FlyStraight, IntentPiece
from relguide.planning.levels import changing_late, meanwhile
from relguide.planning.limits import DISTANCE
from relguide.planning.outcome import NoPlan, Plan
from relguide.planning.phrases import distance, duration
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.wind import Wind
from relguide.units import FT, NM, Metre, Second

LATER: tuple[Second, ...] = (30.0, 60.0, 120.0, 240.0)
"""How much later starts are tried [s], straight on until then."""
FARTHER: tuple[Metre, ...] = (1.0 * NM, 2.0 * NM, 4.0 * NM, 8.0 * NM)
"""By how much a larger D is tried [m]."""
OFFERED = 3
"""So many are offered at most."""
WITHIN: Second = 2.0
"""So long is tried [s]."""

AnyPlanner = Callable[[Situation], Plan | NoPlan]
_Aircraft = TypeVar("_Aircraft", Leader, Traffic)
_Change = Literal["later", "word", "spacing", "level"]


class _Try(NamedTuple):
    """A plan in place of the one that was asked for."""

    change: _Change
    message: str
    plan: Plan
    delay: Second


def suggest(
    situation: Situation,
    ask: Manoeuvre,
    picture: Picture,
    now: Second,
    settings: AtcSettings | None = None,
    *,
    planner: AnyPlanner = plan,
    within: Second = WITHIN,
) -> tuple[AlternativeManoeuvre, ...]:
    """Acceptable manoeuvres in place of one that is not, soonest first, at most `OFFERED`.

    Args:
        situation: of both aircraft now, in the plane of the picture.
        ask: what was asked for.
        picture: what it is validated on.
        now: in the clock of the picture [s].
        settings: minima, bounds and times.
        planner: what plans.
        within: how long may be tried; the one being tried is finished [s].
    """
    settings = settings or AtcSettings()
    until = perf_counter() + within
    found: list[AlternativeManoeuvre] = []
    for tried in _tries(situation, ask, planner):
        offered = _validated(tried, situation, ask, picture, now, settings)
        if offered is not None:
            found.append(offered)
        if perf_counter() > until:
            break
    return tuple(sorted(found, key=lambda one: one.joins)[:OFFERED])


def _validated(
    tried: _Try, situation: Situation, ask: Manoeuvre, picture: Picture, now: Second,
    settings: AtcSettings,
) -> AlternativeManoeuvre | None:  # fmt: skip
    path = plan_track(tried.plan, start=now + tried.delay, settings=settings)
    if tried.delay > 0.0:
        path = _led_in(path, situation, now)
    larger = tried.plan.situation.slot_distance / situation.slot_distance
    manoeuvre = replace(
        ask,
        path=path,
        joins=now + tried.delay + tried.plan.time_to_converge,
        spacing=ask.spacing * larger,
        word=tried.plan.word,
    )
    card = validate(manoeuvre, picture, now, settings)
    if card.verdict != "acceptable":
        return None
    least = least_from_others(card, ask.leader)
    return AlternativeManoeuvre(
        change=tried.change,
        message=f"{tried.message} It joins in {duration(manoeuvre.joins - now)}.",
        begins=tried.delay,
        word=tried.plan.word,
        spacing=tried.plan.situation.slot_distance,
        joins=manoeuvre.joins,
        least=least if least < inf else settings.minimum + SHOWN,
        route=track_card(path),
    )


def _tries(situation: Situation, ask: Manoeuvre, planner: AnyPlanner) -> Iterator[_Try]:
    """What is tried, cheapest to fly first."""
    for delay in LATER:
        begun = later(situation, delay)
        answer = begun and planner(begun)
        if isinstance(answer, Plan):
            yield _Try(
                "later", f"It begins {delay:.0f} s later, straight on till then.", answer, delay
            )
    first = planner(situation)
    if isinstance(first, Plan):
        yield from _other_paths(first, ask)
        yield from _other_levels(first, planner)
    for more in FARTHER:
        farther = situation.slot_distance + more
        if DISTANCE.admits(farther):
            answer = planner(replace(situation, slot_distance=farther))
            if isinstance(answer, Plan):
                yield _Try("spacing", f"It keeps {distance(farther)}.", answer, 0.0)


def _other_paths(first: Plan, ask: Manoeuvre) -> Iterator[_Try]:
    """The plan, if it was not asked for, and each other path that keeps d_min from the leader."""
    if first.word != ask.word:
        yield _Try("word", f"It flies {first.word} in place of {ask.word or 'that'}.", first, 0.0)
    for other in alternatives(first):
        if isinstance(other, Alternative):
            path = Plan.from_trajectory(
                other.candidate.trajectory, first.situation, planner=first.planner
            )
            if path.certificate.holds:
                message = f"It flies {other.word} in place of {ask.word or first.word}."
                yield _Try("word", message, replace(path, word=other.word), 0.0)


def _other_levels(first: Plan, planner: AnyPlanner) -> Iterator[_Try]:
    """Other levels on the way, where the levels of both are known."""
    situation = replace(first.situation, pursuer=replace(first.situation.pursuer, levels=()))
    own = situation.pursuer.altitude
    if own is None or heights_of(situation.leader).altitude is None:
        return
    for level in dict.fromkeys((own, *meanwhile(situation))):
        asked = changing_late(situation, level, first.time_to_converge)
        answer = asked and planner(asked)
        if isinstance(answer, Plan) and answer.levels != first.levels:
            yield _Try("level", f"It is at {level / FT:,.0f} ft until it joins.", answer, 0.0)


def later(situation: Situation, after: Second) -> Situation | None:
    """A situation some time on, if the pursuer flies straight; `None` if none can be planned then.

    Args:
        situation: now.
        after: how long from now [s].
    """
    pursuer, wind = situation.pursuer, situation.wind
    way = pursuer.tas * after
    moved = replace(
        pursuer,
        x=pursuer.x + way * sin(pursuer.heading) + wind.east * after,
        y=pursuer.y + way * cos(pursuer.heading) + wind.north * after,
        altitude=heights_of(pursuer).at(after),
        levels=tuple(
            replace(change, at=change.at - after) for change in pursuer.levels if change.at >= after
        ),
    )
    if len(moved.levels) < len(pursuer.levels):
        return None  # a change of level has begun by then
    try:
        return replace(
            situation,
            pursuer=moved,
            leader=_moved(situation.leader, after, wind),
            others=tuple(
                other.after(after) if isinstance(other, Cell) else _moved(other, after, wind)
                for other in situation.others
            ),
        )
    except ValueError:  # beyond the plane, or what is accepted
        return None


def _moved(aircraft: _Aircraft, after: Second, wind: Wind) -> _Aircraft:
    """An aircraft some time on, with what is left of its intent."""
    pose, heights = aircraft.trajectory.pose_at(after), heights_of(aircraft)
    left: list[IntentPiece] = []
    t, altitude = 0.0, heights.at(after)
    durations = iter(aircraft.trajectory.durations() if aircraft.intent else ())
    for piece in aircraft.intent:
        if isinstance(piece, ChangeLevel):
            if t >= after or altitude != piece.to_altitude:
                left.append(piece)
            continue
        ends = t + next(durations)
        if ends > after:
            rest = ends - max(after, t)
            left.append(replace(piece, duration=rest) if isinstance(piece, FlyStraight) else piece)
        t = ends
    return replace(
        aircraft,
        x=pose.x + wind.east * after,
        y=pose.y + wind.north * after,
        heading=pose.heading,
        altitude=altitude,
        intent=tuple(left),
    )


def _led_in(path: Track, situation: Situation, now: Second) -> Track:
    """A track that begins now, straight up to where it began."""
    return Track(
        t=np.append(now, path.t),
        x=np.append(situation.pursuer.x, path.x),
        y=np.append(situation.pursuer.y, path.y),
        low=np.append(path.low[0], path.low),
        high=np.append(path.high[0], path.high),
        error=path.error,
    )

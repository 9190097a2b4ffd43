"""The monitor: every second, in every mode, how far apart what is flown now will keep the aircraft.

It trusts the forecast for as long as both aircraft are where that has them. Else it flies ahead
anew: with the leader as it is expected to go on, and, while it turns unannounced or changes its
speed, with a leader that goes on doing so. All others are held against the same flight ahead. An
alert begins when separation would be lost within `caution` seconds, is a warning when it is lost,
and ends some seconds after its cause has.
"""

from math import inf
from typing import NamedTuple

from relguide.flying.belief import SEEMS, Belief
from relguide.flying.guidance.amid import Nearing, nearings
from relguide.flying.guidance.announcements import Alerted, AlertLevel, AlertState, Event
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.forecast import Forecast, forecast
from relguide.flying.guidance.memory import StandingAlert
from relguide.kernels.flight.guide import Course, Progress
from relguide.planning.phrases import distance
from relguide.units import Metre, MetrePerSecond, Second

MAY_DRIFT: Metre = 100.0
"""A leader whose velocity is uncertain may seem to drift so far from where it was expected [m]."""
URGENCY: dict[AlertState, int] = {"none": 0, "advisory": 1, "caution": 2, "warning": 3}
"""Levels in order."""


def highest(*standing: StandingAlert) -> AlertState:
    """The most urgent level of the alerts that stand."""
    return max((alert.level for alert in standing), key=URGENCY.__getitem__)


class Outlook(NamedTuple):
    """What lies ahead if nothing is done."""

    forecast: Forecast
    """With the leader as it is expected to go on."""
    least: Metre
    """Least separation, over all that is reckoned with [m]."""
    at: Second
    """When, flight time [s]."""
    breaks: Second
    """When d_min is lost first, flight time [s]; infinite if it is kept."""
    others: tuple[Nearing, ...] = ()
    """How near it comes to each of the others, the least spare first."""

    def pressing(self, t: Second, within: Second = inf) -> Nearing | None:
        """The first of the others whose minimum is lost ahead; `None` if all are kept.

        Args:
            t: flight time now [s].
            within: how far to look [s].
        """
        lost = [one for one in self.others if one.breaks < inf and one.breaks - t <= within]
        return min(lost, key=lambda one: one.breaks, default=None)


def is_as_forecast(ahead: Forecast, belief: Belief, assignment: Assignment) -> bool:
    """Whether both aircraft are where a forecast has them."""
    settings, t = assignment.settings, belief.t
    slack = 2.0 * belief.spread.wind * min(t - ahead.t, settings.caution)
    if (
        ahead.own_off(t, belief.own) > settings.own_off + slack
        or t + settings.caution > ahead.until
    ):
        return False
    return leader_is_as_forecast(ahead, belief, assignment)


def leader_is_as_forecast(ahead: Forecast, belief: Belief, assignment: Assignment) -> bool:
    """Whether the leader is where a forecast has it, on its heading and at its speed."""
    settings = assignment.settings
    off, turned, faster = ahead.leader_off(belief.t, belief.leader)
    drifted = SEEMS * belief.spread.velocity * (belief.t - ahead.t)
    return (
        off <= settings.leader_off + belief.place_slack + min(drifted, MAY_DRIFT)
        and turned <= settings.leader_turned + belief.heading_slack
        and faster <= settings.leader_speed + belief.speed_slack
    )


def look_out(
    belief: Belief,
    assignment: Assignment,
    progress: Progress,
    course: Course,
    trusted: Forecast | None,
    *,
    until: Second,
    turns_on: bool,
    trend: MetrePerSecond,
) -> Outlook:
    """What lies ahead.

    Args:
        belief: what is known now.
        assignment: what was asked.
        progress: how far guidance has come.
        course: the committed path.
        trusted: a forecast that still holds; `None` to fly ahead anew.
        until: how far to fly ahead anew, flight time [s].
        turns_on: whether the leader turns unannounced, and may go on.
        trend: how fast the leader changes its speed [m/s²]; 0 if it does not.
    """
    settings = assignment.settings
    ahead = trusted
    if ahead is None:
        ahead = forecast(belief, assignment, progress, course, until=until)
    least, at = ahead.rest(belief.t), belief.t
    breaks = ahead.breaks(belief.t, assignment.min_separation)
    if least < assignment.min_separation:
        least, at = ahead.least(belief.t, settings.watch)
    if turns_on or trend != 0.0:
        worse = forecast(
            belief,
            assignment,
            progress,
            course,
            until=belief.t + settings.caution,
            turns_on=turns_on,
            leader_tas=max(belief.leader.tas + trend * settings.speed_goes_on, 1.0),
        )
        other, when = worse.least(belief.t)
        breaks = min(breaks, worse.breaks(belief.t, assignment.min_separation))
        if other < least:
            least, at = other, when
    return Outlook(ahead, least, at, breaks, nearings(ahead, belief, assignment, turning_on=True))


def judge_separation(
    alert: StandingAlert, outlook: Outlook, belief: Belief, assignment: Assignment
) -> tuple[StandingAlert, tuple[Event, ...]]:
    """The alert that stands now, and what is said of it.

    Args:
        alert: the one of a second ago.
        outlook: what lies ahead.
        belief: gives the time, and the separation now.
        assignment: gives d_min.
    """
    t, limit, settings = belief.t, assignment.min_separation, assignment.settings
    apart = belief.separation
    level: AlertState = "none"
    if belief.counted_separation < limit:
        level = "warning"
    elif outlook.breaks - t <= settings.caution:
        level = "caution"
    alert, step = _next(alert, level, t, settings.clears_after)
    if step is None:
        return alert, ()
    said = Alerted(
        subject="separation",
        level=step.level,
        message="Separation is kept again."
        if step.cleared
        else _sentence(step.level, outlook, apart, t, limit),
        predicted_least=outlook.least if outlook.least < inf else apart,
        predicted_at=outlook.breaks if outlook.breaks < inf else outlook.at,
        cleared=step.cleared,
    )
    return alert, (said,)


def judge_data(
    alert: StandingAlert, belief: Belief, assignment: Assignment
) -> tuple[StandingAlert, tuple[Event, ...]]:
    """The alert that stands while nothing is heard of the leader, in every mode.

    Args:
        alert: the one of a second ago.
        belief: gives the age of the data, and the separation as it would be.
        assignment: gives how old they may be.
    """
    old = belief.leader_age > assignment.settings.flies_on_data_of
    alert, step = _next(alert, "caution" if old else "none", belief.t, 0.0)
    if step is None:
        return alert, ()
    age = belief.leader_age
    said = Alerted(
        subject="data",
        level=step.level,
        message="The leader is heard again."
        if step.cleared
        else f"Nothing was heard of the leader for {age:.0f} s: the separation is not known.",
        predicted_least=belief.separation,
        predicted_at=belief.t,
        cleared=step.cleared,
    )
    return alert, (said,)


def judge_others(
    standing: tuple[tuple[Nearing, StandingAlert], ...],
    outlook: Outlook,
    belief: Belief,
    assignment: Assignment,
) -> tuple[tuple[tuple[Nearing, StandingAlert], ...], tuple[Event, ...]]:
    """The alerts that stand on others now, and what is said of them.

    Args:
        standing: those of a second ago; one that need not be watched any more ends.
        outlook: what lies ahead.
        belief: gives the time.
        assignment: gives how far ahead an alert looks.
    """
    t, settings = belief.t, assignment.settings
    before = {near.ident: alert for near, alert in standing}
    stand, said = list[tuple[Nearing, StandingAlert]](), list[Event]()
    watched = {near.ident for near in outlook.others}
    for near, alert in standing:
        if near.ident not in watched and alert.level != "none":
            said.append(_of_other(near, _Step(alert.level, cleared=True), t))
    for near in outlook.others:
        level: AlertState = "none"
        if near.now < near.limit:
            level = "warning"
        elif near.breaks - t <= settings.caution:
            level = "caution"
        was = before.get(near.ident, StandingAlert())
        alert, step = _next(was, level, t, settings.clears_after)
        if alert.level != "none":
            stand.append((near, alert))
        if step is not None:
            said.append(_of_other(near, step, t))
    return tuple(stand), tuple(said)


class _Step(NamedTuple):
    """What is new of an alert."""

    level: AlertLevel
    """That begins or, when cleared, ends."""
    cleared: bool


def _next(
    alert: StandingAlert, level: AlertState, t: Second, clears_after: Second
) -> tuple[StandingAlert, _Step | None]:
    """The alert that stands now, and what is new of it; `None` if nothing is.

    Args:
        alert: the one of a second ago.
        level: what its cause asks for now.
        t: flight time [s].
        clears_after: so long after its cause it ends [s].
    """
    if level == "none":
        if alert.level == "none" or t - alert.seen < clears_after:
            return alert, None
        return StandingAlert(), _Step(alert.level, True)
    if URGENCY[level] < URGENCY[alert.level] and t - alert.seen < clears_after:
        return alert, None
    return StandingAlert(level, t), None if level == alert.level else _Step(level, False)


def _of_other(near: Nearing, step: _Step, t: Second) -> Alerted:
    return Alerted(
        subject="separation",
        level=step.level,
        message=f"{near.name}: the separation is kept again."
        if step.cleared
        else _other_sentence(step.level, near, t),
        predicted_least=min(near.least, near.apart),
        predicted_at=near.breaks if near.breaks < inf else near.at,
        cleared=step.cleared,
        ident=near.ident,
    )


def _sentence(level: AlertLevel, outlook: Outlook, apart: Metre, t: Second, limit: Metre) -> str:
    if level == "warning":
        return f"Separation: {distance(apart)}, less than {distance(limit)}."
    return (
        f"Separation in {max(outlook.breaks - t, 0.0):.0f} s: below {distance(limit)}, "
        f"down to {distance(outlook.least)}."
    )


def _other_sentence(level: AlertLevel, near: Nearing, t: Second) -> str:
    if near.is_cell:
        when = "now" if level == "warning" else f"in {max(near.breaks - t, 0.0):.0f} s"
        return f"{near.name}: inside {when}."
    if level == "warning":
        return f"{near.name}: {distance(near.now)}, less than {distance(near.limit)}."
    return (
        f"{near.name} in {max(near.breaks - t, 0.0):.0f} s: below {distance(near.limit)}, "
        f"down to {distance(near.least)}."
    )

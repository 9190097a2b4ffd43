"""Whether the leader flies what a manoeuvre was planned on, and whether its place can be kept."""

from math import atan2, hypot

import numpy as np

from relguide.atc.picture import Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.phrases import distance
from relguide.units import DEG, KT, Second


def disagreement(
    planned: Track, seen: Seen, now: Second, until: Second, settings: AtcSettings
) -> str:
    """How a leader is not what was planned on, in words; empty if it is.

    Places are compared over the whole time, exactly, as both tracks are straight between knots.
    Directions and speeds are compared at both ends: what they differ in between moves the place.

    Args:
        planned: the track that was planned on.
        seen: the leader in the picture.
        now: in the clock of the sky [s].
        until: how far ahead it matters [s].
        settings: how much may differ.
    """
    if seen.path is None:
        return _without_intent(planned, seen, now, until, settings)
    filed = seen.path
    knots = np.concatenate((planned.t, filed.t))
    times = np.unique(np.concatenate(([now, until], knots[(knots > now) & (knots < until)])))
    spare = planned.error + filed.error
    for t in times.tolist():
        apart = planned.distance(filed, t)
        if apart > settings.leader_place + spare:
            return f"is {distance(apart)} from there {_when(t, now)}"
    for t in (now, until):
        told = _other_velocity(planned.velocity(t), filed.velocity(t), settings)
        if told:
            return f"{told} {_when(t, now)}"
    return ""


def _without_intent(
    planned: Track, seen: Seen, now: Second, until: Second, settings: AtcSettings
) -> str:
    """The same of one that has filed no intent: it is to be on the track, and to go straight."""
    x, y = planned.place(seen.t)
    apart = hypot(x - seen.x, y - seen.y)
    if apart > settings.leader_place + planned.error:
        return f"is {distance(apart)} from there"
    flown = seen.ground_speed * np.sin(seen.track), seen.ground_speed * np.cos(seen.track)
    told = _other_velocity(planned.velocity(seen.t), flown, settings)
    if told:
        return told
    inside = planned.t[(planned.t > now) & (planned.t < until)]
    for t in (*inside.tolist(), until):
        if _other_velocity(planned.velocity(now), planned.velocity(t), settings):
            return f"has not filed the change of track or speed {_when(t, now)}"
    return ""


def _other_velocity(
    planned: tuple[float, float], flown: tuple[float, float], settings: AtcSettings
) -> str:
    """How one velocity is not another, in words; empty if it is."""
    turned = abs(wrap_signed(atan2(*flown) - atan2(*planned)))
    faster = hypot(*flown) - hypot(*planned)
    if turned > settings.leader_heading:
        return f"has a track {turned / DEG:.1f}° off it"
    if abs(faster) > settings.leader_speed:
        return f"is {abs(faster) / KT:.0f} kt {'faster' if faster > 0.0 else 'slower'}"
    return ""


def _when(t: Second, now: Second) -> str:
    return "now" if t <= now else f"in {t - now:.0f} s"


def lost_place(manoeuvre: Manoeuvre, until: Second, settings: AtcSettings) -> str:
    """How it does not keep its place behind its leader, in words; empty if it does.

    Args:
        manoeuvre: with both tracks.
        until: the end of what is looked at [s]; nothing is said if it has not joined by then.
        settings: how far from its place it may be.
    """
    if until < manoeuvre.joins:
        return ""
    own, leader = manoeuvre.path, manoeuvre.leader_path
    speed = hypot(*leader.velocity(until))
    by_time = manoeuvre.spacing_type == "time"
    behind = manoeuvre.spacing * (speed if by_time else 1.0)
    spare = settings.spacing_time.caution * speed if by_time else settings.spacing.caution
    # on a straight leg alone: round a turn the way behind the leader is not a distance
    east, north = leader.velocity(until - behind / max(speed, 1.0))
    if _other_velocity(leader.velocity(until), (east, north), settings):
        return ""
    apart = own.distance(leader, until)
    if abs(apart - behind) <= spare + own.error + leader.error:
        return ""
    return f"it is {distance(apart)} behind {manoeuvre.leader} then, not {distance(behind)}"

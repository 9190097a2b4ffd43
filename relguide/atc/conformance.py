"""Whether an aircraft flies what it is cleared to fly: in what it deviates, and since when.

A deviation begins above its threshold and ends below `CLEARS` of it. Where an aircraft is within
all cautions the monitor is silent, and what validation has added to its path holds.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import hypot

import numpy as np

from relguide.atc.documents import Deviation, DeviationKind
from relguide.atc.measured import in_level, on_path, to_leader, turning
from relguide.atc.off_path import heights, off_path
from relguide.atc.picture import Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.atc.turns import AwaitedTurn, await_turn
from relguide.units import Second

DEFAULTS = AtcSettings()


@dataclass(frozen=True, slots=True, kw_only=True)
class Memory:
    """What the monitor remembers of a flight; a new one remembers nothing."""

    seen: Second | None = None
    """When the aircraft was last seen [s]."""
    deviations: tuple[Deviation, ...] = ()
    """Those that stood then."""
    cautions: dict[DeviationKind, Second] = field(default_factory=dict)
    """Since when each kind is a caution or more [s]."""
    turn: AwaitedTurn | None = None
    """The turn that was to begin last."""


def watch(
    memory: Memory,
    seen: Seen,
    manoeuvre: Manoeuvre,
    leader: Seen | None,
    now: Second,
    settings: AtcSettings = DEFAULTS,
) -> tuple[Memory, tuple[Deviation, ...]]:
    """In what an aircraft deviates from what it is cleared to fly, each time that it is seen.

    Args:
        memory: of the last time; a new one at first, and for another manoeuvre.
        seen: the aircraft.
        manoeuvre: what it is cleared to fly.
        leader: its leader; `None` if it is not seen: then nothing is said of their spacing.
        now: time of the sky, which deviations are told by [s].
        settings: the thresholds.

    Returns:
        the memory for the next time, and the deviations that stand now. The same ones stand while
        the aircraft is not seen anew.
    """
    if memory.seen is not None and seen.t <= memory.seen:
        return memory, memory.deviations
    turn = await_turn(memory.turn, manoeuvre.path, seen)
    measured = (
        *on_path(seen, manoeuvre.path, settings),
        *to_leader(seen, manoeuvre, leader, settings),
        *in_level(seen, manoeuvre.path, settings),
        *turning(turn, seen, settings),
    )
    before = {one.subject: one for one in memory.deviations}
    cautions: dict[DeviationKind, Second] = {}
    deviations = []
    for one in measured:
        last = before.get(one.subject)
        level = one.level("none" if last is None else last.level)
        if level == "none":
            continue
        since = cautions[one.subject] = memory.cautions.get(one.subject, now)
        if level == "alert":
            since = last.since if last is not None and last.level == "alert" else now
        deviations.append(
            Deviation(
                subject=one.subject,
                level=level,
                amount=one.amount,
                unit=one.unit,
                since=since,
                message=one.message,
            )
        )
    memory = Memory(seen=seen.t, deviations=tuple(deviations), cautions=cautions, turn=turn)
    return memory, memory.deviations


def shown(
    deviations: Sequence[Deviation], now: Second, settings: AtcSettings = DEFAULTS
) -> tuple[Deviation, ...]:
    """Those that crews and the controller are shown: alerts, and cautions that last."""
    return tuple(
        one for one in deviations if one.level == "alert" or now - one.since >= settings.shown_after
    )


def gone(deviations: Sequence[Deviation], now: Second, settings: AtcSettings = DEFAULTS) -> bool:
    """Whether an alert has stood for so long that the aircraft is cleared no more."""
    return any(
        one.level == "alert" and now - one.since >= settings.back_within for one in deviations
    )


def still_covers(cleared: Manoeuvre, new: Track, settings: AtcSettings = DEFAULTS) -> bool:
    """Whether an aircraft on a new track stays within all cautions of what it is cleared to fly.

    Then a new plan needs no new clearance, and the cleared path remains the one that is watched.
    What is flown may stray from the new track by its error; that counts as well. Past the cleared
    path's end only the spacing counts.

    Args:
        cleared: what was accepted.
        new: what the aircraft is to fly from now on.
        settings: the thresholds.
    """
    path = cleared.path
    begin = max(new.begin, path.begin)
    knots = np.concatenate((np.arange(begin, path.end, 1.0), new.t, path.t))
    times = np.unique(knots[(knots >= begin) & (knots <= path.end)]).tolist()
    return all(_covers(path, new, t, settings) for t in times)


def _covers(path: Track, new: Track, t: Second, settings: AtcSettings) -> bool:
    """Whether a new track is within all cautions of a path at a time, its error included."""
    across, along = off_path(path, t, *new.place(t))
    speed = max(hypot(*path.velocity(t + along)), 1.0)
    (low, high), (new_low, new_high) = heights(path, t), heights(new, t)
    return (
        abs(across) + new.error <= settings.across.caution
        and abs(along) + new.error / speed <= settings.along.caution
        and new_low >= low - settings.level.caution
        and new_high <= high + settings.level.caution
    )

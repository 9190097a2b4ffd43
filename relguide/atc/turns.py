"""The turns of a track: when each begins, to which side, and whether an aircraft begins it.

A track has straight pieces, so its direction jumps at its knots. Jumps to one side that follow one
another within `GAP` are one turn.
"""

from typing import NamedTuple

import numpy as np

from relguide.atc.picture import Seen
from relguide.atc.track import Track
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.units import DEG, Radian, Second

SEEN: Radian = 5.0 * DEG
"""A turn is seen once the direction has changed by this: an aircraft on a straight stays within it
while it makes good what wind or surveillance put it aside."""
LEAST: Radian = 15.0 * DEG
"""Less is no turn that could be missed."""
GAP: Second = 20.0
"""Two turns are at least so far apart."""
_JUMP: Radian = 0.1 * DEG
"""Less is no jump, but the rounding of places."""


class Turn(NamedTuple):
    """A turn of a track."""

    begins: Second
    seen: Second
    """When the track itself has turned by `SEEN`."""
    ends: Second
    side: int
    """1 to the right, −1 to the left."""
    before: Radian
    """Direction before it."""
    after: Radian
    """… and behind it."""


class AwaitedTurn(NamedTuple):
    """What an aircraft makes of the turn of its path that was to begin last."""

    turns: tuple[Turn, ...]
    """All of its path."""
    turn: Turn | None
    """`None` before the first."""
    from_: Radian
    """Direction of the aircraft when the path's turn began."""
    begun: bool
    """Whether the aircraft turns, or flies as the path does behind the turn."""
    wrong: bool
    """Whether it turns to the other side."""


def await_turn(last: AwaitedTurn | None, track: Track, seen: Seen) -> AwaitedTurn:
    """What an aircraft makes of the turns of its track now.

    Args:
        last: of the last time; `None` at first: a turn that is under way then is taken as begun.
        track: what it is to fly.
        seen: the aircraft.
    """
    known = turns(track) if last is None else last.turns
    turn = next((one for one in reversed(known) if one.begins <= seen.t), None)
    if turn is None:
        return AwaitedTurn(known, None, 0.0, begun=False, wrong=False)
    from_ = seen.track if last is None or last.turn is not turn else last.from_
    begun = seen.t > turn.seen if last is None else last.turn is turn and last.begun
    moved = turn.side * wrap_signed(seen.track - turn.before)
    swung = turn.side * wrap_signed(seen.track - from_)
    rolled_out = seen.t >= turn.ends and abs(wrap_signed(seen.track - turn.after)) < SEEN
    begun = begun or rolled_out or max(moved, swung) >= SEEN
    return AwaitedTurn(known, turn, from_, begun=begun, wrong=swung <= -SEEN)


def turns(track: Track) -> tuple[Turn, ...]:
    """The turns of a track, in order of time."""
    directions = np.unwrap(np.arctan2(np.diff(track.x), np.diff(track.y)))
    jumps = np.diff(directions)
    found: list[Turn] = []
    turning: list[int] = []  # pieces before each jump of one turn
    for k in np.flatnonzero(np.abs(jumps) >= _JUMP).tolist():
        goes_on = bool(turning) and (
            jumps[k] * jumps[turning[0]] > 0.0 and track.t[k + 1] - track.t[turning[-1] + 1] <= GAP
        )
        if not goes_on:
            found += _turn(track, directions, turning)
            turning = []
        turning.append(k)
    return (*found, *_turn(track, directions, turning))


def _turn(track: Track, directions: np.ndarray, turning: list[int]) -> list[Turn]:
    """The turn of some jumps, if it is one."""
    if not turning:
        return []
    first, last = turning[0], turning[-1]
    turned = directions[first + 1 : last + 2] - directions[first]
    if abs(turned[-1]) < LEAST:
        return []
    side = 1 if turned[-1] > 0.0 else -1
    begins, ends = float(track.t[first + 1]), float(track.t[last + 1])
    # a piece has its direction in its middle; the last one is straight from the last jump on
    middles = 0.5 * (track.t[first + 1 : last + 1] + track.t[first + 2 : last + 2])
    times = np.concatenate(([begins], middles, [ends]))
    angles = np.concatenate(([0.0], side * turned[:-1], [side * turned[-1]]))
    return [
        Turn(
            begins=begins,
            seen=float(np.interp(SEEN, angles, times)),
            ends=ends,
            side=side,
            before=wrap(float(directions[first])),
            after=wrap(float(directions[last + 1])),
        )
    ]

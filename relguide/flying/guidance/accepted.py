"""Whether a proposal is the path that a crew has accepted, and how it is another one.

A crew calls ATC and looks outside before it engages. Meanwhile the aircraft flies on, and the same
path begins elsewhere, and later. It stays the same for as long as it leads to about the same places
seen from where it begins, and joins no later than the wait explains.
"""

from collections.abc import Iterator
from math import cos, hypot, sin

from relguide.flying.guidance.announcements import clock
from relguide.flying.guidance.memory import Announced
from relguide.flying.guidance.settings import Settings
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.phrases import compass
from relguide.planning.trajectory import Trajectory, heading_change
from relguide.units import DEG, Radian, Second

SHARES = (0.25, 0.5, 0.75, 1.0)
"""Where along their lengths two paths are compared."""
ELSEWHERE = 0.3
"""A path is another one if it leads so far from the accepted one there, as a share of what has been
flown: 17° to one side."""
A_TURN: Radian = 10.0 * DEG
"""A smaller turn corrects a heading [rad]."""
TURNS_ELSEWHERE: Radian = 15.0 * DEG
"""A first turn that ends on a heading so far off is named [rad]."""


def kept_branch(
    accepted: Announced, proposed: Announced | None, settings: Settings
) -> tuple[Trajectory, Second]:
    """Which path the next proposal is to be like, and how much slower it may be for that [s].

    Two ways round may be as fast: a crew that has accepted one of them is not offered them in turn.
    Step by step it is found again, however far the aircraft has come meanwhile.

    Args:
        accepted: what the crew said yes to.
        proposed: the last proposal; `None` if it is gone.
        settings: what is news to a crew.
    """
    left = accepted.joins - accepted.t
    stay = max(settings.shown_time, settings.shown_share * left)
    return (accepted if proposed is None else proposed).path, stay


def may_join_later(accepted: Announced, t: Second, settings: Settings) -> Second:
    """By how much later than it was accepted a path may join that begins at flight time t [s]."""
    left = accepted.joins - accepted.t
    return t - accepted.t + max(settings.unsettled_time, settings.unsettled_share * left)


def difference(accepted: Announced, now: Announced, settings: Settings) -> str:
    """How a proposal is another path than the accepted one, in a clause; empty if it is the same.

    Args:
        accepted: what the crew said yes to.
        now: the proposal, made at the same time or later.
        settings: how much later a path may join.
    """
    late = now.joins - accepted.joins
    if late <= may_join_later(accepted, now.t, settings) and not _leads_elsewhere(
        accepted.path, now.path
    ):
        return ""
    said = [*_turns_otherwise(accepted.path, now.path)]
    if abs(late) > settings.shown_time:
        said.append(f"joins {clock(abs(late))} {'later' if late > 0.0 else 'sooner'}")
    return ", ".join(said) or "leads elsewhere"


def _leads_elsewhere(one: Trajectory, other: Trajectory) -> bool:
    """Whether two paths lead to other places, each seen from its own beginning."""
    places = zip(SHARES, _places(one), _places(other), strict=True)
    return any(hypot(a[0] - b[0], a[1] - b[1]) > ELSEWHERE * share for share, a, b in places)


def _places(path: Trajectory) -> Iterator[tuple[float, float]]:
    """Places along a path, to the right and ahead of its beginning, in shares of its length."""
    across, along = cos(path.heading) / path.length, sin(path.heading) / path.length
    for share in SHARES:
        pose = path.pose_at(share * path.duration)
        east, north = pose.x - path.x, pose.y - path.y
        yield east * across - north * along, east * along + north * across


def _turns_otherwise(accepted: Trajectory, now: Trajectory) -> Iterator[str]:
    """What is new of its turns, in clauses."""
    before, after = _turns(accepted), _turns(now)
    if after and (not before or (before[0] > 0.0) != (after[0] > 0.0)):
        yield f"first turn to the {'right' if after[0] > 0.0 else 'left'}"
    elif before and after:
        was, then = accepted.heading + before[0], now.heading + after[0]
        if abs(wrap_signed(then - was)) > TURNS_ELSEWHERE:
            yield f"turns to {compass(then)}, not to {compass(was)}"
        elif len(before) != len(after):
            yield f"{len(after)} turns, not {len(before)}"
    elif before:
        yield "no turn"


def _turns(path: Trajectory) -> list[Radian]:
    """How far it turns, one turn after the other, positive to the right [rad]."""
    changes = map(heading_change, path.segments)
    return [change for change in changes if abs(change) > A_TURN]

"""What plans are asked for: all that fly, and what the assignment asks."""

from dataclasses import replace

from relguide.flying.belief import Belief
from relguide.flying.guidance.amid import others_after
from relguide.flying.guidance.assignment import Assignment
from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.heights import ALWAYS, Heights
from relguide.planning.intent import ChangeLevel, FlyStraight, IntentPiece, LevelChange, TurnTo
from relguide.planning.levels import levels_with
from relguide.planning.limits import MAX_PIECES
from relguide.planning.situation import Situation
from relguide.units import Metre, Second


def situation_now(belief: Belief, assignment: Assignment) -> Situation:
    """The situation as it is, with V_P and the bank of the plans."""
    own = belief.own
    pursuer = Pursuer(
        x=own.x,
        y=own.y,
        heading=wrap(own.heading),
        tas=assignment.planned_tas,
        max_bank=assignment.planned_bank,
    )
    leader = belief.leader_after(0.0)
    return situation_of(assignment, pursuer, leader, belief, assignment.min_separation)


def situation_of(
    assignment: Assignment,
    pursuer: Pursuer,
    leader: Leader,
    belief: Belief,
    min_separation: Metre,
    *,
    seconds: Second = 0.0,
    aside: Metre = 0.0,
) -> Situation:
    """Both aircraft with what the assignment asks, aimed at the place in the gate.

    Args:
        assignment: what was asked.
        pursuer: where the plan begins.
        leader: at the same time.
        belief: gives the others, and the wind.
        min_separation: to be kept from the leader [m].
        seconds: how long from now that is [s].
        aside: what is to be kept beside the minimum of each of the others [m].
    """
    if belief.intent_known and belief.counts != ALWAYS:
        pursuer, leader = _at_levels(pursuer, leader, belief, seconds)
    return Situation(
        pursuer=pursuer,
        leader=leader,
        slot_distance=assignment.aim,
        min_separation=min_separation,
        wind=belief.wind,
        others=others_after(belief, pursuer, seconds, aside),
    )


def _at_levels(
    pursuer: Pursuer, leader: Leader, belief: Belief, after: Second
) -> tuple[Pursuer, Leader]:
    """Both with their levels, and with the changes that they make; unchanged if one is too late."""
    own, heights = belief.own_heights.at(after), belief.leader_heights.at(after)
    changes = tuple(
        replace(change, at=max(change.at - after, 0.0))
        for change in belief.leader_heights.changes
        if change.to_altitude != heights
    )
    intent = _with_changes(leader, changes)
    if intent is None:
        return pursuer, leader
    leader = replace(leader, altitude=heights, intent=intent)
    levels = levels_with(Heights(altitude=heights, changes=changes), own)
    return replace(pursuer, altitude=own, levels=levels), leader


def _with_changes(
    leader: Leader, changes: tuple[LevelChange, ...]
) -> tuple[IntentPiece, ...] | None:
    """A leader's intent with changes of level at their times; `None` if it cannot be told so.

    One that begins in a turn begins as the turn ends. One behind the last turn would put off the
    leader's final leg.
    """
    left, t = list(changes), 0.0
    pieces: list[IntentPiece] = []
    durations = leader.trajectory.durations() if leader.intent else ()
    for piece, duration in zip(leader.intent, durations, strict=True):
        rest = piece
        while left and left[0].at < t + duration and isinstance(rest, FlyStraight):
            before = left[0].at - t
            if before > 0.0:
                pieces.append(FlyStraight(duration=before))
            t, duration = t + before, duration - before
            rest = FlyStraight(duration=duration)
            pieces.append(_piece(left.pop(0)))
        pieces.append(rest)
        t += duration
    turns = any(isinstance(piece, TurnTo) for piece in leader.intent)
    for change in left:
        if change.at > t and turns:
            return None
        if change.at > t:
            pieces.append(FlyStraight(duration=change.at - t))
            t = change.at
        pieces.append(_piece(change))
    return tuple(pieces) if len(pieces) <= MAX_PIECES else None


def _piece(change: LevelChange) -> ChangeLevel:
    return ChangeLevel(to_altitude=change.to_altitude, rate=change.rate, hold="tas")

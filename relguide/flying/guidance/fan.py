"""open_fan(memory, belief): where a pursuer joins a leader that may turn and has not said so.

While the leader's intent is not known, a plan assumes that it flies straight on. The fan says what
that is worth: when and where the pursuer would join if the leader began one of seven turns now, and
what it would save to know of such a turn a minute before it begins.

    saving of a turn = T(on the present path for a minute, then planned anew) − T(planned now)

Both join times are forecast by flying the closed loop ahead, so braking and rolling are in both.
Nothing is flown by it, and nothing is remembered but when it was said.
"""

from dataclasses import dataclass, replace

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.proposal import Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.memory import Memory
from relguide.kernels.base.angles import wrap
from relguide.kernels.flight.flight_records import Body
from relguide.kernels.flight.program import STRAIGHT, TURN
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.outcome import Planner
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.units import DEG, Metre, Radian, Second

TURNS: tuple[Radian, ...] = tuple(turn * DEG for turn in (-30, -20, -10, 0, 10, 20, 30))
"""Turns of the fan, to the left first [rad]."""
BANK: Radian = 25.0 * DEG
"""Bank of a leader's turn of which nothing is known: an airliner's [rad]."""
KNOWN_BEFORE: Second = 60.0
"""How long before the turn it would be known [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnedJoin:
    """Where the pursuer would join if the leader began a turn now."""

    turn: Radian
    """To the right of where the leader flies now [rad]."""
    joins: Second
    """When, flight time [s]."""
    x: Metre
    """East over the ground [m]."""
    y: Metre
    """North over the ground [m]."""
    least: Metre
    """Least separation on the way [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Fan:
    """What it is worth to know a leader's intent that is not known."""

    joins: tuple[TurnedJoin, ...] = ()
    """By the turn, left first; a turn after which there is no path is left out."""
    most_saved: Second = 0.0
    """By knowing the turn for which that saves the most `KNOWN_BEFORE` it begins [s]."""
    mean_saved: Second = 0.0
    """On average of all turns [s]."""


def is_uncertain(memory: Memory, belief: Belief, assignment: Assignment) -> bool:
    """Whether a path is proposed or flown on which the leader may turn without a word."""
    if belief.intent_known or belief.leader_age > assignment.settings.proposes_on_data_of:
        return False
    if memory.engagement == "engaged":
        return memory.mode == "converge" and memory.committed is not None
    return memory.proposed is not None


def open_fan(memory: Memory, belief: Belief, assignment: Assignment, planner: Planner) -> Fan:
    """The joins after each turn that has a path, and what knowing it would save.

    Args:
        memory: gives the path that is flown, if one is.
        belief: what is known now; `is_uncertain` holds.
        assignment: what was asked.
        planner: makes the plans; they are judged before they count.
    """
    flown = memory.committed if memory.engagement == "engaged" else None

    def find(known: Belief, before: Committed | None) -> Committed | None:
        found = propose(known, assignment, before, planner)
        return found.committed if isinstance(found, Proposal) else None

    straight = find(belief, flown) if flown is None else flown
    joins = list[TurnedJoin]()
    for turn in TURNS:
        path = find(_turning(belief, turn), flown) if turn != 0.0 else straight
        if path is not None and path.forecast.joins:
            joins.append(_join_of(turn, path, belief.t))
    saved = list[Second]()
    if straight is not None and straight.forecast.join_time > belief.t + KNOWN_BEFORE:
        later = _later(belief, straight)
        for turn in (turn for turn in TURNS if turn != 0.0):
            told = find(_turning(belief, turn, after=KNOWN_BEFORE), flown)
            untold = find(_turning(later, turn), None)
            if told is None or untold is None:
                continue
            if told.forecast.joins and untold.forecast.joins:
                saved.append(max(untold.forecast.join_time - told.forecast.join_time, 0.0))
    if not saved:
        return Fan(joins=tuple(joins))
    mean = sum(saved) / len(saved)
    return Fan(joins=tuple(joins), most_saved=max(saved), mean_saved=mean)


def _join_of(turn: Radian, path: Committed, t: Second) -> TurnedJoin:
    """Where and when a path joins by its forecast, and how close it comes from now on."""
    ahead = path.forecast
    least, _ = ahead.least(t)
    x, y = ahead.own[min(round(ahead.join_time - ahead.t), len(ahead.own) - 1), :2].tolist()
    return TurnedJoin(turn=turn, joins=ahead.join_time, x=x, y=y, least=least)


def _turning(belief: Belief, turn: Radian, *, after: Second = 0.0) -> Belief:
    """The same, where the leader is known to turn by so much after some time."""
    ahead = belief.leader_rolled_out + turn
    side = 1.0 if ahead > belief.leader.heading else -1.0
    rows, pieces = [[TURN, ahead, side * BANK]], list[IntentPiece]()
    if after > 0.0:
        rows.insert(0, [STRAIGHT, belief.t + after, 0.0])
        pieces.append(FlyStraight(duration=after))
    pieces.append(TurnTo(heading=wrap(ahead), turn=RIGHT if side > 0.0 else LEFT, bank=BANK))
    return replace(
        belief,
        intent=tuple(pieces),
        intent_known=True,
        program=np.array(rows),
        cursor=0,
        held=belief.leader_rolled_out,
        holds=belief.leader_rolled_out,
    )


def _later(belief: Belief, path: Committed) -> Belief:
    """What will be known in a minute, on that path and the leader still straight ahead."""
    t, ahead = belief.t + KNOWN_BEFORE, path.forecast
    k = ahead.row(t)
    own, leader = (Body(*rows[k].tolist()) for rows in (ahead.own, ahead.leader))
    others = tuple(other.later(KNOWN_BEFORE) for other in belief.others)
    cells = tuple(cell.after(KNOWN_BEFORE) for cell in belief.cells)
    return replace(belief, t=t, own=own, leader=leader, others=others, cells=cells)

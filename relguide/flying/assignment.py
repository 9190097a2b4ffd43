"""What the pursuer was asked to do, what it knows at one instant, and the situation of the two."""

from dataclasses import dataclass

from relguide.flying.aircraft import AircraftModel, AircraftState
from relguide.flying.capture import Slot
from relguide.planning.situation import (
    IntentPiece,
    Leader,
    Pursuer,
    Situation,
    TurnTo,
    Wind,
    final_heading,
)
from relguide.planning.slot import slot_frame
from relguide.units import DEG, Metre, MetrePerSecond, Radian, RadianPerSecond, Second

TURN_SEEN: RadianPerSecond = 0.3 * DEG  # a quarter of an airliner's: a turn, not a correction


@dataclass(frozen=True, slots=True, kw_only=True)
class Assignment:
    """What the pursuer was asked to do, and with what."""

    model: AircraftModel
    tas: MetrePerSecond
    """V_P, kept until the spacing closes [m/s]."""
    max_bank: Radian
    """φ_max of the plans [rad]."""
    slot_distance: Metre
    """D [m]."""
    min_separation: Metre
    """d_min [m]."""
    wind: Wind


@dataclass(frozen=True, slots=True, kw_only=True)
class Observation:
    """What the pursuer knows at one instant."""

    t: Second
    pursuer: AircraftState
    leader: AircraftState
    leader_turn_rate: RadianPerSecond
    """As observed [rad/s]."""
    intent: tuple[IntentPiece, ...]
    """The part of the leader's intent still to be flown; empty if unknown."""
    intent_known: bool

    @property
    def turn_to_come(self) -> bool:
        """Whether the leader's known intent has a turn that is not over."""
        return any(isinstance(piece, TurnTo) for piece in self.intent)

    @property
    def turning_unannounced(self) -> bool:
        """Whether the leader is turning and its intent does not say how far."""
        return not self.intent_known and abs(self.leader_turn_rate) > TURN_SEEN

    @property
    def final_heading(self) -> Radian:
        """The leader's heading on its final leg as far as is known, clockwise from north [rad]."""
        return final_heading(self.leader.heading, self.intent)


def situation_of(seen: Observation, assignment: Assignment, min_separation: Metre) -> Situation:
    """The situation now, to be planned for with V_P and this minimum separation [m]."""
    pursuer, leader = seen.pursuer, seen.leader
    return Situation(
        pursuer=Pursuer(
            x=pursuer.x,
            y=pursuer.y,
            heading=pursuer.heading,
            tas=assignment.tas,
            max_bank=assignment.max_bank,
        ),
        leader=Leader(
            x=leader.x, y=leader.y, heading=leader.heading, tas=leader.tas, intent=seen.intent
        ),
        slot_distance=assignment.slot_distance,
        min_separation=min_separation,
        wind=assignment.wind,
    )


def slot_of(situation: Situation) -> Slot:
    """The slot now, on the leader's final leg or its extension backward."""
    leader = situation.leader
    frame = slot_frame(situation, leader.trajectory)
    return Slot(frame.origin_x, frame.origin_y, frame.heading, leader.tas)

"""The leader in flight: by its own autopilot along its intent, or as it was recorded.

What it flies differs from what it declared only by its roll: the intent's turns begin when
declared, with half of the roll before that and half after. A recorded leader that is given a
command leaves its recording there and flies on under its own autopilot.
"""

from math import atan2, cos, hypot, pi, sin
from typing import Literal, NamedTuple, assert_never

from relguide.flying.aircraft import AircraftModel, AircraftState, roll_lead, step
from relguide.flying.autopilot import Autopilot, HoldHeading, Reference, TurnRate
from relguide.flying.tracks import RecordedTrack
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.turn import bank_for_turn_rate, turn_rate
from relguide.planning.situation import FlyStraight, IntentPiece, TurnTo, Wind
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.units import DEG, MetrePerSecond, Radian, Second

TurnChoice = Literal["left", "right", "shorter"]
"""Which way round to turn to a heading."""
ROLLED_OUT: Radian = 1.0 * DEG  # half of what joining accepts; the last degree takes 10 s
OVERSHOT: Radian = 5.0 * DEG  # so little past its heading, the leader is not to turn a full circle


class FlyingLeader(NamedTuple):
    """A leader under its own autopilot; a named tuple, as one is made each step."""

    state: AircraftState
    pieces: tuple[IntentPiece, ...]
    """The rest of its intent; the first piece is being flown."""
    since: Second
    """When that piece began, flight time [s]."""
    heading: Radian
    """The heading it is on, or turns away from [rad]."""
    tas: MetrePerSecond
    """The true airspeed that its autothrust holds [m/s]."""

    def remaining_intent(self, t: Second) -> tuple[IntentPiece, ...]:
        """The part of its intent still to be flown at flight time t [s]."""
        if not self.pieces:
            return ()
        first = self.pieces[0]
        match first:
            case FlyStraight():
                left = max(first.duration - (t - self.since), 0.0)
                return (FlyStraight(duration=left), *self.pieces[1:])
            case TurnTo():
                if _angle_left(first, self.state) > 2.0 * pi - OVERSHOT:
                    return self.pieces[1:]
                return self.pieces


class ReplayedLeader(NamedTuple):
    """A leader that does what was recorded."""

    state: AircraftState
    track: RecordedTrack

    def remaining_intent(self, t: Second) -> tuple[IntentPiece, ...]:
        """Nothing: a recording declares no intent."""
        return ()


LeaderFlight = FlyingLeader | ReplayedLeader


def leader_on_track(track: RecordedTrack, t: Second, wind: Wind) -> ReplayedLeader:
    """The leader as recorded at time t [s]; heading and airspeed follow from the wind."""
    x, y, chi, ground_speed, altitude = track.state_at(t)
    heading, tas = _air_velocity(chi, ground_speed, wind)
    _, _, later_chi, later_speed, _ = track.state_at(min(t + 1.0, track.duration))
    later, _ = _air_velocity(later_chi, later_speed, wind)
    rate = wrap_signed(later - heading)  # over one second
    bank = bank_for_turn_rate(tas, rate)
    return ReplayedLeader(state=AircraftState(x, y, heading, bank, 0.0, tas, altitude), track=track)


def advance_leader(
    leader: LeaderFlight,
    autopilot: Autopilot,
    t: Second,
    *,
    wind: Wind,
    duration: Second,
) -> LeaderFlight:
    """The leader a step later."""
    match leader:
        case ReplayedLeader():
            return leader_on_track(leader.track, min(t + duration, leader.track.duration), wind)
        case FlyingLeader():
            reference = _reference(leader, t, autopilot.model)
            state = step(
                autopilot.model,
                leader.state,
                aileron=autopilot.aileron(reference, leader.state, duration),
                commanded_tas=leader.tas,
                wind_east=wind.east,
                wind_north=wind.north,
                duration=duration,
            )
            return _next_piece(leader, state, t + duration)
        case _:
            assert_never(leader)


def turn_leader(
    leader: LeaderFlight, t: Second, heading: Radian, direction: TurnChoice, bank: Radian
) -> FlyingLeader:
    """The leader after an order to turn to a heading; its former intent is dropped."""
    change = wrap_signed(heading - leader.state.heading)
    turn: Turn = LEFT if direction == "left" or (direction == "shorter" and change < 0.0) else RIGHT
    return _leave_recording(leader, t)._replace(
        pieces=(TurnTo(heading=heading, turn=turn, bank=bank),),
        since=t,
    )


def set_leader_speed(leader: LeaderFlight, t: Second, tas: MetrePerSecond) -> FlyingLeader:
    """The leader after an order to fly at a true airspeed [m/s]."""
    return _leave_recording(leader, t)._replace(tas=tas)


def _leave_recording(leader: LeaderFlight, t: Second) -> FlyingLeader:
    match leader:
        case FlyingLeader():
            return leader
        case ReplayedLeader(state=state):
            return FlyingLeader(
                state=state, pieces=(), since=t, heading=state.heading, tas=state.tas
            )
        case _:
            assert_never(leader)


def _reference(leader: FlyingLeader, t: Second, model: AircraftModel) -> Reference:
    """The heading or turn of the piece being flown; the roll into the next turn begins early."""
    heading = leader.heading
    for i, piece in enumerate(leader.pieces):
        match piece:
            case FlyStraight():
                following = leader.pieces[i + 1 : i + 2]
                left = piece.duration - (t - leader.since) if i == 0 else piece.duration
                if not following or left > roll_lead(model, 0.0, _bank(following[0])):
                    return HoldHeading(heading)
            case TurnTo():
                angle, bank = _angle_left(piece, leader.state), _bank(piece)
                rate = turn_rate(leader.state.tas, bank)
                if angle < abs(rate) * roll_lead(model, bank, 0.0) or angle > 2.0 * pi - OVERSHOT:
                    return HoldHeading(piece.heading)
                return TurnRate(rate)
    return HoldHeading(heading)


def _next_piece(leader: FlyingLeader, state: AircraftState, t: Second) -> FlyingLeader:
    pieces, since, heading = leader.pieces, leader.since, leader.heading
    if pieces:
        first = pieces[0]
        match first:
            case FlyStraight():
                if t - since >= first.duration:
                    pieces, since = pieces[1:], since + first.duration
            case TurnTo():
                off = wrap_signed(state.heading - first.heading)
                if abs(off) < ROLLED_OUT:
                    pieces, since, heading = pieces[1:], t, first.heading
    return FlyingLeader(state=state, pieces=pieces, since=since, heading=heading, tas=leader.tas)


def _bank(piece: IntentPiece) -> Radian:
    match piece:
        case FlyStraight():
            return 0.0
        case TurnTo():
            return -piece.turn * piece.bank


def _angle_left(piece: TurnTo, state: AircraftState) -> Radian:
    """How far there is still to turn [rad], in [0, 2π)."""
    return wrap(-piece.turn * (piece.heading - state.heading))


def _air_velocity(
    track: Radian, ground_speed: MetrePerSecond, wind: Wind
) -> tuple[Radian, MetrePerSecond]:
    """Heading and true airspeed of an aircraft, from its velocity over the ground."""
    east = ground_speed * sin(track) - wind.east
    north = ground_speed * cos(track) - wind.north
    return wrap(atan2(east, north)), hypot(east, north)

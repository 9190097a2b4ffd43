"""What an aircraft declares that it will fly: straights, turns, changes of level, in order."""

from dataclasses import dataclass
from math import fmod, pi
from typing import Literal, assert_never

from relguide.kernels.base.angles import TWO_PI, turn_to
from relguide.kernels.base.turn import turn_radius
from relguide.planning.inputs import expect_within, number, text, turn_sign
from relguide.planning.limits import (
    ALTITUDE,
    BANK,
    COMPASS,
    DEGREES_MEANT,
    HEADING,
    MAX_PIECES,
    PIECE,
    VERTICAL_RATE,
)
from relguide.planning.reprs import as_code
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory, Turn
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

ROUNDED: Radian = 1e-6
"""A declared turn this close to a full one is none [rad]: headings that were kept as 32-bit numbers
are off by up to 3e-7. The rest is flown the other way round."""
SpeedRule = Literal["cas", "mach", "tas"]
"""What an aircraft keeps while its level changes. `cas` goes over to Mach number, and back, at the
crossover altitude of the two."""
SPEED_RULES: tuple[SpeedRule, ...] = ("cas", "mach", "tas")


def settle(piece: object, name: str, value: object) -> None:
    """Set a field of a frozen dataclass while it is being made."""
    object.__setattr__(piece, name, value)


def heading_in_degrees(name: str, degrees: object) -> Radian:
    """A direction given in degrees, within `COMPASS` [rad].

    Raises:
        ValueError: for what is no number, or lies outside.
    """
    return fmod(expect_within(name, degrees, *COMPASS), 360.0) * DEG


def expect_bank(name: str, value: object) -> Radian:
    """A bank angle in `BANK` [rad].

    Raises:
        ValueError: for what is no number, or lies outside.
    """
    bank = number(name, value)
    meant = DEGREES_MEANT if 0.5 * pi < bank <= BANK.high else ""
    expect_within(name, bank / DEG, BANK.low, BANK.high, BANK.unit, meant)
    return bank


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class FlyStraight:
    """A piece of intent: keep the heading for a while.

    Examples:
        >>> turns = rg.TurnTo(heading=2.4, turn=rg.RIGHT, bank=0.4)
        >>> in_a_minute = (rg.FlyStraight(duration=60.0), turns)
    """

    duration: Second
    """How long [s], ≥ 0."""
    kind: Literal["straight"] = "straight"

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a duration that is not one."""
        settle(self, "duration", expect_within("intent straight.duration", self.duration, *PIECE))


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class TurnTo:
    """A piece of intent: turn at constant bank to a heading, the way round that `turn` says.

    Examples:
        >>> rg.TurnTo.from_display(heading_deg=135, direction="right", bank_deg=20).turn == rg.RIGHT
        True
    """

    heading: Radian
    """Heading to roll out on, clockwise from north [rad]."""
    turn: Turn
    """`LEFT` or `RIGHT`."""
    bank: Radian
    """|φ| of the turn [rad]."""
    kind: Literal["turn"] = "turn"

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a turn that cannot be flown."""
        settle(self, "heading", expect_within("intent turn.heading", self.heading, *HEADING))
        settle(self, "turn", turn_sign("intent turn.turn", self.turn))
        settle(self, "bank", expect_bank("intent turn.bank", self.bank))

    @classmethod
    def from_display(
        cls, *, heading_deg: float, direction: Literal["left", "right"], bank_deg: float
    ) -> "TurnTo":
        """In degrees, with the direction as a word.

        Raises:
            ValueError: for what cannot be flown, or a direction that is neither.
        """
        if direction not in ("left", "right"):
            raise ValueError(f"direction must be 'left' or 'right', not {direction!r}.")
        turn = LEFT if direction == "left" else RIGHT
        heading = heading_in_degrees("heading_deg", heading_deg)
        return cls(heading=heading, turn=turn, bank=bank_deg * DEG)


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class ChangeLevel:
    """A piece of intent: begin to climb or descend to a level.

    It takes no time of its own: the pieces behind it are flown while the level changes. A later
    change takes the place of one that is not over.

    Examples:
        >>> rg.ChangeLevel(to_altitude=9_000.0, rate=7.5)
        ChangeLevel(to_altitude=9000.0, rate=7.5)
    """

    to_altitude: Metre
    """Pressure altitude to level off at [m]."""
    rate: MetrePerSecond
    """How fast to climb or to descend [m/s], > 0."""
    hold: SpeedRule = "cas"
    """What the aircraft keeps meanwhile."""
    kind: Literal["level_change"] = "level_change"

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a level or a rate that no aircraft flies."""
        for name, accepted in (("to_altitude", ALTITUDE), ("rate", VERTICAL_RATE)):
            settle(
                self,
                name,
                expect_within(f"intent level_change.{name}", getattr(self, name), *accepted),
            )
        if text("intent level_change.hold", self.hold) not in SPEED_RULES:
            raise ValueError(
                f"intent level_change.hold must be one of {', '.join(SPEED_RULES)}, "
                f"not {self.hold!r}."
            )


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class LevelChange:
    """A climb or a descent to a level, begun at a time: what a pursuer plans for itself.

    Examples:
        >>> climb = rg.LevelChange(at=30.0, to_altitude=10_668.0, rate=7.5)
        >>> own = rg.Pursuer(
        ...     x=0.0, y=0.0, heading=1.5, tas=230.0, max_bank=0.4,
        ...     altitude=9_449.0, levels=(climb,))
    """

    at: Second
    """When it begins [s], ≥ 0."""
    to_altitude: Metre
    """Pressure altitude to level off at [m]."""
    rate: MetrePerSecond
    """How fast [m/s], > 0."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a time, a level or a rate that no aircraft flies."""
        for name, accepted in (("at", PIECE), ("to_altitude", ALTITUDE), ("rate", VERTICAL_RATE)):
            checked = expect_within(f"level change.{name}", getattr(self, name), *accepted)
            settle(self, name, checked)


IntentPiece = FlyStraight | TurnTo | ChangeLevel


def expect_intent(name: str, value: object) -> tuple[IntentPiece, ...]:
    """The pieces of an intent, a list of them as well.

    Raises:
        ValueError: for anything else, and for more than `MAX_PIECES`.
    """
    if not isinstance(value, tuple | list):
        raise ValueError(f"{name} must be a tuple of FlyStraight, TurnTo and ChangeLevel.")
    if len(value) > MAX_PIECES:
        raise ValueError(f"{name} must have at most {MAX_PIECES} pieces, not {len(value)}.")
    for i, piece in enumerate(value):
        if not isinstance(piece, IntentPiece):
            raise ValueError(f"{name}[{i}] must be a FlyStraight, a TurnTo or a ChangeLevel.")
    return tuple(value)


def expect_levels(name: str, value: object) -> tuple[LevelChange, ...]:
    """Changes of level in order of time, a list of them as well.

    Raises:
        ValueError: for anything else, and for more than `MAX_PIECES`.
    """
    if not isinstance(value, tuple | list) or len(value) > MAX_PIECES:
        raise ValueError(f"{name} must be a tuple of at most {MAX_PIECES} LevelChange.")
    for i, change in enumerate(value):
        if not isinstance(change, LevelChange):
            raise ValueError(f"{name}[{i}] must be a LevelChange.")
        if i and change.at < value[i - 1].at:
            raise ValueError(f"{name}[{i}] must not begin before the one in front of it.")
    return tuple(value)


def final_heading(heading: Radian, intent: tuple[IntentPiece, ...]) -> Radian:
    """Where an intent leads from a heading, clockwise from north [rad]."""
    turns = [piece.heading for piece in intent if isinstance(piece, TurnTo)]
    return turns[-1] if turns else heading


def declared_path(
    x: Metre, y: Metre, heading: Radian, tas: MetrePerSecond, intent: tuple[IntentPiece, ...]
) -> Trajectory:
    """What an aircraft with an intent flies in the air mass; its last heading goes on for ever.

    Args:
        x: east, at t = 0 [m].
        y: north [m].
        heading: clockwise from north [rad].
        tas: true airspeed [m/s].
        intent: its pieces to come. Changes of level leave this path as it is.
    """
    segments: list[Arc | Straight] = []
    toward = heading
    for piece in intent:
        match piece:
            case FlyStraight():
                segments.append(Straight(length=tas * piece.duration))
            case TurnTo():
                # LEFT (+1) lowers the compass heading; to the present heading is no turn
                turn, angle = piece.turn, turn_to(-piece.turn * (piece.heading - toward))
                if TWO_PI - angle < ROUNDED:
                    turn, angle = RIGHT if turn == LEFT else LEFT, TWO_PI - angle
                radius = turn_radius(tas, piece.bank)
                segments.append(Arc(turn=turn, turn_angle=angle, radius=radius))
                toward = piece.heading
            case ChangeLevel():
                pass
            case _:
                assert_never(piece)
    return Trajectory(x=x, y=y, heading=heading, tas=tas, segments=tuple(segments))

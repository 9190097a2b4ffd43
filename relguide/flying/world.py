"""The world as it begins: aircraft, the air they fly in, and who is to join whom."""

from dataclasses import dataclass
from typing import Literal

from relguide.flying.air import STANDARD_AIR, Air
from relguide.flying.airframe import Airframe
from relguide.flying.guidance.settings import DEFAULT, Settings
from relguide.flying.tracks import RecordedTrack
from relguide.planning.situation import IntentPiece
from relguide.units import Metre, MetrePerSecond, Radian, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Guided:
    """Flies what its guidance asks for."""

    kind: Literal["guided"] = "guided"


@dataclass(frozen=True, slots=True, kw_only=True)
class Declared:
    """Flies an intent, then straight on."""

    intent: tuple[IntentPiece, ...] = ()
    kind: Literal["declared"] = "declared"


@dataclass(frozen=True, slots=True, kw_only=True)
class Recorded:
    """Flies as it was recorded."""

    track: RecordedTrack
    kind: Literal["recorded"] = "recorded"


Pilot = Guided | Declared | Recorded


@dataclass(frozen=True, slots=True, kw_only=True)
class Aircraft:
    """One aircraft as it begins."""

    ident: str
    airframe: Airframe
    """How it rolls, and changes speed."""
    aircraft_type: str
    """ICAO designator, as shown."""
    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    heading: Radian
    """Clockwise from north [rad]."""
    tas: MetrePerSecond
    """True airspeed [m/s]."""
    altitude: Metre
    """[m]."""
    max_bank: Radian
    """What its autopilot may use [rad]."""
    pilot: Pilot
    believed: Airframe | None = None
    """What its guidance believes of the airframe; the truth, if left out."""

    @property
    def known_airframe(self) -> Airframe:
        """The airframe as guidance knows it."""
        return self.believed or self.airframe


@dataclass(frozen=True, slots=True, kw_only=True)
class Link:
    """Who is to join whom, and how."""

    pursuer: str
    """Ident of a guided aircraft."""
    leader: str
    """Ident of another aircraft."""
    slot_distance: Metre
    """D [m]."""
    min_separation: Metre
    """d_min [m]."""
    spacing: Second = 0.0
    """Time behind the leader to keep once joined [s]; 0 to keep D."""
    intent_known: bool = True
    """Whether the pursuer knows the leader's intent."""
    declared_intent: tuple[IntentPiece, ...] | None = None
    """What the leader declared, if that is not what it flies: a leader that breaks its word."""


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """All that flies."""

    aircraft: tuple[Aircraft, ...]
    links: tuple[Link, ...]
    air: Air = STANDARD_AIR
    """What physics asks."""
    believed_air: Air | None = None
    """What guidance believes; the same if left out."""
    settings: Settings = DEFAULT

    def __post_init__(self) -> None:
        """Refuse links between aircraft that are not there."""
        idents = [aircraft.ident for aircraft in self.aircraft]
        if len(set(idents)) != len(idents):
            raise ValueError("Each aircraft must have an ident of its own.")
        for link in self.links:
            for ident in (link.pursuer, link.leader):
                if ident not in idents:
                    raise ValueError(f"There is no aircraft {ident!r} to link.")
            if link.pursuer == link.leader:
                raise ValueError(f"{link.pursuer!r} cannot follow itself.")

    def index(self, ident: str) -> int:
        """Which of the aircraft has an ident."""
        return [aircraft.ident for aircraft in self.aircraft].index(ident)

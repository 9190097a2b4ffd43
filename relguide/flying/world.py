"""The world as it begins: aircraft, the air they fly in, and who is to join whom."""

from dataclasses import dataclass
from typing import Literal

from relguide.flying.air import STANDARD_AIR, Air
from relguide.flying.airframe import Airframe
from relguide.flying.envelope import envelope_fault
from relguide.flying.guidance.settings import DEFAULT, Settings
from relguide.flying.pilot_model import PilotModel
from relguide.flying.slots import refuse_taken
from relguide.flying.surveillance import EXACT, Surveillance
from relguide.flying.tracks import RecordedTrack
from relguide.planning.aircraft import expect_distance, expect_ident
from relguide.planning.cells import Cell
from relguide.planning.inputs import Range, expect, expect_within, text, truth
from relguide.planning.intent import IntentPiece, expect_bank, expect_intent
from relguide.planning.limits import (
    ALTITUDE,
    CLEARANCE,
    HEADING,
    POSITION,
    SPACING,
    TAS,
    too_close_a_slot,
)
from relguide.units import DEG, Kilogram, Metre, MetrePerSecond, Radian, Second

BANK_IN_RESERVE: Radian = 5.0 * DEG
"""An autopilot may bank by so much more than its plans turn with, where its type allows it."""
EDGE: Metre = 2_000.0
"""So near the edge of the plane a flight ends: before plans are refused for it [m]."""
FLOWN_POSITION = Range(POSITION.low + EDGE, POSITION.high - EDGE, POSITION.unit)
"""Where aircraft fly."""
RANGES = {
    "x": FLOWN_POSITION,
    "y": FLOWN_POSITION,
    "heading": HEADING,
    "tas": TAS,
    "altitude": ALTITUDE,
}
"""What is accepted of an aircraft's numbers, beside its bank."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Guided:
    """Flies what its guidance asks for.

    Examples:
        >>> rg.Guided(by_hand=rg.PilotModel()).by_hand.delay  # [s]
        0.3
    """

    by_hand: PilotModel | None = None
    """The pilot that flies it by hand along the flight director's bar; `None`: the autopilot does,
    until its crew takes control."""
    kind: Literal["guided"] = "guided"

    def __post_init__(self) -> None:
        """Refuse what is no pilot."""
        if self.by_hand is not None:
            expect("by_hand", self.by_hand, PilotModel)


@dataclass(frozen=True, slots=True, kw_only=True)
class Declared:
    """Flies an intent, then straight on.

    Examples:
        >>> turns = rg.TurnTo(heading=2.4, turn=rg.RIGHT, bank=0.4)
        >>> honest, breaks_its_word = rg.Declared(intent=(turns,)), rg.Declared(declares=(turns,))
    """

    intent: tuple[IntentPiece, ...] = ()
    declares: tuple[IntentPiece, ...] | None = None
    """What it declares to those that keep clear of it, if that is not what it flies: it breaks its
    word."""
    kind: Literal["declared"] = "declared"

    def __post_init__(self) -> None:
        """Refuse what is no intent."""
        object.__setattr__(self, "intent", expect_intent("intent", self.intent))
        if self.declares is not None:
            object.__setattr__(self, "declares", expect_intent("declares", self.declares))


@dataclass(frozen=True, slots=True, kw_only=True)
class Recorded:
    """Flies as it was recorded.

    Examples:
        >>> from pathlib import Path
        >>> _ = Path("one.scn").write_text("00:00:00>CRE KL204 A320 52.0,4.0 90 FL310 280")
        >>> rg.Recorded(track=rg.load_track("one.scn")).track.aircraft_type
        'A320'
    """

    track: RecordedTrack
    kind: Literal["recorded"] = "recorded"

    def __post_init__(self) -> None:
        """Refuse what is no recording."""
        expect("track", self.track, RecordedTrack)


Pilot = Guided | Declared | Recorded


@dataclass(frozen=True, slots=True, kw_only=True)
class Aircraft:
    """One aircraft as it begins.

    Examples:
        >>> own = rg.Aircraft(
        ...     ident="OWN", airframe=rg.airframe("A306"), aircraft_type="A306", pilot=rg.Guided(),
        ...     x=-40e3, y=20e3, heading=1.5, tas=230.0, altitude=9_449.0, max_bank=0.4)
        >>> round(own.autopilot_bank, 2)  # [rad]
        0.49
    """

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
    """Pressure altitude [m]."""
    max_bank: Radian
    """What its plans turn with [rad]."""
    pilot: Pilot
    weight: Kilogram = 0.0
    """[kg]; 0 for the reference weight of its airframe."""
    believed: Airframe | None = None
    """What its guidance believes of the airframe; the truth, if left out."""
    min_separation: Metre | None = None
    """How near pursuers may come to it that do not follow it [m]; the d_min of their link, if left
    out."""

    def __post_init__(self) -> None:
        """Refuse what cannot be an aircraft in the air."""
        if not text("ident", self.ident).strip():
            raise ValueError("ident must not be empty.")
        expect("airframe", self.airframe, Airframe)
        text("aircraft_type", self.aircraft_type)
        for name, accepted in RANGES.items():
            value = expect_within(name, getattr(self, name), *accepted)
            object.__setattr__(self, name, value)
        object.__setattr__(self, "max_bank", expect_bank("max_bank", self.max_bank))
        self.airframe.expect_weight("weight", self.weight)
        expect("pilot", self.pilot, Guided, Declared, Recorded)
        if self.believed is not None:
            expect("believed", self.believed, Airframe)
        if self.min_separation is not None:
            kept = expect_distance("min_separation", self.min_separation)
            object.__setattr__(self, "min_separation", kept)

    @property
    def autopilot_bank(self) -> Radian:
        """What its autopilot may use, to stay on a path that turns at `max_bank` [rad]."""
        return min(self.airframe.max_bank, self.max_bank + BANK_IN_RESERVE)

    @property
    def known_airframe(self) -> Airframe:
        """The airframe as guidance knows it."""
        return self.believed or self.airframe


@dataclass(frozen=True, slots=True, kw_only=True)
class Link:
    """Who is to join whom, and how.

    Examples:
        >>> link = rg.Link(pursuer="OWN", leader="A", slot_distance=10e3, min_separation=9_260.0)
        >>> link.intent_known
        True
    """

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

    def __post_init__(self) -> None:
        """Refuse distances that contradict each other, and what is no text or truth value."""
        text("pursuer", self.pursuer)
        text("leader", self.leader)
        for name in ("slot_distance", "min_separation"):
            object.__setattr__(self, name, expect_distance(name, getattr(self, name)))
        if not CLEARANCE.admits(self.slot_distance - self.min_separation):
            wrong = too_close_a_slot(self.slot_distance, self.min_separation)
            raise ValueError(f"slot_distance {wrong}")
        object.__setattr__(self, "spacing", expect_within("spacing", self.spacing, *SPACING))
        truth("intent_known", self.intent_known)
        if self.declared_intent is not None:
            declared = expect_intent("declared_intent", self.declared_intent)
            object.__setattr__(self, "declared_intent", declared)


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """All that flies.

    Examples:
        >>> leader = rg.Aircraft(
        ...     ident="A", airframe=rg.airframe("A306"), aircraft_type="A306", pilot=rg.Declared(),
        ...     x=0.0, y=0.0, heading=1.5, tas=200.0, altitude=9_449.0, max_bank=0.4)
        >>> alone = rg.World(aircraft=(leader,), links=(), air=rg.Air(wind=rg.Wind(east=20.0)))
    """

    aircraft: tuple[Aircraft, ...]
    links: tuple[Link, ...]
    air: Air = STANDARD_AIR
    """What physics asks."""
    believed_air: Air | None = None
    """What guidance believes at the start, before it has measured the wind; the truth, if left
    out."""
    surveillance: Surveillance = EXACT
    """How pursuers see their leaders, and all others."""
    settings: Settings = DEFAULT
    cells: tuple[Cell, ...] = ()
    """Weather that pursuers keep out of, as it is at the start."""

    def __post_init__(self) -> None:
        """Refuse links to aircraft that do not fly, pursuers without guidance, and taken slots."""
        object.__setattr__(self, "aircraft", _all_of("aircraft", self.aircraft, Aircraft))
        object.__setattr__(self, "links", _all_of("links", self.links, Link))
        expect("air", self.air, Air)
        if self.believed_air is not None:
            expect("believed_air", self.believed_air, Air)
        expect("surveillance", self.surveillance, Surveillance)
        expect("settings", self.settings, Settings)
        object.__setattr__(self, "cells", _all_of("cells", self.cells, Cell))
        flying = {aircraft.ident: aircraft for aircraft in self.aircraft}
        if len(flying) < len(self.aircraft):
            raise ValueError("Each aircraft must have an ident of its own.")
        self._expect_others(flying)
        for link in self.links:
            for ident in (link.pursuer, link.leader):
                if ident not in flying:
                    raise ValueError(
                        f"There is no aircraft {ident!r} to link: there are {', '.join(flying)}."
                    )
            if link.pursuer == link.leader:
                raise ValueError(f"{link.pursuer!r} cannot follow itself: choose another leader.")
            self._expect_guided(flying[link.pursuer])
        if len({link.pursuer for link in self.links}) < len(self.links):
            raise ValueError("Each pursuer must have one link: it joins one leader.")
        refuse_taken(self.links, {ident: one.tas for ident, one in flying.items()})

    def _expect_others(self, flying: dict[str, Aircraft]) -> None:
        """Refuse names that plans amid others cannot tell apart or show."""
        idents = [*flying, *(cell.ident for cell in self.cells)]
        if len(set(idents)) < len(idents):
            raise ValueError("Each cell must have an ident of its own, which no aircraft has.")
        if self.links and len(idents) > 2:
            for ident in idents:
                expect_ident("ident", ident)

    def _expect_guided(self, pursuer: Aircraft) -> None:
        if not isinstance(pursuer.pilot, Guided):
            raise ValueError(f"The pilot of {pursuer.ident!r} must be Guided() to join a leader.")
        fault = envelope_fault(
            pursuer.airframe,
            pursuer.altitude,
            self.air,
            tas=pursuer.tas,
            bank=pursuer.max_bank,
            weight=pursuer.weight,
        )
        if fault:
            raise ValueError(fault)

    @property
    def perceives(self) -> bool:
        """Whether guidance has to find out what it knows; if not, it sees the truth."""
        inexact = self.surveillance.kind != "exact" or self.air.gusts > 0.0
        return inexact or self.believed_air not in (None, self.air)

    def index(self, ident: str) -> int:
        """Which of the aircraft has an ident."""
        return [aircraft.ident for aircraft in self.aircraft].index(ident)


def kept_from(other: Aircraft, link: Link) -> Metre:
    """How near the pursuer of a link may come to another aircraft that it does not follow [m]."""
    return link.min_separation if other.min_separation is None else other.min_separation


def _all_of(name: str, values: object, kind: type) -> tuple[object, ...]:
    """A tuple of one kind of things; a list of them as well."""
    if not isinstance(values, tuple | list):
        raise ValueError(f"{name} must be a tuple of {kind.__name__}.")
    for i, value in enumerate(values):
        expect(f"{name}[{i}]", value, kind)
    return tuple(values)

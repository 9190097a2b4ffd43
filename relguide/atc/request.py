"""What a crew asks for: to capture its place behind a leader, and to maintain it."""

from dataclasses import dataclass
from typing import Literal

from relguide.atc.track import Track
from relguide.units import Metre, Radian, Second

SpacingType = Literal["distance", "time"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Manoeuvre:
    """A convergence as it will be flown, from its beginning until some time behind its leader."""

    ident: str
    """Who flies it."""
    leader: str
    """Behind whom."""
    spacing_type: SpacingType
    """What it keeps once joined."""
    spacing: float
    """D [m], or the time behind the leader [s]."""
    min_separation: Metre
    """d_min from the leader [m]."""
    path: Track
    """What will be flown: a forecast with rolls and braking, not the ideal plan."""
    joins: Second
    """When it is in its place [s]."""
    leader_path: Track
    """What the leader is expected to fly: the path was planned on it."""
    word: str = ""
    """Letters of the plan, e.g. `LSR`; empty where they are not known."""
    bank: Radian = 0.0
    """The bank that its turns need [rad]; 0 where it is not known."""
    max_bank: Radian = 0.0
    """The bank that the aircraft has [rad]; 0 where it is not known."""

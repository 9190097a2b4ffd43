"""The picture of a sky: all that fly in it, and the airspaces that nobody may enter."""

from dataclasses import dataclass

from relguide.atc.track import Track
from relguide.units import Metre, MetrePerSecond, Radian, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Seen:
    """An aircraft as it was last seen."""

    ident: str
    t: Second
    """When it was seen, in the time of its sky [s]."""
    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    track: Radian
    """Direction of its ground velocity, clockwise from north [rad]."""
    ground_speed: MetrePerSecond
    """[m/s]"""
    altitude: Metre | None = None
    """Pressure altitude [m]; `None` where it is not known: then height keeps nothing apart."""
    climb: MetrePerSecond = 0.0
    """Vertical speed, positive up [m/s]."""
    path: Track | None = None
    """What it intends to fly; `None` where it has not said so: it is then expected within a fan."""
    cleared: bool = False
    """Whether that path is one that was accepted: it may stray from it as conformance allows."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Airspace:
    """A part of a sky that is closed: a polygon, between two heights, for a time."""

    ident: str
    x: tuple[Metre, ...]
    """Of its corners in turn, east [m]; the polygon need not be convex."""
    y: tuple[Metre, ...]
    """… and north [m]."""
    low: Metre
    """Pressure altitude of its floor [m]; -inf: from the ground."""
    high: Metre
    """… and of its ceiling [m]; inf: without one."""
    since: Second
    """From when it is closed [s]; -inf: always."""
    until: Second
    """Until when [s]; inf: always."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A sky at one time."""

    as_of: Second
    """When it was put together [s]: what is older than `AtcSettings.stale` is not relied on."""
    aircraft: tuple[Seen, ...]
    """Each ident once."""
    airspaces: tuple[Airspace, ...] = ()

    def find(self, ident: str) -> Seen | None:
        """The aircraft of that ident; `None` if it is not seen."""
        return next((one for one in self.aircraft if one.ident == ident), None)

"""Places in a queue: how far behind its head each pursuer is to fly, and which are taken.

A leader that is a pursuer itself has a slot behind its own leader. So every slot is so far behind
the first aircraft of its line, and two of one line may not be nearer than their minimum.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol, TypeVar

from relguide.planning.phrases import distance
from relguide.units import Metre, MetrePerSecond, Second

ROUNDED: Metre = 1e-6
"""Sums of distances that differ by less are equal [m]."""


class Claim(Protocol):
    """What a link asks for."""

    @property
    def pursuer(self) -> str:
        """Its ident."""
        ...

    @property
    def leader(self) -> str:
        """Its ident."""
        ...

    @property
    def slot_distance(self) -> Metre:
        """D [m]."""
        ...

    @property
    def min_separation(self) -> Metre:
        """d_min [m]."""
        ...

    @property
    def spacing(self) -> Second:
        """Time to keep once joined [s]; 0 to keep D."""
        ...


AnyClaim = TypeVar("AnyClaim", bound=Claim)


class Place(NamedTuple):
    """A slot, counted from the first aircraft of its line."""

    head: str
    """Its ident."""
    joining: Metre
    """How far behind it the pursuer joins [m]."""
    keeping: Metre
    """… and flies from then on, at the speed that the head began with [m]."""


def line_of(claim: AnyClaim, claims: Sequence[AnyClaim]) -> tuple[AnyClaim, ...]:
    """A link and those of the aircraft ahead of it, the one behind the head first.

    Raises:
        ValueError: if they go round in a circle.
    """
    by_pursuer, line = {one.pursuer: one for one in claims}, [claim]
    while line[0].leader in by_pursuer:
        ahead = by_pursuer[line[0].leader]
        if ahead in line:
            circle = " behind ".join(one.pursuer for one in (*reversed(line), ahead))
            raise ValueError(f"A queue must have a head that follows none of it: {circle}.")
        line.insert(0, ahead)
    return tuple(line)


def refuse_taken(claims: Sequence[Claim], speeds: Mapping[str, MetrePerSecond]) -> None:
    """Refuse a slot that is too near to one that another pursuer is to take.

    Args:
        claims: in order; the later of two gives way.
        speeds: true airspeeds of all aircraft by ident [m/s].

    Raises:
        ValueError: it names the pursuer that is to take it, and says where there is room.
    """
    places = [_place(claim, claims, speeds) for claim in claims]
    for k, (claim, place) in enumerate(zip(claims, places, strict=True)):
        line = [i for i, other in enumerate(places[:k]) if other.head == place.head]
        for i in line:
            if not _have_room(claim, place, claims[i], places[i]):
                last = max(line, key=lambda i: places[i].joining)
                free = max(_needed(claim, claims[i]) + places[i].joining for i in line)
                free -= place.joining - claim.slot_distance
                raise ValueError(_refusal(claim, claims[i], free, claims[last].pursuer))


def _place(claim: Claim, claims: Sequence[Claim], speeds: Mapping[str, MetrePerSecond]) -> Place:
    line = line_of(claim, claims)
    head = line[0].leader
    joining = sum(one.slot_distance for one in line)
    keeping = sum(one.spacing * speeds[head] or one.slot_distance for one in line)
    return Place(head, joining, keeping)


def _needed(claim: Claim, other: Claim) -> Metre:
    return max(claim.min_separation, other.min_separation)


def _have_room(claim: Claim, place: Place, other: Claim, its: Place) -> bool:
    if claim.leader == other.pursuer or other.leader == claim.pursuer:
        return True  # D has room for d_min, as each link sees to
    apart = min(abs(place.joining - its.joining), abs(place.keeping - its.keeping))
    return apart >= _needed(claim, other) - ROUNDED


def _refusal(claim: Claim, other: Claim, free: Metre, last: str) -> str:
    """Why a slot cannot be taken, and where there is room."""
    wanted = f"the slot {distance(claim.slot_distance)} behind {claim.leader}"
    if claim.spacing > 0.0:
        wanted += f" and keep {claim.spacing:g} s"
    return (
        f"{claim.pursuer} cannot take {wanted}: {other.pursuer} is to take the one "
        f"{distance(other.slot_distance)} behind {other.leader}. {distance(free)} or more behind "
        f"{claim.leader} is free; or let {claim.pursuer} follow {last}."
    )

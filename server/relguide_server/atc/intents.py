"""The picture as traffic that a plan keeps clear of: what each aircraft intends, as pieces."""

from collections.abc import Sequence
from math import atan, atan2, cos, degrees, hypot, pi, sin
from typing import Any

from relguide.atc.picture import Seen
from relguide.atc.track import Track
from relguide.atc.turns import Turn, turns
from relguide.contract.compass import compass
from relguide.planning import limits
from relguide.planning.frames import LocalPlane
from relguide.units import G0, Metre, MetrePerSecond, Radian, Second

BANKS = limits.BANK
"""What is flatter or steeper than a plan takes is taken at the limit [°]."""

AT_ONCE: Second = 1.0
"""A turn lasts so long at least: the corner of a filed route takes no time at all [s]."""


def traffic_body(
    seen: Seen, now: Second, plane: LocalPlane | None, minimum: Metre
) -> dict[str, Any] | None:
    """An aircraft as `POST /plans` takes traffic; `None` if it is slower or faster than that takes.

    It is where it is expected to be now, in still air.

    Args:
        seen: the aircraft.
        now: in the clock of its sky [s].
        plane: how that lies on the earth; `None` where nobody has said so.
        minimum: to be kept from it [m].
    """
    x, y, (east, north) = _now(seen, now)
    speed = hypot(east, north)
    if not limits.TAS.admits(speed):
        return None
    turned = 0.0
    place: dict[str, Any] = {"x_m": x, "y_m": y}
    if plane is not None:
        lat, lon = plane.to_geodetic(x, y)
        place, turned = {"lat_deg": lat, "lon_deg": lon}, degrees(plane.meridian(lat, lon))
    coming = [] if seen.path is None else [t for t in turns(seen.path) if t.ends > now]
    heading = degrees(_heading(coming, now, atan2(east, north))) - turned
    pieces = [] if seen.path is None else _pieces(seen.path, coming, now, turned)
    altitude = {} if seen.altitude is None else {"altitude_m": seen.altitude}
    return {
        "ident": seen.ident,
        **place,
        "heading_deg": compass(heading),
        "tas_mps": speed,
        **altitude,
        "intent": pieces[: limits.MAX_PIECES],
        "min_separation_m": minimum,
    }


def _now(seen: Seen, now: Second) -> tuple[Metre, Metre, tuple[MetrePerSecond, MetrePerSecond]]:
    """Where it is expected to be, and its velocity."""
    if seen.path is not None:
        return *seen.path.place(now), seen.path.velocity(now)
    east, north = seen.ground_speed * sin(seen.track), seen.ground_speed * cos(seen.track)
    since = now - seen.t
    return seen.x + since * east, seen.y + since * north, (east, north)


def _heading(coming: Sequence[Turn], now: Second, straight: Radian) -> Radian:
    """The direction now: in a turn by how long it has turned, as a path's lines cut it short."""
    for turn in coming[:1]:
        if turn.begins < now:
            share = (now - turn.begins) / (turn.ends - turn.begins)
            return turn.before + turn.side * _angle(turn) * share
    return straight


def _angle(turn: Turn) -> Radian:
    return (turn.side * (turn.after - turn.before)) % (2.0 * pi)


def _pieces(
    path: Track, coming: Sequence[Turn], now: Second, turned: float
) -> list[dict[str, Any]]:
    """The turns to come, and the straight pieces between."""
    pieces: list[dict[str, Any]] = []
    since = now
    for turn in coming:
        if turn.begins > since:
            pieces.append({"straight_s": turn.begins - since})
        speed = hypot(*path.velocity(turn.begins))
        lasts = max(turn.ends - turn.begins, AT_ONCE)
        bank = degrees(atan(speed * _angle(turn) / lasts / G0))
        pieces.append(
            {
                "turn_to_heading_deg": compass(degrees(turn.after) - turned),
                "direction": "right" if turn.side > 0 else "left",
                "bank_deg": min(max(bank, BANKS.low), BANKS.high),
            }
        )
        since = turn.ends
    return pieces

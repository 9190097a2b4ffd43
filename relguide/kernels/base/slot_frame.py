"""The slot seen from the leader, and the world seen from the slot."""

from math import cos, hypot, sin

from numba import njit


@njit(cache=True, nogil=True)
def slot_offset(
    heading: float, tas: float, wind_east: float, wind_north: float, slot_distance: float
) -> tuple[float, float, float]:
    """From the leader to the slot: D back along the leader's ground track.

    Args:
        heading: the leader's heading on the final leg, clockwise from north [rad].
        tas: its true airspeed [m/s].
        wind_east: the air mass over the ground [m/s].
        wind_north: the same, north [m/s].
        slot_distance: D [m].

    Returns:
        offset east and north [m], and the leader's ground speed [m/s], which must be above 0.
    """
    east = tas * sin(heading) + wind_east
    north = tas * cos(heading) + wind_north
    ground_speed = hypot(east, north)
    back = -slot_distance / ground_speed
    return back * east, back * north, ground_speed


@njit(cache=True, nogil=True)
def to_slot(dx: float, dy: float, heading: float, radius: float) -> tuple[float, float]:
    """A point of the air mass in the slot frame.

    Args:
        dx: from the slot, east [m].
        dy: from the slot, north [m].
        heading: the leader's final heading, clockwise from north [rad].
        radius: R [m].

    Returns:
        along that heading, and to the left of it [R].
    """
    along_x, along_y = sin(heading), cos(heading)
    return (dx * along_x + dy * along_y) / radius, (dy * along_x - dx * along_y) / radius

"""Directions on the wire: degrees clockwise from north.

They are written in [0, 360), and read up to twice round.
"""

from math import radians


def compass(degrees: float) -> float:
    """A direction in [0, 360) [°]."""
    wrapped = degrees % 360.0
    # the remainder of a tiny negative angle rounds to 360 itself
    return wrapped if wrapped < 360.0 else 0.0


def heading_of(degrees: float) -> float:
    """A direction in the library's unit [rad]."""
    return radians(compass(degrees))

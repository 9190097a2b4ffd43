"""The limits of a situation, in one place: what may be planned, and with it the work a plan takes.

`Situation` refuses what lies outside, `Situations` by columns, and so do REST and the command line,
all of them by these ranges and rules, and in these sentences.
"""

from math import inf, tau

from relguide.planning.inputs import Range
from relguide.units import KT

TAS = Range(30.0, 400.0, "m/s")
"""True airspeeds."""
BANK = Range(1.0, 60.0, "°")
"""Bank angles."""
DEGREES_MEANT = "Did you mean degrees? Then use from_display, or math.radians."
"""Said of an angle that no aircraft flies in radians."""
POSITION = Range(-1_000_000.0, 1_000_000.0, "m")
"""x and y."""
HEADING = Range(-2.0 * tau, 2.0 * tau, "rad", DEGREES_MEANT)
"""Headings: twice round, which the sum of two may be; beyond, degrees were given as radians."""
COMPASS = Range(-720.0, 720.0, "°")
"""The same in degrees."""
DISTANCE = Range(0.0, 200_000.0, "m")
"""D and d_min."""
MOST_MILES = 60
"""A distance up to this, given as a whole number of metres, was meant in nautical miles."""
ALTITUDE = Range(-500.0, 20_000.0, "m")
"""Where aircraft fly: from below the Dead Sea's shore to where the standard air ends."""
VERTICAL_RATE = Range(0.5, 60.0, "m/s")
"""Rates of climb and descent: 100 to 12,000 ft/min."""
CELL_RADIUS = Range(1.0, 500_000.0, "m")
"""Radii of weather cells."""
CELL_SPEED = Range(-150.0, 150.0, "m/s")
"""How fast a cell moves, to the east or to the north."""
GROWTH = Range(0.0, 50.0, "m/s")
"""How fast a cell's edge moves outward."""
WIND = Range(0.0, 150.0, "m/s")
"""Wind speeds: the strongest jet streams on record are slower."""
PIECE = Range(0.0, 86_400.0, "s")
"""Straight pieces of an intent."""
SPACING = Range(0.0, 600.0, "s")
"""Times behind the leader to keep once joined; 0 keeps D."""
MAX_PIECES = 20
"""Most pieces an intent may have."""
MAX_OTHERS = 100
"""Most other traffic and cells that a situation may have."""
MAX_CORNERS = 64
"""Most corners of a cell."""
CLEARANCE = Range(0.0, inf, "m")
"""D − d_min."""
HEADWAY = Range(1.0, inf, "m/s")
"""Ground speeds of the leader on its final leg: a slower one leaves no track behind it."""


def too_close_a_slot(slot_distance: float, min_separation: float) -> str:
    """What is wrong with a slot_distance without `CLEARANCE`; its name goes before it."""
    return (
        f"must be at least min_separation ({min_separation:g} m), not {slot_distance:g} m: "
        "the slot itself would be too close."
    )


def in_knots(tas: float) -> str:
    """What may be meant by a speed above `TAS`, if it would be one of them in knots."""
    return f"Did you mean knots? {tas:g} kt are {tas * KT:.1f} m/s." if TAS.admits(tas * KT) else ""


def in_miles(distance: int) -> str:
    """What is wrong with a distance that was meant in nautical miles; its name goes before it."""
    return (
        f"is in metres, and {distance} m is no distance for aircraft. Did you mean {distance} NM? "
        f"Then use from_display; else give it as {distance}.0."
    )


def no_headway(ground_speed: float) -> str:
    """What is wrong with a leader without `HEADWAY`; "the leader" goes before it."""
    return (
        f"makes no headway on its final leg in this wind ({ground_speed:.1f} m/s over the ground; "
        f"at least {HEADWAY.low:g} m/s is needed): it has no behind."
    )

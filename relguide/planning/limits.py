"""The limits of a situation, in one place: what may be planned, and with it the work a plan takes.

`Situation` refuses what lies outside, `Situations` by columns, and so do REST and the command line,
all of them by these ranges and rules, and in these sentences.
"""

from math import inf

from relguide.planning.inputs import Range

TAS = Range(30.0, 400.0, "m/s")
"""True airspeeds."""
BANK = Range(1.0, 60.0, "°")
"""Bank angles."""
POSITION = Range(-1_000_000.0, 1_000_000.0, "m")
"""x and y."""
HEADING = Range(-1e6, 1e6, "rad")
"""Headings: beyond, the last digit of a float is worth more than 1e-10."""
DISTANCE = Range(0.0, 200_000.0, "m")
"""D and d_min."""
WIND = Range(0.0, 150.0, "m/s")
"""Wind speeds: the strongest jet streams on record are slower."""
PIECE = Range(0.0, 86_400.0, "s")
"""Straight pieces of an intent."""
SPACING = Range(0.0, 600.0, "s")
"""Times behind the leader to keep once joined; 0 keeps D."""
MAX_PIECES = 20
"""Most pieces an intent may have."""
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


def no_headway(ground_speed: float) -> str:
    """What is wrong with a leader without `HEADWAY`; "the leader" goes before it."""
    return (
        f"makes no headway on its final leg in this wind ({ground_speed:.1f} m/s over the ground; "
        f"at least {HEADWAY.low:g} m/s is needed): it has no behind."
    )

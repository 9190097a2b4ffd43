"""The limits of a situation, in one place: what may be planned, and with it the work a plan takes.

`Situation` refuses what lies outside, `Situations` by columns, and so do REST and the command line.
"""

from relguide.units import DEG

MIN_TAS, MAX_TAS = 30.0, 400.0
"""Accepted true airspeeds [m/s]."""
MIN_BANK, MAX_BANK = 1.0 * DEG, 60.0 * DEG
"""Accepted bank angles [rad]."""
MAX_POSITION = 1_000_000.0
"""Largest accepted |x| and |y| [m]."""
MAX_HEADING = 1e6
"""Largest accepted |heading| [rad]: above it the last digit of a float is worth more than 1e-10."""
MAX_SLOT_DISTANCE = 200_000.0
"""Largest accepted D [m]."""
MAX_WIND = 150.0
"""Largest accepted wind speed [m/s]: above the strongest jet streams on record."""
MIN_HEADWAY = 1.0
"""Least ground speed of the leader on its final leg [m/s]: below it has no ground track."""
MAX_PIECE = 86_400.0
"""Longest straight piece of an intent [s]."""
MAX_PIECES = 20
"""Most pieces an intent may have."""

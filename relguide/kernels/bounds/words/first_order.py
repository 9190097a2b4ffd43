"""When words of an interval meet the target: by how their length changes with the poses of the set.

A word is known to within an interval of its unknown and a set of poses (see `intervals`). To
first order its length depends only on how the centre of its first circle lies from that of its last
one along the straight, or from the one to the other, and on how much its outer turns make. So with
u₀ the course in the middle of the interval, Δ that from there, l the straight, D the way from the
last centre to the first one and a the target's velocity, for LSL and LSR it is exactly

    τ (1 − a·u₀) = A₀ − η − D·u₀ + l (1 − cos Δ) + [2 (Δ − sin Δ)],

A₀ being both outer turns at the middle, η what the headings take of them, and the last term only
with opposite turns. For LRL, with w₀ the direction from the first centre to the last one, m the
middle arc and m₀ its middle,

    (τ − τ₀) (a·w₀ − cos ½m₀) = 4 sin ½m₀ − gap + η cos ½m₀ + D′·w₀ + …,    |…| ≤ ½ w² + ½ gap Δ².

D and η are linear in what fixes the poses, but for terms of second order: see `sets`. Lengths in R,
times in R/V_P, angles counter-clockwise.
"""

from math import inf

from relguide.kernels.base.borrowed import uncounted
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.breach import ROUNDING
from relguide.kernels.bounds.words.intervals import NOTHING, Interval, Side
from relguide.kernels.bounds.words.sets import Blur

FIRST_ROW = 64
"""Of an array with these rows: by each way how far the first circle's centre moves from the last
one's, with turns of the same hand and with opposite ones, and how much the headings change where
the word begins and where it ends."""
ROWS = 5
"""And in the last of these how far the centres may be and the headings differ besides."""
_LAST = 4
_FLAT = 1e-3  # a slope no steeper than this says nothing
_WIDE = 0.5  # directions are known to within this, or nothing is said


@uncounted
def put_sensitivity(blur: Blur, side: Side, rows: FloatArray) -> None:
    """Put down how the poses of a set change, as the words of a side see them.

    Args:
        blur: of the set.
        side: which words.
        rows: takes them.
    """
    strays = blur.sensitivity.bends + blur.sensitivity.twists + blur.met.bends + blur.met.twists
    rows[FIRST_ROW + _LAST, 0] = strays + 3.0 * ROUNDING
    if strays == inf:
        return
    m, (s, c) = side.mirror, sine_and_cosine(side.h)
    for k in range(2):
        way = blur.sensitivity.bearing if k == 0 else blur.sensitivity.time
        h = m * way.h
        x, y = way.x - h * c, m * way.y - h * s
        row = rows[FIRST_ROW + k]
        row[0], row[1], row[2], row[3], row[4], row[5] = x, y, x, y, h, 0.0
        way = blur.met.bearing if k == 0 else blur.met.time
        h = m * way.h
        x, y = -way.x, -m * way.y
        row = rows[FIRST_ROW + 2 + k]
        row[0], row[1], row[2], row[3], row[4], row[5] = x + h, y, x - h, y, 0.0, h


@uncounted
def same_turns_closely(found: Interval, side: Side, rows: FloatArray) -> Interval:
    """What is known of LSL, closer as to when it meets the target."""
    strays, astray = rows[FIRST_ROW + _LAST, 0], found.astray
    longest = found.middle + found.middle_blur
    if strays == inf or found.time == inf or astray > _WIDE or longest == inf:
        return found
    s, c = sine_and_cosine(-found.first)
    slope = 1.0 - side.target.ahead * c - side.target.left * s
    if slope < _FLAT:
        return found
    at = found.turned - side.cx * c - (side.cy - 1.0) * s
    for k in range(_LAST):
        row = rows[FIRST_ROW + k]
        strays += abs(row[4] - row[5] + row[0] * c + row[1] * s)
    high = at + strays + 0.5 * longest * astray * astray
    return _between(found, (at - strays) / slope, high / slope)


@uncounted
def opposite_turns_closely(
    found: Interval, half: float, s: float, c: float, side: Side, rows: FloatArray
) -> Interval:
    """The same of LSR, with a straight within `half` of the course with this sine and cosine."""
    strays, longest = rows[FIRST_ROW + _LAST, 0], found.middle + found.middle_blur
    if strays == inf:
        return found
    slope = 1.0 - side.target.ahead * c - side.target.left * s
    if slope < _FLAT:
        return found
    at = found.turned - side.cx * c - (side.cy + 1.0) * s
    for k in range(_LAST):
        row = rows[FIRST_ROW + k]
        strays += abs(row[4] + row[5] + row[2] * c + row[3] * s)
    square = half * half
    strays += square * half / 3.0
    return _between(found, (at - strays) / slope, (at + strays + 0.5 * longest * square) / slope)


@uncounted
def three_turns_closely(
    found: Interval, half: float, s: float, c: float, side: Side, rows: FloatArray
) -> Interval:
    """The same of LRL, whose middle arc is within `half` of one with this sine, cosine of half."""
    strays = rows[FIRST_ROW + _LAST, 0]
    if strays == inf:
        return found
    (ax, ay), met = side.target, found.turned + found.middle
    to_x, to_y = ax * met - side.cx, ay * met + 1.0 - side.cy
    gap = norm(to_x, to_y)
    slack = side.radius + 2.0 * side.alpha * half
    if slack > _WIDE * gap:
        return found
    to_x, to_y = to_x / gap, to_y / gap
    slope = ax * to_x + ay * to_y - c
    if abs(slope) < _FLAT:
        return found
    for k in range(_LAST):
        row = rows[FIRST_ROW + k]
        strays += abs(c * (row[4] - row[5]) + row[0] * to_x + row[1] * to_y)
    strays += 0.5 * half * half
    # an angle is no greater than this times its sine
    off = 1.05 * slack / gap
    low = (4.0 * s - gap - strays - 0.5 * (gap + slack) * off * off) / slope
    high = (4.0 * s - gap + strays) / slope
    return _between(found, met + min(low, high), met + max(low, high))


@uncounted
def _between(found: Interval, time: float, latest: float) -> Interval:
    """The same, if it meets the target no sooner and no later than that."""
    time, latest = max(time, found.time), min(latest, found.latest)
    if latest < time:
        return NOTHING
    return Interval(
        time, latest, found.fine, found.turned, found.first, found.astray, found.middle,
        found.middle_blur, found.shortest,
    )  # fmt: skip

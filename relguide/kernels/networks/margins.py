"""How far a situation lies from where branches begin, end, or turn into one another.

Most of these switching surfaces are known in closed form, though the times of the branches on
either side are not: on them one piece of a path vanishes or is a half circle, and the rest meets a
single equation. A margin is by how much that equation is missed [R], with a sign, zero on the
surface. It is given at two scales, R and `NEAR`, since there a network has to switch at once.

Slot frame as in `extremals`; c₁ is the centre of the first turn, w = 2πk − h what two left turns
turn in all (mod 2π). Written for left turns; the right ones are those of the mirror image.

No straight (LSR becomes LR, next to LRL and RLR): the last turn is β with cos β = (1 + c₁ᵧ)/2, one
of two, the first β − h, and the circles touch if α (2β − h) − c₁ₓ = 2 sin β.

A middle arc of half a circle (LRL and LRL long): |(α (2π + w), 0) + (0, 1) − c₁| = 4.

A double root of `ccc.lrl` (both begin): with X = α (2m + w) − c₁ₓ and e = 1 − c₁ᵧ,

    X = 2 sin m/α,    X² + e² = 16 q,    q = sin²(m/2)    ⇒    q² − (1 − α²) q − α²e²/16 = 0.

No first turn: a straight along h, then the last circle. No last turn: the first circle touches the
route.
"""

from math import acos, asin, atan2, cos, hypot, log1p, sin, sqrt

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.words.branches import FEATURES, direct_time, features

NEAR = 0.03
"""The smaller scale of a margin [R]: 400 m for an airliner."""
SIDE = 26
"""How many numbers there are of the turns of one side."""
INPUTS = FEATURES + 2 * SIDE + 2
"""How many numbers `inputs` gives."""


@njit(cache=True, nogil=True)
def inputs(pose: Pose, alpha: float, out: FloatArray) -> None:
    """What the branch network is given: `features`, and the margins.

    Args:
        pose: the pursuer's, seen from the slot, not `needs_mirror`; its heading in [0, 2π).
        alpha: V_L/V_P, below 1.
        out: takes them. shape (INPUTS,)
    """
    x, y, h = pose
    features(x, y, h, alpha, out)
    direct = direct_time(x, y, alpha)
    left = _side(pose, alpha, direct, out[FEATURES : FEATURES + SIDE])
    mirrored = Pose(x, -y, wrap(TWO_PI - h))
    right = _side(mirrored, alpha, direct, out[FEATURES + SIDE : INPUTS - 2])
    # LSL and RSR are as fast
    _margin(right - left, out, INPUTS - 2)


@njit(cache=True, nogil=True)
def _margin(by: float, out: FloatArray, at: int) -> None:
    out[at] = by / (1.0 + abs(by))
    out[at + 1] = by / (NEAR + abs(by))


@njit(cache=True, nogil=True)
def _side(pose: Pose, alpha: float, direct: float, out: FloatArray) -> float:
    """The margins of the words that begin with a left turn; τ of LSL, once round [R/V_P].

    Args:
        pose: as in `inputs`, on either side of the route.
        alpha: as in `inputs`.
        direct: `direct_time`.
        out: takes them. shape (SIDE,)
    """
    x, y, h = pose
    sine, cosine = sin(h), cos(h)
    cx, cy = x - sine, y + cosine
    e = 1.0 - cy
    turned = wrap(TWO_PI - h)

    # No straight.
    level = 0.5 * (1.0 + cy)
    out[0] = level / (1.0 + abs(level))
    last = acos(min(1.0, max(-1.0, level)))
    chord = 2.0 * sin(last)
    _margin(alpha * (wrap(last - h) + last) - cx - chord, out, 1)
    last = TWO_PI - last
    _margin(alpha * (wrap(last - h) + last) - cx + chord, out, 3)

    # A middle arc of half a circle, and the double roots; w = −h and 2π − h.
    squared = alpha * alpha
    one_less = 1.0 - squared
    q = min(1.0, 0.5 * (one_less + sqrt(one_less * one_less + 0.25 * squared * e * e)))
    middle, sheer = 2.0 * asin(sqrt(q)), 2.0 * sqrt(q * (1.0 - q))
    for k in range(2):
        w = TWO_PI * k - h
        _margin(hypot(alpha * (TWO_PI + w) - cx, e) - 4.0, out, 5 + 2 * k)
        # times α, so that a slot at rest is no trap
        short = alpha * (alpha * (2.0 * middle + w) - cx) - 2.0 * sheer
        long = alpha * (alpha * (2.0 * (TWO_PI - middle) + w) - cx) + 2.0 * sheer
        out[9 + 2 * k] = short / (1.0 + abs(short))
        out[10 + 2 * k] = long / (1.0 + abs(long))
    out[13] = (e * e - 16.0) / (e * e + 16.0)

    # No first turn, and no last one.
    ahead, beside = alpha * turned - x, 1.0 - y
    straight = (ahead * cosine + beside * sine) / (1.0 - alpha * cosine)
    _margin(beside * cosine - (ahead + alpha * straight) * sine - 1.0, out, 14)
    out[16] = straight / (1.0 + abs(straight))
    _margin(cy - 1.0, out, 17)
    straight = (alpha * turned - cx) / (1.0 - alpha)
    out[19] = straight / (1.0 + abs(straight))

    # Two turns the same way, as in `features`: how late, and how near the first is to none.
    ex = alpha * turned - cx
    b = alpha * ex
    straight = (b + sqrt(b * b + one_less * (ex * ex + e * e))) / one_less
    first = atan2(e, alpha * straight + ex) - h
    out[20] = log1p(max(turned + straight - direct, 0.0))
    out[21] = sin(first)
    out[22] = cos(first)

    # Two turns opposite ways to where the slot is at T₀: their directions, and how late.
    dx, dy = alpha * direct - cx, -1.0 - cy
    d = hypot(dx, dy)
    course = atan2(dy, dx) + asin(min(1.0, 2.0 / max(d, 1e-12)))
    late = sqrt(max(d * d - 4.0, 0.0)) + wrap(course - h) + wrap(course) - direct
    out[23] = cos(course - h)
    out[24] = sin(course - h)
    out[25] = log1p(max(late, 0.0))
    return turned + straight


@njit(cache=True, nogil=True)
def input_rows(situations: FloatArray, out: FloatArray) -> None:
    """`inputs` of many situations that do not need a mirror (`needs_mirror`).

    Args:
        situations: x, y, h, α. shape (n, 4)
        out: takes them. shape (n, INPUTS)
    """
    for n in range(len(situations)):
        x, y, h, alpha = situations[n]
        inputs(Pose(x, y, h), alpha, out[n])

"""Where the next turn can end after a contact that is passed in a turn: by one number.

λ_ψ vanishes on a line, along λ_p: turns to the left where a path is left of it. At a contact λ_ψ
goes on unbroken and λ_p changes along the line to the leader (see `junction`). So the new line
passes through the point where the old one meets that line, whatever the change: it is one of a
pencil, and turns from the direction of the old one to that of the leader as the change grows. A
turn that goes on ends where it meets the new line: then the other way, for 2π less twice the angle
between the two; or straight on, if it only touches it. That happens at two turns: for a word with
a straight, m being the turn before the contact and η the direction to the leader,

    cot ½τ = 2 cot η + cot ½m.

The old line is known by m and the arc n before it, from which the heading differs by ½n − π where
that ends; 0 after a straight. All seen from the contact, along its heading, left being the side of
the turn. Lengths in R, angles in rad.
"""

from math import atan, atan2, cos, inf, pi, sin, sqrt, tan
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.norm import norm

_SLACK = 0.02  # directions are told apart by this [rad]
_SURE = 0.05  # and which way a line turns, if it turns by less than half a turn less this [rad]
_ROUNDING, _TINY = 1e-9, 1e-300


class Arrived(NamedTuple):
    """How paths come to a contact, in a turn."""

    inward: bool
    """Whether that is toward the leader."""
    three: bool
    """Whether another turn comes before it, or a straight."""
    low: float
    """Least and greatest turn before the contact …"""
    high: float
    """[rad]."""
    least: float
    """… and arc before that, if that is a turn …"""
    most: float
    """[rad]."""


class Pencil(NamedTuple):
    """The lines on which λ_ψ may vanish after the contact."""

    low: float
    """The old line meets the one to the leader at −1/κ times the leader's direction: least κ …"""
    high: float
    """… and greatest [1/R]."""
    eta: float
    """Direction to the leader, to the side of the turn [rad]."""
    eta_off: float
    """How much that may differ [rad]."""
    old: float
    """Direction of λ_p before the contact [rad]."""
    old_off: float
    """How much that may differ [rad]."""
    beyond: int
    """Whether turns end after one at which the line would pass through the contact itself, 1, or
    before, −1; 0 if that is not known."""


@njit(cache=True, nogil=True)
def pencil_of(arrived: Arrived, eta: float, eta_off: float) -> Pencil:
    """The lines after a contact.

    Args:
        arrived: how it is come to.
        eta: how far the leader is to one side of the heading there [rad].
        eta_off: how much that may differ [rad].
    """
    eta = eta if arrived.inward else -eta
    turn, turn_off = 0.5 * (arrived.low + arrived.high), 0.5 * (arrived.high - arrived.low)
    tilt, tilt_off = 0.0, 0.0
    if arrived.three:
        tilt = 0.25 * (arrived.least + arrived.most) - pi
        tilt_off = 0.25 * (arrived.most - arrived.least)
    old, old_off = tilt - turn, turn_off + tilt_off + _ROUNDING
    eta_off += _ROUNDING
    a, b = sin(eta - old), cos(tilt) - cos(old)
    # of the product −2 sin ½(tilt + old) sin ½(tilt − old) each factor is known nearly
    one, other = abs(sin(0.5 * (tilt + old))), abs(sin(0.5 * turn))
    one_off, other_off = 0.5 * (tilt_off + old_off), 0.5 * (turn_off + _ROUNDING)
    b_off = 2.0 * (one * other_off + other * one_off + one_off * other_off)
    a_off, beyond = old_off + eta_off, _beyond(arrived, eta, eta_off)
    if b_off >= abs(b):
        return Pencil(-inf, inf, eta, eta_off, old, old_off, beyond)
    off = (a_off + abs(a / b) * b_off) / (abs(b) - b_off)
    return Pencil(a / b - off, a / b + off, eta, eta_off, old, old_off, beyond)


@njit(cache=True, nogil=True)
def _beyond(arrived: Arrived, eta: float, eta_off: float) -> int:
    """`Pencil.beyond`: what the change adds to λ_ψ has one sign up to there, and then the other.

    After a straight it is positive without the change, and after another turn until that is over.
    """
    through, spare = _through(eta), 2.0 * eta_off + _ROUNDING
    if not arrived.three:
        return -1 if eta > 0.0 else 1
    if arrived.most - arrived.low < through - spare and (
        eta > 0.0 or TWO_PI - arrived.high > through + spare
    ):
        return -1
    return 1 if eta < 0.0 and arrived.least - arrived.high > through + spare else 0


@njit(cache=True, nogil=True)
def _through(eta: float) -> float:
    """The turn at which the line passes through the contact itself [rad]."""
    return 2.0 * eta if eta > 0.0 else TWO_PI + 2.0 * eta


@njit(cache=True, nogil=True)
def off_line(pencil: Pencil, turn: float, half: float) -> tuple[float, float]:
    """How far to the turn's side of the heading λ_p points where a turn within `half` ends.

    Returns:
        least and greatest angle [rad]; −π and π if that is not known.
    """
    through = _through(pencil.eta)
    near, beyond = abs(turn - through) <= half + 2.0 * pencil.eta_off, turn > through
    if pencil.high == inf or (near and pencil.beyond == 0):
        return -pi, pi
    if near:
        beyond = pencil.beyond > 0
    x, y = sin(turn), 1.0 - cos(turn)
    s, c = sin(pencil.eta), cos(pencil.eta)
    turned = pi if beyond == (pencil.eta > 0.0) else 0.0
    # from r along P the direction of r + κ P turns one way
    one_x, one_y = c + pencil.low * x, s + pencil.low * y
    dx, dy = (pencil.high - pencil.low) * x, (pencil.high - pencil.low) * y
    along = -(one_x * dx + one_y * dy)
    nearest = min(max(along / max(dx * dx + dy * dy, _TINY), 0.0), 1.0)
    far = norm(one_x + nearest * dx, one_y + nearest * dy)
    off = max(abs(pencil.low), abs(pencil.high)) * half + pencil.eta_off
    if off >= 0.5 * far:
        return -pi, pi
    one = wrap_signed(atan2(one_y, one_x) + turned - turn)
    other = one + wrap_signed(atan2(one_y + dy, one_x + dx) + turned - turn - one)
    off = 1.05 * off / far + half
    least, most = min(one, other) - off, max(one, other) + off
    return (least, most) if most - least < pi else (-pi, pi)


@njit(cache=True, nogil=True)
def straight_after(arrived: Arrived, pencil: Pencil, root: int) -> tuple[float, float]:
    """Least and greatest turn after the contact up to a straight; the least is infinite if none is.

    Args:
        arrived: how the contact is come to.
        pencil: of it.
        root: 0 or 1, which of the two turns that touch a line of the pencil.
    """
    if not arrived.three:
        if root == 1:
            return inf, inf
        low = _after_straight(arrived.low, pencil.eta - pencil.eta_off)
        high = _after_straight(arrived.high, pencil.eta + pencil.eta_off)
    else:
        low, high = _after_turn(pencil, root)
    return (low, high) if _is_between(pencil, low, high) else (inf, inf)


@njit(cache=True, nogil=True)
def _after_straight(turn: float, eta: float) -> float:
    if turn <= 0.0 or turn >= TWO_PI:
        return 0.0 if turn <= 0.0 else TWO_PI
    return 2.0 * (0.5 * pi - atan(2.0 * cos(eta) / sin(eta) + 1.0 / tan(0.5 * turn)))


@njit(cache=True, nogil=True)
def _after_turn(pencil: Pencil, root: int) -> tuple[float, float]:
    """The same after another turn: cot ½τ = (cos η ± √(1 + 2 κ sin η)) / sin η."""
    s, c = sin(pencil.eta), cos(pencil.eta)
    if pencil.high == inf or abs(s) <= 2.0 * pencil.eta_off:
        return 0.0, TWO_PI
    ratio, off = 0.5 * (pencil.low + pencil.high), 0.5 * (pencil.high - pencil.low)
    square = 1.0 + 2.0 * ratio * s
    off = 2.0 * (off * abs(s) + (abs(ratio) + off) * pencil.eta_off)
    if square + off < 0.0:
        return inf, inf
    sign = 1.0 if root == 0 else -1.0
    one, other = sign * sqrt(max(square - off, 0.0)), sign * sqrt(square + off)
    low, high = c + min(one, other) - pencil.eta_off, c + max(one, other) + pencil.eta_off
    least, most = inf, -inf
    for k in range(4):
        x = (low if k < 2 else high) / (s + (pencil.eta_off if k % 2 == 0 else -pencil.eta_off))
        least, most = min(least, x), max(most, x)
    return 2.0 * (0.5 * pi - atan(most)), 2.0 * (0.5 * pi - atan(least))


@njit(cache=True, nogil=True)
def _is_between(pencil: Pencil, low: float, high: float) -> bool:
    """Whether λ_p may point along a heading in a range: on the shorter way to the leader."""
    way = wrap_signed(pencil.eta - pencil.old)
    if low == inf or abs(way) > pi - _SURE:
        return low < inf
    middle, half = 0.5 * (low + high), 0.5 * (high - low) + _SLACK
    half += pencil.old_off + pencil.eta_off
    return bool(abs(wrap_signed(middle - pencil.old - 0.5 * way)) <= 0.5 * abs(way) + half)

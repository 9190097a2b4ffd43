"""Angles: wrapping, the one home of it. Plain functions from Python, compiled within kernels."""

from math import pi

import numpy as np
from numba.extending import register_jitable

from relguide.kernels.base.roots import FloatArray

TWO_PI = 2.0 * pi
FULL_TURN_SLACK = 1e-9
"""An arc this close to a full turn is rounding of no turn at all [rad]; ≈ 1e-5 m at R = 12 km."""


@register_jitable
def modulo(angle: float) -> float:
    """As angle % 2π to the last bit, without the division where it is a turn off at most."""
    if 0.0 <= angle < TWO_PI:
        return angle
    if -TWO_PI <= angle < 0.0:
        return angle + TWO_PI
    if TWO_PI <= angle < 2.0 * TWO_PI:
        return angle - TWO_PI
    return angle % TWO_PI


@register_jitable
def wrap(angle: float) -> float:
    """An angle in [0, 2π)."""
    wrapped = modulo(angle)
    if wrapped >= TWO_PI:  # −1e-17 % 2π rounds up to 2π itself
        return 0.0
    return wrapped


@register_jitable
def mirror_heading(angle: float) -> float:
    """A heading of [0, 2π) in the mirror, left and right exchanged; in [0, 2π) too."""
    return TWO_PI - angle if angle > 0.0 else 0.0


@register_jitable
def wrap_signed(angle: float) -> float:
    """An angle in [−π, π)."""
    return modulo(angle + pi) - pi


@register_jitable
def turn_to(angle: float) -> float:
    """The angle of an arc, in [0, 2π): as `wrap`, but a full turn that is only rounding is 0."""
    wrapped = modulo(angle)
    if wrapped > TWO_PI - FULL_TURN_SLACK:
        return 0.0
    return wrapped


def wrap_each(angles: FloatArray) -> FloatArray:
    """As `wrap`, for an array."""
    wrapped = angles % TWO_PI
    return np.where(wrapped >= TWO_PI, 0.0, wrapped)

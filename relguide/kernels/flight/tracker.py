"""An extended Kalman filter that follows another aircraft over the ground by what it reports.

    state: x, y, v, χ, r            ẋ = v sin χ,  ẏ = v cos χ,  v̇ = noise,  χ̇ = r,  ṙ = noise

The coordinated turn is flown in closed form, as by `advance`; so are its derivatives and the effect
of white noise on v and r (Bar-Shalom, Li, Kirubarajan, Estimation with Applications to Tracking and
Navigation, 2001, §6.2 and §11.7). A reported velocity is compared along and across the track that
is believed. There it measures v and vχ alone, so the four measurements are taken one by one, which
is the same as all at once.

One size of noise serves straights and turns. Raising it where a velocity is 2.7 σ off, as a
manoeuvre, was tried: an airliner's turn was seen no sooner (3.67 s), and straights trembled more.
"""

from math import atan2, cos, hypot, sin

import numpy as np
from numba import njit

from relguide.kernels.base.motion import advance
from relguide.kernels.base.roots import FloatArray
from relguide.units import DEG

X, Y, SPEED, TRACK, RATE = 0, 1, 2, 3, 4
"""Rows of a state: east and north over the ground [m], ground speed v [m/s], track χ [rad,
continuous], turn rate r of the track [rad/s, positive to the right]."""
SPEED_NOISE = 0.4**2
"""Spectral density of the acceleration [m²/s³]. Braking of 0.7 m/s² is then followed 1.6 m/s behind
(NACv 2), and a steady speed is known to 0.5 m/s."""
RATE_NOISE = (0.1 * DEG) ** 2
"""Spectral density of ṙ [rad²/s³]. With σ of 1.2 m/s (NACv 2) at 230 m/s, straights show 0.08°/s of
turn rate, and the beginning of an airliner's turn 0.2°/s after 4 s."""
FIRST_RATE = 0.7 * DEG
"""σ of the turn rate at first sight [rad/s]: most fly straight, some turn at 1–1.5°/s."""


@njit(cache=True, nogil=True)
def begin(
    x: float, y: float, east: float, north: float, position_sigma: float, velocity_sigma: float
) -> tuple[FloatArray, FloatArray]:
    """What is known at first sight, from one report.

    Args:
        x: east over the ground [m].
        y: north over the ground [m].
        east: ground velocity [m/s].
        north: the same [m/s].
        position_sigma: of x and of y [m], > 0.
        velocity_sigma: of east and of north [m/s], > 0.

    Returns:
        state (5,) and its covariance (5, 5).
    """
    speed = hypot(east, north)
    state = np.array([x, y, speed, atan2(east, north), 0.0])
    covariance = np.zeros((5, 5))
    covariance[X, X] = covariance[Y, Y] = position_sigma * position_sigma
    covariance[SPEED, SPEED] = velocity_sigma * velocity_sigma
    covariance[TRACK, TRACK] = (velocity_sigma / max(speed, velocity_sigma)) ** 2
    covariance[RATE, RATE] = FIRST_RATE * FIRST_RATE
    return state, covariance


@njit(cache=True, nogil=True)
def predict(state: FloatArray, covariance: FloatArray, dt: float) -> tuple[FloatArray, FloatArray]:
    """State and covariance dt [s] later, without a report."""
    v, rate = state[SPEED], state[RATE]
    x, y, track = advance(state[X], state[Y], state[TRACK], v, rate, dt)
    half = 0.5 * rate * dt
    # chord = v dt sinc(half) on the mean track; the series of the slope is exact to 1e-13 there
    if abs(half) < 1e-3:
        sinc, slope = 1.0 - half * half / 6.0, -half / 3.0 + half**3 / 30.0
    else:
        sinc = sin(half) / half
        slope = (cos(half) - sinc) / half
    along = np.array([sin(state[TRACK] + half), cos(state[TRACK] + half)])
    across = np.array([along[1], -along[0]])
    moved = np.eye(5)
    moved[:2, SPEED] = dt * sinc * along
    moved[:2, TRACK] = v * dt * sinc * across
    moved[:2, RATE] = 0.5 * v * dt * dt * (slope * along + sinc * across)
    moved[TRACK, RATE] = dt
    later = _times(_times(moved, covariance), moved.T)
    # ∫ of what noise on v̇ and ṙ does: columns are the ways it comes to by now, each in its powers
    reach = v * across
    later[SPEED, SPEED] += SPEED_NOISE * dt
    later[TRACK, TRACK] += RATE_NOISE * dt**3 / 3.0
    later[RATE, RATE] += RATE_NOISE * dt
    later[TRACK, RATE] += RATE_NOISE * dt * dt / 2.0
    later[RATE, TRACK] += RATE_NOISE * dt * dt / 2.0
    for i in range(2):
        for j in range(2):
            later[i, j] += SPEED_NOISE * dt**3 / 3.0 * along[i] * along[j]
            later[i, j] += RATE_NOISE * dt**5 / 20.0 * reach[i] * reach[j]
        for row, noise in (
            (SPEED, SPEED_NOISE * dt * dt / 2.0 * along[i]),
            (TRACK, RATE_NOISE * dt**4 / 8.0 * reach[i]),
            (RATE, RATE_NOISE * dt**3 / 6.0 * reach[i]),
        ):
            later[i, row] += noise
            later[row, i] += noise
    return np.array([x, y, v, track, rate]), later


@njit(cache=True, nogil=True)
def update(
    state: FloatArray, covariance: FloatArray, x: float, y: float, east: float, north: float,
    position_sigma: float, velocity_sigma: float,
) -> tuple[FloatArray, FloatArray, float]:  # fmt: skip
    """State and covariance with a report of the same moment taken in.

    Args:
        state: as predicted. shape (5,)
        covariance: of it. shape (5, 5)
        x: reported, east over the ground [m].
        y: reported, north over the ground [m].
        east: reported ground velocity [m/s].
        north: the same [m/s].
        position_sigma: of x and of y [m], > 0.
        velocity_sigma: of east and of north [m/s], > 0.

    Returns:
        state, covariance, and how surprising the report was: its normalised innovation squared,
        4 in the mean where nothing changes.
    """
    v = max(state[SPEED], velocity_sigma)  # no track can be told of an aircraft that stands
    s, c = sin(state[TRACK]), cos(state[TRACK])
    seen = np.array([east * c - north * s, east * s + north * c - state[SPEED], x, y])
    seen[2] -= state[X]
    seen[3] -= state[Y]
    variances = np.array([velocity_sigma, velocity_sigma, position_sigma, position_sigma]) ** 2
    columns, weights = (TRACK, SPEED, X, Y), (v, 1.0, 1.0, 1.0)
    after, spread, surprise = np.zeros(5), covariance.copy(), 0.0
    for k in range(4):
        column, weight = columns[k], weights[k]  # each measures one number of the state
        shared = weight * spread[:, column]
        variance = weight * shared[column] + variances[k]
        error = seen[k] - weight * after[column]
        surprise += error * error / variance
        after += shared * (error / variance)
        spread -= np.outer(shared, shared) / variance
    return state + after, spread, surprise


@njit(cache=True, nogil=True)
def _times(one: FloatArray, other: FloatArray) -> FloatArray:
    """The product of two small matrices: numba's own needs a library that kernels do without."""
    product = np.zeros((len(one), other.shape[1]))
    for i in range(len(one)):
        for j in range(len(other)):
            for k in range(other.shape[1]):
                product[i, k] += one[i, j] * other[j, k]
    return product

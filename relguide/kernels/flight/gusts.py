"""Gusts at height: Dryden's spectra of MIL-F-8785C, as exact filters of white noise.

    Φ_u(ω) = σ² (2T/π) / (1 + (Tω)²)                        along,   T = L/V
    Φ_v(ω) = σ² (T/π) (1 + 3(Tω)²) / (1 + (Tω)²)²           across,  ∫ Φ dω = σ² from 0 to ∞

Their autocovariances are R_u = σ² e^(−τ/T) and R_v = σ² (1 − τ/2T) e^(−τ/T). Sampled each dt, u is
an autoregression of first order, and v one of second order (poles a = e^(−dt/T), twice) of noise
with a moving average of two:

    v_k = 2a v_(k−1) − a² v_(k−2) + b₀ n_k + b₁ n_(k−1)

whose b₀, b₁ follow from R_v at 0, dt and 2dt. So the samples have Dryden's covariances exactly,
whatever dt is.
"""

from math import exp, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray

SCALE = 533.4
"""L = 1750 ft, along and across alike, above 2,000 ft [m]."""
STATE = 4
"""How many numbers a filter remembers: u, v, v a step before, and the last white noise of v."""


@njit(cache=True, nogil=True)
def gust_steps(
    filter_state: FloatArray, sigma: float, tas: float, dt: float, white: FloatArray
) -> FloatArray:
    """The gusts that an aircraft meets now and after each of some steps.

    From a state of zeros gusts grow to their full strength within 3 L/V, some 7 s.

    Args:
        filter_state: all for σ = 1; zeros at first, in the end as after the last step. shape (4,)
        sigma: σ of both gusts [m/s], ≥ 0.
        tas: true airspeed V [m/s], > 0.
        dt: the step [s].
        white: independent standard normal numbers; row k makes the gust of step k, the first is not
            read. shape (steps + 1, 2)

    Returns:
        gusts along the heading (positive from behind) and across it (positive from the left): the
        velocity that the air has beside its wind; the first row is that of now. shape
        (steps + 1, 2) [m/s]
    """
    a = exp(-dt * tas / SCALE)
    b0, b1 = _moving_average(dt * tas / SCALE)
    rough = sqrt(1.0 - a * a)
    u, v, before, last = filter_state[0], filter_state[1], filter_state[2], filter_state[3]
    gusts = np.empty((len(white), 2))
    gusts[0, 0], gusts[0, 1] = sigma * u, sigma * v
    for k in range(1, len(white)):
        u = a * u + rough * white[k, 0]
        v, before = 2.0 * a * v - a * a * before + b0 * white[k, 1] + b1 * last, v
        last = white[k, 1]
        gusts[k, 0], gusts[k, 1] = sigma * u, sigma * v
    filter_state[0], filter_state[1], filter_state[2], filter_state[3] = u, v, before, last
    return gusts


@njit(cache=True, nogil=True)
def _moving_average(step: float) -> tuple[float, float]:
    """b₀ and b₁ of a step dt/T: from γ₀ = b₀² + b₁² and γ₁ = b₀ b₁, the covariances of the noise.

    Of the two solutions b₀ is the larger one, so that the noise can be told from the gusts.
    """
    a = exp(-step)
    r0, r1, r2 = 1.0, (1.0 - 0.5 * step) * a, (1.0 - step) * a * a
    r3 = (1.0 - 1.5 * step) * a * a * a
    even = r0 * (1.0 + 4.0 * a * a + a**4) - 4.0 * r1 * a * (1.0 + a * a) + 2.0 * r2 * a * a
    odd = -2.0 * a * (1.0 + a * a) * (r0 + r2) + r1 * (1.0 + 5.0 * a * a + a**4) + r3 * a * a
    apart = sqrt(max(even * even - 4.0 * odd * odd, 0.0))
    b0 = sqrt(0.5 * (even + apart))
    return b0, odd / b0

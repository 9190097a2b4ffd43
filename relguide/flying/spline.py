"""smoothing_spline(t, values, weight): the natural cubic f of least Σ (vᵢ − f(tᵢ))² + λ ∫ f″².

Reinsch (1967), as in Green and Silverman, *Nonparametric Regression* (1994), section 2.3: with
hᵢ = tᵢ₊₁ − tᵢ, γ the second derivatives at the inner times, Qᵀ v the second divided differences and
γᵀ R γ the integral ∫ f″²,

    (R + λ Qᵀ Q) γ = Qᵀ v;    f(tᵢ) = vᵢ − λ (Q γ)ᵢ.

The matrix has five diagonals, so that all of it takes time in proportion to the number of points.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Spline:
    """A cubic between each two knots, with continuous second derivatives; columns side by side."""

    knots: Array
    """Rising. shape (n,)"""
    values: Array
    """At the knots. shape (n, k)"""
    bends: Array
    """Second derivatives at the knots. shape (n, k)"""

    def at(self, t: Array) -> Array:
        """Values at some times, shape (len(t), k); the outermost cubics go on beyond the knots."""
        u, value, slope, bend, twist = self._cubics(t)
        return value + u * (slope + u * (0.5 * bend + u * twist / 6.0))

    def slope_at(self, t: Array) -> Array:
        """First derivatives at some times, shape (len(t), k)."""
        u, _, slope, bend, twist = self._cubics(t)
        return slope + u * (bend + 0.5 * u * twist)

    def _cubics(self, t: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Time since the knot before, and there: the value and its three derivatives."""
        last = len(self.knots) - 2
        i = np.clip(np.searchsorted(self.knots, t, side="right") - 1, 0, last)
        h = (self.knots[i + 1] - self.knots[i])[:, None]
        before, after = self.bends[i], self.bends[i + 1]
        slope = (self.values[i + 1] - self.values[i]) / h - h * (2.0 * before + after) / 6.0
        u = (t - self.knots[i])[:, None]
        return u, self.values[i], slope, before, (after - before) / h


def smoothing_spline(t: Array, values: Array, weight: float) -> Spline:
    """The natural cubic spline that smooths values.

    Args:
        t: rising, three or more. shape (n,)
        values: columns side by side. shape (n, k)
        weight: λ, of the cube of t's unit.
    """
    h = np.diff(t)
    slant = 1.0 / h
    peak = -(slant[:-1] + slant[1:])
    # R + λ Qᵀ Q: its diagonal, and the two beside it
    main = (h[:-1] + h[1:]) / 3.0 + weight * (slant[:-1] ** 2 + peak**2 + slant[1:] ** 2)
    next_one = h[1:-1] / 6.0 + weight * slant[1:-1] * (peak[:-1] + peak[1:])
    next_two = weight * slant[1:-2] * slant[2:-1]
    inner = _solve(main, next_one, next_two, np.diff(np.diff(values, axis=0) / h[:, None], axis=0))
    bends = np.pad(inner, ((1, 1), (0, 0)))
    pull = np.diff(np.diff(bends, axis=0) / h[:, None], axis=0, prepend=0.0, append=0.0)
    return Spline(knots=t, values=values - weight * pull, bends=bends)


def _solve(main: Array, next_one: Array, next_two: Array, due: Array) -> Array:
    """Solve a symmetric positive definite system of five diagonals, by its factors L D Lᵀ."""
    # plain floats, row by row; the zeros are for the rows beyond the last
    n = len(main)
    d, one, two = [*main.tolist(), 1.0, 1.0], [*next_one.tolist(), 0.0, 0.0], [*next_two.tolist()]
    two += [0.0] * (n - len(two))
    for i in range(n):
        a, b = one[i] / d[i], two[i] / d[i]
        d[i + 1] -= a * one[i]
        d[i + 2] -= b * two[i]
        one[i + 1] -= a * two[i]
        one[i], two[i] = a, b
    columns = []
    for column in due.T.tolist():
        x = [*column, 0.0, 0.0]
        for i in range(n):
            x[i + 1] -= one[i] * x[i]
            x[i + 2] -= two[i] * x[i]
        for i in reversed(range(n)):
            x[i] = x[i] / d[i] - one[i] * x[i + 1] - two[i] * x[i + 2]
        columns.append(x[:n])
    return np.array(columns).T

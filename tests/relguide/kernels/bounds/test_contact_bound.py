"""Cells of contacts: none of their bounds lies above what is exact for any contact in them."""

from math import cos, hypot, inf, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad

from relguide.kernels.base.records import Pose, Velocity
from relguide.kernels.bounds.contact_bound import (
    between_bound,
    cell_bound,
    contacts_within,
    leaving_bound,
    round_bound,
    times_round,
    untouched_bound,
)
from relguide.kernels.contact.contact import contact_exists, contact_heading
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve, solve_toward
from tests.situations import numbers

FAR = 1e3
SLACK = 1e-7
"""Rounding of roots, and the 2 cm by which a breach must be certain, in R/V_P."""

ratios = st.one_of(numbers(0.3, 0.99), numbers(0.99, 1.2), st.sampled_from([1.0]))
limits = st.one_of(numbers(0.3, 1.0), numbers(1.0, 4.0))
sides = st.sampled_from([1.0, -1.0])


@st.composite
def cells(draw: st.DrawFn) -> tuple[float, float, float]:
    """A side, a bearing and half a width, within a quadrant."""
    parts = 2 ** draw(st.integers(1, 14))
    k = draw(st.integers(0, 4 * parts - 1))
    width = 0.5 * pi / parts
    return draw(sides), (k + 0.5) * width - pi, 0.5 * width


def row_of(
    x: float, y: float, h: float, to: tuple[float, float, float], ax: float, ay: float
) -> np.ndarray:
    """Words from a pose to a moving pose, in the slot frame."""
    c, s = cos(to[2]), sin(to[2])
    dx, dy = x - to[0], y - to[1]
    rows = np.empty((MAX_ROWS, 5))
    seen = Pose(dx * c + dy * s, dy * c - dx * s, (h - to[2]) % (2.0 * pi))
    n = solve_toward(seen, Velocity(ax * c + ay * s, ay * c - ax * s), 0.0, rows)
    return rows[:n]


def keeps(
    x: float, y: float, h: float, row: np.ndarray, leader: np.ndarray, alpha: float, delta: float
) -> bool:
    """Whether a word keeps the limit from a straight leader, sampled."""
    t = 0.0
    lx, ly, lh = leader[0, 1:4]
    for sign, amount in zip(SIGNS[int(row[1])], row[2:], strict=True):
        for along in np.linspace(0.0, amount, 300):
            px, py, _ = fly_piece(Pose(x, y, h), sign, along)
            now = alpha * (t + along)
            if hypot(px - lx - now * cos(lh), py - ly - now * sin(lh)) < delta:
                return False
        x, y, h = fly_piece(Pose(x, y, h), sign, amount)
        t += amount
    return True


@given(cell=cells(), alpha=ratios, delta=limits, share=numbers(-1.0, 1.0))
def test_a_cell_holds_its_contacts(
    cell: tuple[float, float, float], alpha: float, delta: float, share: float
) -> None:
    side, bearing, half = cell
    middle, differs, left, right = contacts_within(bearing, half, side, alpha, delta)
    b = bearing + share * half
    if not contact_exists(b, alpha):
        return
    h = contact_heading(b, side, alpha)
    assert abs(h - middle) <= differs + 1e-12
    for hand, blur in ((1.0, left), (-1.0, right)):
        moved = hypot(
            delta * (cos(b) - cos(bearing)) - hand * (sin(h) - sin(middle)),
            delta * (sin(b) - sin(bearing)) + hand * (cos(h) - cos(middle)),
        )
        assert moved <= blur + 1e-9


@given(
    start=st.tuples(numbers(-8.0, 8.0), numbers(-8.0, 8.0), numbers(0.0, 2.0 * pi)),
    cell=cells(), alpha=ratios, delta=limits, behind=numbers(0.0, 4.0), share=numbers(-1.0, 1.0),
)  # fmt: skip
def test_no_contact_of_a_cell_is_reached_or_left_sooner(
    start: tuple[float, float, float], cell: tuple[float, float, float], alpha: float,
    delta: float, behind: float, share: float,
) -> None:  # fmt: skip
    side, bearing, half = cell
    leader = np.array([[0.0, delta + behind, 0.0, 0.0, 0.0]])
    assume(hypot(start[0] - leader[0, 1], start[1]) > delta)
    soon, onward = cell_bound(
        *start, leader, 0, alpha, delta, 0.0, alpha, 0.0, side, bearing, half, 0.0, inf, FAR
    )
    leaving = leaving_bound(leader, alpha, delta, side, bearing, half, FAR)
    b = bearing + share * half
    if not contact_exists(b, alpha):
        return
    at = (
        leader[0, 1] + delta * cos(b), delta * sin(b), contact_heading(b, side, alpha),
    )  # fmt: skip
    to_it = row_of(*start, at, alpha, 0.0)
    rows = np.empty((MAX_ROWS, 5))
    on = rows[: solve(Pose(at[0], at[1], at[2] % (2.0 * pi)), alpha, 0.0, rows)]
    if not len(to_it) or not len(on) or to_it[0, 0] + on[0, 0] >= FAR:
        return
    assert onward <= on[0, 0] + SLACK * (1.0 + on[0, 0])
    for row in to_it:
        if row[0] + on[0, 0] < FAR and keeps(*start, row, leader, alpha, delta):
            assert soon <= row[0] + SLACK * (1.0 + row[0])
            break
    for row in on:
        if row[0] < FAR and keeps(*at, row, leader, alpha, delta - 1e-9):
            assert leaving <= row[0] + SLACK * (1.0 + row[0])
            break


@given(cells=st.tuples(cells(), cells()), alpha=ratios, delta=limits, shares=st.tuples(
    numbers(-1.0, 1.0), numbers(-1.0, 1.0)))  # fmt: skip
def test_no_contact_follows_another_sooner(
    cells: tuple[tuple[float, float, float], tuple[float, float, float]], alpha: float,
    delta: float, shares: tuple[float, float],
) -> None:  # fmt: skip
    (side, bearing, half), (other, to, wide) = cells
    lowest = between_bound(alpha, delta, side, bearing, half, other, to, wide, FAR)
    b, e = bearing + shares[0] * half, to + shares[1] * wide
    if not (contact_exists(b, alpha) and contact_exists(e, alpha)):
        return
    begin = delta * cos(b), delta * sin(b), contact_heading(b, side, alpha)
    end = delta * cos(e), delta * sin(e), contact_heading(e, other, alpha)
    rows = row_of(*begin, end, alpha, 0.0)
    if len(rows) and rows[0, 0] < FAR:
        assert lowest <= rows[0, 0] + SLACK * (1.0 + rows[0, 0])


@given(
    cells=st.tuples(cells(), cells()), alpha=numbers(0.3, 0.97), delta=limits,
    way=st.sampled_from([0, 1]), shares=st.tuples(numbers(-1.0, 1.0), numbers(-1.0, 1.0)),
)  # fmt: skip
def test_the_way_round_is_as_long_as_the_ride(
    cells: tuple[tuple[float, float, float], tuple[float, float, float]], alpha: float,
    delta: float, way: int, shares: tuple[float, float],
) -> None:  # fmt: skip
    (_, bearing, half), (_, to, wide) = cells
    lowest = round_bound(times_round(alpha, delta), way, bearing, half, to, wide)
    sign = 1.0 - 2.0 * way
    b, e = bearing + shares[0] * half, to + shares[1] * wide

    def slowness(angle: float) -> float:
        return delta / (
            sqrt(1.0 - (alpha * cos(angle)) ** 2) + sign * alpha * sin(angle)
        )  # fmt: skip

    turned = (sign * (e - b)) % (2.0 * pi)
    took, error = quad(lambda u: slowness(b + sign * u), 0.0, turned, limit=200)
    assert lowest <= took + error + 1e-9
    if min(half, wide) > 0.0 and lowest > 0.0 and max(half, wide) < 1e-3:
        assert lowest >= took - 4e-3 * delta / (1.0 - alpha) - 1e-4 * took


def test_who_touches_nothing_is_as_fast_as_an_extremal_that_keeps_clear() -> None:
    rng = np.random.default_rng(0)
    rows = np.empty((MAX_ROWS, 5))
    leader = np.array([[0.0, 1.2, 0.0, 0.0, 0.0]])
    barred = 0
    for _ in range(500):
        x, y, h = *rng.uniform(-8.0, 8.0, 2), rng.uniform(0.0, 2.0 * pi)
        if hypot(x - 1.2, y) < 1.1:
            continue
        n = solve(Pose(x, y, h), 0.8, 0.0, rows)
        clear = [row[0] for row in rows[:n] if keeps(x, y, h, row, leader, 0.8, 1.1)]
        lowest = untouched_bound(x, y, h, leader, 0.8, 1.1, 0.0, 0.8, 0.0)
        assert lowest <= min(clear, default=inf) + SLACK
        # or it has a full loop
        assert lowest == pytest.approx(min(clear, default=inf)) or lowest > 2.0 * pi
        barred += lowest > rows[0, 0]
    assert barred > 5

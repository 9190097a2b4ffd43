"""Cells of contacts: none of their bounds lies above what is exact for any contact in them."""

from collections import Counter
from math import cos, hypot, inf, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numba import njit
from scipy.integrate import quad

from relguide.kernels.base.records import Contact, Pose, Scene, Velocity
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import round_bound, times_round
from relguide.kernels.bounds.words.cell_words import word_between
from relguide.kernels.bounds.words.cells import Cell, contacts_within, turning_blur
from relguide.kernels.bounds.words.contact_bound import (
    anyhow,
    cell_bound,
    leaving_bound,
    otherwise,
    untouched_bound,
)
from relguide.kernels.bounds.words.found_word import all_open
from relguide.kernels.bounds.words.junction import beyond_outward, slide_turns
from relguide.kernels.bounds.words.sets import Goal
from relguide.kernels.bounds.words.word_bound import arrives_at_release
from relguide.kernels.contact.contact import (
    contact_exists,
    contact_heading,
    contact_on,
    to_frame_of,
)
from relguide.kernels.contact.paths_to_contact import paths_to_contact
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, straight_delays, turning_delays
from relguide.kernels.words.extremals import (
    MAX_ROWS,
    SIGNS,
    fly_piece,
    solve,
    solve_and_measure,
    solve_toward,
)
from tests.costates import with_costate
from tests.situations import numbers

FAR = 1e3
SLACK = 1e-7
"""Rounding of roots, and the 2 cm by which a breach must be certain, in R/V_P."""

ratios = st.one_of(numbers(0.3, 0.99), numbers(0.99, 1.2), st.sampled_from([1.0]))
limits = st.one_of(numbers(0.3, 1.0), numbers(1.0, 4.0))
sides = st.sampled_from([1.0, -1.0])


@st.composite
def cells(draw: st.DrawFn) -> Cell:
    """A window of bearings within a quadrant, at any time."""
    parts = 2 ** draw(st.integers(1, 14))
    k = draw(st.integers(0, 4 * parts - 1))
    width = 0.5 * pi / parts
    return Cell(0, draw(sides), (k + 0.5) * width - pi, 0.5 * width, 0.0, inf)


def straight(alpha: float, d_min: float, ahead: float) -> Scene:
    """A leader that keeps straight, so far ahead of the slot."""
    return Scene(np.array([[0.0, ahead, 0.0, 0.0, 0.0]]), alpha, d_min, 0.0)


def words_to(pose: Pose, to: Pose, alpha: float) -> np.ndarray:
    """Words from a pose to one that moves along the x axis."""
    seen, rows = to_frame_of(pose, to), np.empty((MAX_ROWS, 5))
    toward = Velocity(alpha * cos(to.h), -alpha * sin(to.h))
    n = solve_toward(seen._replace(h=seen.h % (2.0 * pi)), toward, 0.0, rows)
    return with_costate(rows[:n])


@njit(nogil=True)
def keeps(pose: Pose, row: FloatArray, scene: Scene) -> bool:
    """Whether a word keeps d_min, sampled."""
    t = 0.0
    for k in range(3):
        sign, amount = SIGNS[int(row[1]), k], row[2 + k]
        for i in range(300):
            along = amount * i / 299
            at = fly_piece(pose, sign, along)
            there = leader_at(scene, piece_at(scene.leader, t + along), t + along)
            if hypot(at.x - there.x, at.y - there.y) < scene.d_min:
                return False
        pose = fly_piece(pose, sign, amount)
        t += amount
    return True


@given(cell=cells(), alpha=ratios, d_min=limits, share=numbers(-1.0, 1.0))
def test_a_cell_holds_its_contacts(cell: Cell, alpha: float, d_min: float, share: float) -> None:
    spread = contacts_within(cell, alpha, d_min)
    b = cell.bearing + share * cell.half
    if not contact_exists(b, alpha):
        return
    h = contact_heading(b, cell.side, alpha)
    assert abs(h - spread.heading) <= spread.differs + 1e-12
    for hand, blur in ((1.0, spread.left), (-1.0, spread.right)):
        moved = hypot(
            d_min * (cos(b) - cos(cell.bearing)) - hand * (sin(h) - sin(spread.heading)),
            d_min * (sin(b) - sin(cell.bearing)) + hand * (cos(h) - cos(spread.heading)),
        )
        assert moved <= blur + 1e-9


@given(
    x=numbers(-8.0, 8.0), y=numbers(-8.0, 8.0), h=numbers(0.0, 2.0 * pi),
    cell=cells(), alpha=ratios, d_min=limits, behind=numbers(0.0, 4.0), share=numbers(-1.0, 1.0),
    closely=st.booleans(),
)  # fmt: skip
def test_no_contact_of_a_cell_is_reached_or_left_sooner(
    x: float, y: float, h: float, cell: Cell, alpha: float, d_min: float, behind: float,
    share: float, closely: bool,
) -> None:  # fmt: skip
    start, scene = Pose(x, y, h), straight(alpha, d_min, d_min + behind)
    assume(hypot(x - d_min - behind, y) > d_min)
    goal = Goal(0.0, alpha, False)
    passed, onward, _ = cell_bound(
        start, scene, goal, cell, FAR, closely, True, all_open(), all_open()
    )
    soon = anyhow(passed)
    leaving = anyhow(leaving_bound(scene, goal, cell, FAR, closely, all_open()))
    b = cell.bearing + share * cell.half
    if not contact_exists(b, alpha):
        return
    at = Pose(d_min + behind + d_min * cos(b), d_min * sin(b), contact_heading(b, cell.side, alpha))
    to_it, on = words_to(start, at, alpha), words_to(at, Pose(0.0, 0.0, 0.0), alpha)
    if not len(to_it) or not len(on) or to_it[0, 0] + on[0, 0] >= FAR:
        return
    assert onward <= on[0, 0] + SLACK * (1.0 + on[0, 0])
    _, most = slide_turns(scene, cell)
    for row in to_it:
        if SIGNS[int(row[1]), 2] == cell.side and most < 1.0 and row[4] > 0.0:
            continue  # it touches just before this contact, and not here
        if row[0] + on[0, 0] < FAR and keeps(start, row, scene):
            assert soon <= row[0] + SLACK * (1.0 + row[0])
            break
    for row in on:
        if SIGNS[int(row[1]), 0] == cell.side and most < 1.0 and row[2] > 0.0:
            continue
        if row[0] < FAR and keeps(at, row, scene._replace(d_min=d_min - 1e-9)):
            assert leaving <= row[0] + SLACK * (1.0 + row[0])
            break


@given(
    first=cells(), last=cells(), alpha=ratios, d_min=limits,
    shares=st.tuples(numbers(-1.0, 1.0), numbers(-1.0, 1.0)),
)  # fmt: skip
def test_no_contact_follows_another_sooner(
    first: Cell, last: Cell, alpha: float, d_min: float, shares: tuple[float, float]
) -> None:
    lowest = word_between(straight(alpha, d_min, 0.0), first, last, FAR, 0.0, 0.0, 0.0)
    poses = []
    for cell, share in zip((first, last), shares, strict=True):
        b = cell.bearing + share * cell.half
        if not contact_exists(b, alpha):
            return
        poses.append(Pose(d_min * cos(b), d_min * sin(b), contact_heading(b, cell.side, alpha)))
    rows = words_to(*poses, alpha)
    if len(rows) and rows[0, 0] < FAR:
        assert lowest <= rows[0, 0] + SLACK * (1.0 + rows[0, 0])


@given(
    first=cells(), last=cells(), alpha=numbers(0.3, 0.97), d_min=limits,
    way=st.sampled_from([0, 1]), shares=st.tuples(numbers(-1.0, 1.0), numbers(-1.0, 1.0)),
)  # fmt: skip
def test_the_time_round_is_that_of_the_boundary_arc(
    first: Cell, last: Cell, alpha: float, d_min: float, way: int, shares: tuple[float, float]
) -> None:
    lowest = round_bound(times_round(alpha, d_min), way, first, last)
    sign = 1.0 - 2.0 * way
    b, e = first.bearing + shares[0] * first.half, last.bearing + shares[1] * last.half

    def slowness(angle: float) -> float:
        return d_min / (sqrt(1.0 - (alpha * cos(angle)) ** 2) + sign * alpha * sin(angle))

    turned = (sign * (e - b)) % (2.0 * pi)
    took, error = quad(lambda u: slowness(b + sign * u), 0.0, turned, limit=200)
    assert lowest <= took + error + 1e-9
    if min(first.half, last.half) > 0.0 and lowest > 0.0 and max(first.half, last.half) < 1e-3:
        assert lowest >= took - 4e-3 * d_min / (1.0 - alpha) - 1e-4 * took


@pytest.mark.parametrize("way", [0, 1])
def test_between_cells_that_touch_no_time_passes(way: int) -> None:
    table, rng = times_round(0.6, 2.7), np.random.default_rng(4)
    for _ in range(2_000):
        # cells as halving makes them, of which one begins where the other one ends
        half, other_half = pi / 2.0 ** rng.integers(3, 16, 2)
        edge = rng.integers(-(2**12), 2**12) * pi / 2**12
        cell = Cell(0, 1.0, edge - half, half, 0.0, inf)
        other = Cell(0, 1.0, edge + other_half, other_half, 0.0, inf)
        pair = (cell, other) if way == 0 else (other, cell)
        if abs(cell.bearing) < pi and abs(other.bearing) < pi:
            assert round_bound(table, way, *pair) == 0.0


def test_who_touches_nothing_is_as_fast_as_an_extremal_that_keeps_clear() -> None:
    rng = np.random.default_rng(0)
    rows = np.empty((MAX_ROWS, 5))
    scene = straight(0.8, 1.1, 1.2)
    barred = 0
    for _ in range(500):
        x, y, h = *rng.uniform(-8.0, 8.0, 2), rng.uniform(0.0, 2.0 * pi)
        if hypot(x - 1.2, y) < 1.1:
            continue
        start = Pose(x, y, h)
        n = solve(start, 0.8, 0.0, rows)
        clear = [row[0] for row in rows[:n] if keeps(start, row, scene)]
        lowest = untouched_bound(start, scene, Goal(0.0, 0.8, False), inf)
        assert lowest <= min(clear, default=inf) + SLACK
        # or it has a full loop
        assert lowest == pytest.approx(min(clear, default=inf)) or lowest > 2.0 * pi
        barred += lowest > rows[0, 0]
    assert barred > 5


def turning(rng: np.random.Generator) -> Scene:
    """A leader that turns, then keeps straight along the x axis."""
    alpha, d_min = rng.uniform(0.4, 0.98), rng.uniform(0.3, 4.0)
    table = np.zeros((2, 5))
    table[0] = 0.0, *rng.uniform(-4.0, 4.0, 2), rng.uniform(-pi, pi), rng.choice((1.0, -1.0))
    table[0, 4] *= rng.uniform(0.2, 1.2)
    table[1, 0] = rng.uniform(1.0, 3.0)
    table[0, 3] = -table[0, 4] * table[1, 0]  # the final leg leads along the x axis
    scene = Scene(table, alpha, d_min, 0.0)
    table[1, 1:4] = leader_at(scene, 0, table[1, 0])
    return scene


def flown_backward(end: Pose, row: np.ndarray) -> Pose:
    """Where a path begins whose word ends there."""
    signs, amounts = SIGNS[int(row[1])], row[2:]
    for sign, amount in zip(signs[::-1], amounts[::-1], strict=True):
        # backward a turn is one to the other side, on the opposite heading
        back = fly_piece(Pose(end.x, end.y, end.h + pi), -sign, amount)
        end = Pose(back.x, back.y, back.h - pi)
    return end


def contact_with(scene: Scene, bearing: float, side: float, t: float) -> Pose:
    """The pose of a contact at d_min itself, the leader on its first piece."""
    there = leader_at(scene, 0, t)
    return Pose(
        there.x + scene.d_min * cos(there.h + bearing),
        there.y + scene.d_min * sin(there.h + bearing),
        there.h + contact_heading(bearing, side, scene.alpha),
    )


def test_a_contact_with_a_leader_that_turns_strays_no_further() -> None:
    rng = np.random.default_rng(5)
    nearly = 0
    for _ in range(2_000):
        scene = turning(rng)
        bearing, side, t = rng.uniform(-pi, pi), rng.choice((1.0, -1.0)), rng.uniform(0.0, 3.0)
        span, step = 4.0 * 0.5 ** rng.uniform(0.0, 12.0), 1e-5
        swing, strays = turning_blur(scene, scene.leader[0, 4], span)
        late = rng.choice((1.0, -1.0)) * span
        middle, before, after, end = (
            contact_with(scene, bearing, side, t + off) for off in (0.0, -step, step, late)
        )
        assert abs(end.h - middle.h) <= swing + 1e-12
        for hand in (1.0, -1.0):
            along = middle.x + late * (after.x - before.x) / (2.0 * step)
            across = middle.y + late * (after.y - before.y) / (2.0 * step)
            strayed = hypot(
                end.x - along - hand * (sin(end.h) - sin(middle.h)),
                end.y - across + hand * (cos(end.h) - cos(middle.h)),
            )
            assert strayed <= strays + 1e-8 * (1.0 + span)
            nearly += strayed > 0.9 * strays
    assert nearly > 100


@pytest.mark.parametrize("seed", range(4))
def test_no_contact_with_a_leader_that_turns_is_reached_or_left_sooner(seed: int) -> None:
    """Words are flown back from contacts at the edges of a cell, where it is widest in time."""
    rng = np.random.default_rng(seed)
    reached = left = kept = barred = 0
    for _ in range(4_000):
        scene = turning(rng)
        until = scene.leader[1, 0]
        half = 0.25 * pi * 0.5 ** rng.integers(2, 16)
        bearing = (rng.integers(0, round(2.0 * pi / (2.0 * half))) + 0.5) * 2.0 * half - pi
        middle, span = rng.uniform(0.1, 0.9) * until, until * 0.5 ** rng.integers(1, 8)
        window = max(middle - span, 0.0), min(middle + span, until)
        cell = Cell(0, rng.choice((1.0, -1.0)), bearing, half, *window)
        b, t = bearing + rng.choice((-1.0, 0.0, 1.0)) * half, rng.choice(window)
        contact = contact_with(scene, b, cell.side, t)
        amounts = rng.dirichlet((1.0, 1.0, 1.0)) * t
        row = np.array((t, rng.integers(0, 6), *amounts))
        start = flown_backward(contact, row)
        goal = Goal(rng.uniform(-6.0, 6.0), rng.choice((scene.alpha, 0.0, 1.0)), False)
        closely = bool(rng.integers(2))
        passed, onward, _ = cell_bound(
            start, scene, goal, cell, FAR, closely, True, all_open(), all_open()
        )
        soon = anyhow(passed)
        rows = np.empty((MAX_ROWS, 5))
        on = Pose(contact.x - goal.x - goal.speed * t, contact.y, contact.h % (2.0 * pi))
        if solve(on, goal.speed, 0.0, rows) == 0 or rows[0, 0] >= 100.0:
            continue
        assert onward <= rows[0, 0] + SLACK * (1.0 + rows[0, 0])
        left += 1
        later = scene._replace(leader=scene.leader - np.array([t, 0.0, 0.0, 0.0, 0.0]))
        leaving = anyhow(leaving_bound(scene, goal, cell, FAR, closely, all_open()))
        _, most = slide_turns(scene, cell)
        for some in with_costate(rows[: solve(on, goal.speed, 0.0, rows)]):
            if SIGNS[int(some[1]), 0] == cell.side and most < 1.0 and some[2] > 0.0:
                continue  # it touches just after this contact, and not here
            if some[0] < 50.0 and keeps(contact, some, later._replace(d_min=scene.d_min - 1e-9)):
                assert leaving <= some[0] + SLACK * (1.0 + some[0])
                kept += 1
                break
            barred += leaving > some[0] + 0.1
        inside = scene._replace(d_min=scene.d_min - SLACK)
        if SIGNS[int(row[1]), 2] == cell.side and most < 1.0:
            continue
        if len(with_costate(row[None])) and keeps(start, row, inside):
            assert soon <= t + SLACK * (1.0 + t)
            reached += 1
    assert left > 3_000
    assert reached > 300
    assert kept > 300
    assert barred > 30


def lone_contact(rng: np.random.Generator) -> tuple[Scene, Cell, float, Pose]:
    """A contact with a leader that turns, in a cell that holds hardly more; its time and pose."""
    scene, half = turning(rng), 1e-6
    bearing, side = rng.uniform(-pi, pi), rng.choice((1.0, -1.0))
    t = rng.uniform(0.3, 0.9) * scene.leader[1, 0]
    cell = Cell(0, side, bearing, half, t - half, t + half)
    return scene, cell, t, contact_with(scene, bearing, side, t)


def test_who_turns_away_at_a_contact_is_told_from_who_turns_toward_the_leader() -> None:
    """Paths to a contact, and from one, by the turn there: none sooner than what is said of it."""
    rng = np.random.default_rng(12)
    there = toward = gone = apart = 0
    for _ in range(3_000):
        scene, cell, t, contact = lone_contact(rng)
        least, _ = slide_turns(scene, cell)
        side = cell.side
        # LSL or RSR: away from the leader, which is to the left if it is passed counter-clockwise,
        # or toward it
        turned = rng.uniform(0.05, 0.8) * t
        ahead = rng.uniform(0.05, 0.9) * (t - turned)
        away = bool(rng.integers(2))
        word = np.array((t, 1 if (side > 0.0) == away else 0, t - turned - ahead, ahead, turned))
        start = flown_backward(contact, word)
        goal = Goal(rng.uniform(-6.0, 6.0), scene.alpha, False)
        if turned < 2.0 * pi and keeps(start, word, scene):
            passed, onward, _ = cell_bound(
                start, scene, goal, cell, FAR, True, True, all_open(), all_open()
            )
            if onward < inf and away:
                more = min(2.0 * pi - turned, beyond_outward(scene, cell, 1.0))
                assert passed.outward <= t + 1e-4
                assert passed.turned <= t + more + 1e-4
                there += passed.turned > t + 0.5 * more
            elif onward < inf and least > 1.0:
                assert passed.inward <= t + 1e-4
                toward += 1
        rows = np.empty((MAX_ROWS, 5))
        on = Pose(contact.x - goal.x - goal.speed * t, contact.y, contact.h % (2.0 * pi))
        later = scene._replace(leader=scene.leader - np.array([t, 0.0, 0.0, 0.0, 0.0]))
        for row in rows[: solve(on, goal.speed, 0.0, rows)]:
            hand = SIGNS[int(row[1]), 0]
            if SIGNS[int(row[1]), 1] == 0.0 and keeps(contact, row, later):
                left = leaving_bound(scene, goal, cell, FAR, True, all_open())
                if hand == -side:
                    more = min(2.0 * pi - row[2], beyond_outward(scene, cell, -1.0))
                    assert left.outward <= row[0] + 1e-4
                    assert left.turned <= row[0] + more + 1e-4
                    gone += left.turned > row[0] + 0.5 * more
                elif least > 1.0:
                    assert left.inward <= row[0] + 1e-4
                    apart += left.outward > row[0] + 0.1
                break
    assert there > 50
    assert toward > 50
    assert gone > 50
    assert apart > 20


def test_who_goes_straight_past_a_contact_is_told_too() -> None:
    rng = np.random.default_rng(13)
    past = left = 0
    for _ in range(3_000):
        scene, cell, t, contact = lone_contact(rng)
        if slide_turns(scene, cell)[0] < 0.0:
            continue
        turned = rng.uniform(0.05, 0.9) * t
        word = np.array((t, rng.integers(2), turned, t - turned, 0.0))
        start = flown_backward(contact, word)
        goal = Goal(rng.uniform(-6.0, 6.0), scene.alpha, False)
        if keeps(start, word, scene):
            passed, onward, _ = cell_bound(
                start, scene, goal, cell, FAR, True, True, all_open(), all_open()
            )
            if onward < inf:
                assert otherwise(passed) <= passed.tangent <= t + 1e-4
                past += 1
        ahead, bend = rng.uniform(0.1, 4.0), rng.uniform(0.1, 3.0)
        later = scene._replace(leader=scene.leader - np.array([t, 0.0, 0.0, 0.0, 0.0]))
        row = np.array((ahead + bend, 0, 0.0, ahead, bend))
        end = fly_piece(fly_piece(contact, 0.0, ahead), 1.0, bend)
        # seen along the heading on which it ends
        c, s = cos(end.h), sin(end.h)
        table = scene.leader.copy()
        table[:, 1], table[:, 2] = (
            scene.leader[:, 1] * c + scene.leader[:, 2] * s,
            scene.leader[:, 2] * c - scene.leader[:, 1] * s,
        )
        table[:, 3] -= end.h
        table[:, 2] -= end.y * c - end.x * s
        if keeps(contact, row, later):
            speed = rng.uniform(0.0, 1.0)
            goal = Goal(end.x * c + end.y * s - speed * (t + ahead + bend), speed, False)
            seen = scene._replace(leader=table)
            assert (
                leaving_bound(seen, goal, cell, FAR, True, all_open()).tangent
                <= ahead + bend + 1e-4
            )
            left += 1
    assert past > 50
    assert left > 50


def test_no_contact_follows_a_turn_away_sooner() -> None:
    """From contact to contact by three turns or a straight, the first and the last one away."""
    rng = np.random.default_rng(14)
    for _ in range(2_000):
        alpha, d_min = rng.uniform(0.3, 0.97), rng.uniform(0.3, 4.0)
        scene = straight(alpha, d_min, 0.0)
        begun, ended = rng.uniform(-pi, pi, 2)
        sides = rng.choice((1.0, -1.0), 2)
        at = contact_with(scene, begun, sides[0], 0.0)
        rows = np.empty((MAX_ROWS, 5))
        to = contact_with(scene, ended, sides[1], 0.0)
        seen = to_frame_of(at, to)
        toward = Velocity(alpha * cos(to.h), -alpha * sin(to.h))
        n = solve_toward(seen._replace(h=seen.h % (2.0 * pi)), toward, 0.0, rows)
        half = 1e-7
        first, last = (
            Cell(0, side, bearing, half, 0.0, inf)
            for bearing, side in ((begun, sides[0]), (ended, sides[1]))
        )
        for row in rows[:n]:
            signs = SIGNS[int(row[1])]
            after = row[2] if signs[0] == -sides[0] else 0.0
            before = row[4] if signs[2] == -sides[1] else 0.0
            for shares in ((1.0, 0.0), (0.0, 1.0), (1.0, 1.0), rng.uniform(0.0, 1.0, 2)):
                took = word_between(
                    scene, first, last, FAR, after * shares[0], before * shares[1], 0.0
                )
                assert took <= row[0] + 1e-4


@pytest.mark.parametrize("seed", range(2))
def test_no_contact_follows_another_sooner_while_the_leader_turns(seed: int) -> None:
    rng = np.random.default_rng(seed)
    met = 0
    for _ in range(1_500):
        scene = turning(rng)
        cells, contacts = [], []
        for piece in (0, rng.integers(0, 2)):
            half = 0.25 * pi * 0.5 ** rng.integers(2, 16)
            bearing = (rng.integers(0, round(pi / half)) + 0.5) * 2.0 * half - pi
            start, end = (0.0, scene.leader[1, 0]) if piece == 0 else (scene.leader[1, 0], 9.0)
            span = 0.5 * (end - start) * 0.5 ** rng.integers(0, 8)
            middle = start + span + rng.uniform() * (end - start - 2.0 * span)
            cell = Cell(piece, rng.choice((1.0, -1.0)), bearing, half, middle - span, middle + span)
            b, t = bearing + rng.choice((-1.0, 0.0, 1.0)) * half, rng.uniform(cell.start, cell.end)
            cells.append(cell)
            contacts.append((Contact(int(piece), b, cell.side), t))
        (contact, t), (other, _) = contacts
        rows = np.empty((MAX_ROWS, 5))
        n = paths_to_contact(contact_on(scene, contact, t), t, scene, other, inf, rows)
        for row in rows[:n]:
            if cells[1].start <= row[0] <= cells[1].end:
                assert word_between(scene, *cells, FAR, 0.0, 0.0, 0.0) <= row[0] - t + 1e-5
                met += 1
    assert met > 100


def test_who_is_there_as_the_slot_opens_is_who_a_delay_leads_there() -> None:
    """Both ways: a path of just that length is found if and only if the closed test allows one."""
    rng = np.random.default_rng(3)
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    seen: Counter[tuple[bool, bool]] = Counter()
    for _ in range(4_000):
        x, y, h = *rng.uniform(-4.0, 4.0, 2), rng.uniform(0.0, 2.0 * pi)
        alpha, t_release = rng.uniform(0.4, 0.98), rng.uniform(0.5, 12.0)
        rows = np.empty((MAX_ROWS, 5))
        _, shortest = solve_and_measure(x, y, h, alpha, t_release, rows)
        n = straight_delays(Pose(x, y, h), alpha, t_release, paths)
        found = turning_delays(Pose(x, y, h), alpha, t_release, paths, n) > 0
        assert found == arrives_at_release(x, y, h, alpha, t_release)
        seen[shortest <= t_release, found] += 1
    assert set(seen) == {(False, False), (True, False), (True, True)}
    assert seen[True, False] > 20

"""A bound for a set of poses never lies above the exact time from any pose of it."""

from math import cos, hypot, inf, pi, sin

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.bounds.words.breach import Flown, NearWord, Sieve, breach_time, breaks_limit
from relguide.kernels.bounds.words.found_word import Junction, all_open
from relguide.kernels.bounds.words.intervals import intercept_span
from relguide.kernels.bounds.words.sets import Blur, fixed, unknown_sensitivity
from relguide.kernels.bounds.words.word_bound import soonest, soonest_by_turn
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, WORDS, fly_piece, solve_toward
from tests.costates import with_costate
from tests.situations import numbers

ROUNDING = 1e-9
NOBODY = np.array([[0.0, 1e6, 1e6, 0.0, 0.0]])
"""A leader that is nowhere near."""
NO_SIEVE = Sieve(False, Pose(0.0, 0.0, 0.0), 0.0, Scene(NOBODY, 0.5, 0.0, 0.0), 1.0, 0.0, 0.0)

places = st.one_of(numbers(-3.0, 3.0), numbers(-40.0, 40.0), st.sampled_from([0.0, 1.0, 2.0, 4.0]))
courses = st.one_of(
    numbers(0.0, 2.0 * pi), st.sampled_from([0.0, 1e-7, 0.5 * pi, pi, 1.5 * pi, 2.0 * pi - 1e-7])
)
ratios = st.one_of(numbers(0.0, 0.99), numbers(0.9, 1.2), st.sampled_from([0.0, 1.0]))
blurs = st.one_of(st.just(0.0), numbers(0.0, 1e-3), numbers(0.0, 0.7))


def bound(
    pose: tuple[float, float, float], a: tuple[float, float], blur: float, turn: float,
    not_before: float = 0.0, beat: float = inf,
) -> float:  # fmt: skip
    return soonest(
        Pose(*pose),
        Blur(blur, blur, turn, 0.0, unknown_sensitivity(), unknown_sensitivity()),
        Velocity(*a),
        Window(not_before, beat),
        NO_SIEVE,
    )


def exact(x: float, y: float, h: float, a: tuple[float, float], not_before: float) -> np.ndarray:
    rows = np.empty((MAX_ROWS, 5))
    n = solve_toward(Pose(x, y, h % (2.0 * pi)), Velocity(*a), not_before, rows)
    return with_costate(rows[:n])


@given(
    pose=st.tuples(places, places, courses),
    ratio=ratios,
    toward=courses,
    blur=blurs,
    turn=blurs,
    not_before=st.one_of(st.just(0.0), numbers(0.0, 20.0)),
    beat=st.one_of(st.just(inf), numbers(0.1, 30.0)),
    picks=st.lists(
        st.tuples(numbers(0.0, 1.0), courses, st.one_of(numbers(-1.0, 1.0), st.just(0.0))),
        min_size=1,
        max_size=6,
    ),
)
def test_no_pose_of_the_set_meets_the_target_sooner(
    pose: tuple[float, float, float], ratio: float, toward: float, blur: float, turn: float,
    not_before: float, beat: float, picks: list[tuple[float, float, float]],
) -> None:  # fmt: skip
    a = ratio * cos(toward), ratio * sin(toward)
    # from `beat` on nothing is promised
    lowest = min(bound(pose, a, blur, turn, not_before, beat), beat)
    x, y, h = pose
    for far, way, share in picks:
        course = h + share * turn
        for side in (1.0, -1.0):
            # the centre of that side's circle is displaced, and the pose is wherever that puts it
            cx = x - side * sin(h) + far * blur * cos(way)
            cy = y + side * cos(h) + far * blur * sin(way)
            at = cx + side * sin(course), cy - side * cos(course)
            for row in exact(*at, course, a, not_before):
                if (WORDS[int(row[1])][0] == "L") == (side > 0.0):
                    assert row[0] >= lowest - ROUNDING * (1.0 + row[0])


@given(
    pose=st.tuples(places, places, courses),
    ratio=ratios,
    toward=courses,
    blur=blurs,
    turn=blurs,
    way=courses,
    share=st.one_of(st.sampled_from([-1.0, 0.0, 1.0]), numbers(-1.0, 1.0)),
)
def test_no_word_of_a_pose_at_the_edge_of_the_set_is_ruled_out(
    pose: tuple[float, float, float], ratio: float, toward: float, blur: float, turn: float,
    way: float, share: float,
) -> None:  # fmt: skip
    a = ratio * cos(toward), ratio * sin(toward)
    x, y, h = pose
    for row in exact(x, y, h, a, 0.0):
        side = 1.0 if WORDS[int(row[1])][0] == "L" else -1.0
        course = h - share * turn
        cx = x - side * sin(h) - blur * cos(way)
        cy = y + side * cos(h) - blur * sin(way)
        middle = cx + side * sin(course), cy - side * cos(course), course
        # in so narrow a window of time there is nothing but this word
        slack = 1e-6 * (1.0 + row[0])
        if row[0] < 1e6:
            found = bound(middle, a, blur, turn, row[0] - slack, row[0] + slack)
            assert found <= row[0] + slack


def test_of_a_single_pose_it_is_the_exact_time() -> None:
    rng = np.random.default_rng(0)
    for _ in range(1_000):
        pose = *(rng.normal(size=2) * rng.choice([1.0, 5.0, 30.0])), rng.uniform(0.0, 2.0 * pi)
        a = tuple(rng.uniform(0.0, 0.9) * np.array([cos(pose[2] + 1.0), sin(pose[2] + 1.0)]))
        not_before = rng.choice([0.0, rng.uniform(0.0, 20.0)])
        lowest = bound(pose, a, 0.0, 0.0, not_before)
        time = min(exact(*pose, a, not_before)[:, 0], default=inf)
        if time == inf:
            assert lowest == inf
            continue
        assert time - 1e-4 * (1.0 + time) <= lowest <= time + ROUNDING * (1.0 + time)


def test_words_leave_a_pose_as_the_junction_asks() -> None:
    """Of single poses, against all words of them; those on a straight have been turned back to."""
    rng = np.random.default_rng(8)
    straight = turned = barred = 0
    for case in range(4_000):
        a = rng.uniform(0.0, 0.9), rng.uniform(-0.3, 0.3)
        x, y, h = *rng.uniform(-4.0, 4.0, 2), rng.uniform(0.0, 2.0 * pi)
        if case % 2 == 0:  # it is met after a straight and a turn
            flown, bend, sign = rng.uniform(0.2, 4.0), rng.uniform(0.1, 6.0), rng.choice((1, -1))
            end = fly_piece(fly_piece(Pose(0.0, 0.0, 0.0), 0.0, flown), sign, bend)
            # so that the target, which heads along the x axis, is met on its heading
            h = -end.h % (2.0 * pi)
            x = -end.x * cos(h) + end.y * sin(h) + a[0] * (flown + bend)
            y = -end.x * sin(h) - end.y * cos(h) + a[1] * (flown + bend)
        rows, outward, beyond = exact(x, y, h, a, 0.0), int(rng.integers(2)), rng.uniform(0.0, 6.0)
        inward = bool(rng.integers(2))
        leaving = soonest_by_turn(
            Pose(x, y, h), Blur(0.0, 0.0, 0.0, 0.0, fixed(), fixed()), Velocity(*a),
            Window(0.0, inf), NO_SIEVE,
            Junction(True, outward, beyond, True, inward, True), all_open(), False,
        )  # fmt: skip
        for row in rows:
            word, (first, middle, last) = WORDS[int(row[1])], row[2:]
            slack = ROUNDING * (1.0 + row[0])
            if first < 1e-9:
                straight += 1
                assert leaving.tangent <= row[0] + slack
                continue
            assert (leaving.left if word[0] == "L" else leaving.right) <= row[0] + slack
            if (word[0] == "L") == (outward == 0):
                turned += 1
                whole = 2.0 * pi if word[1] == "S" else middle
                free = middle < 1e-6 if word[1] == "S" else last < 1e-6
                more = 0.0 if free else min(whole - first, beyond)
                assert leaving.lasting <= row[0] + more + slack
            elif not inward and min(middle, last) > 1e-6:
                barred += row[0] < leaving.tangent - 1e-6
        assert min(leaving.left, leaving.right) <= np.min(rows[:, 0], initial=inf) + 1e-6
        if leaving.tangent < inf and case % 2 and not inward:
            assert np.min(rows[:, 2]) < 1e-5
    assert straight > 1_000
    assert turned > 5_000
    assert barred > 100


@given(
    e=st.tuples(places, places), ratio=ratios, toward=courses, blur=blurs, far=numbers(0.0, 1.0),
    way=courses,
)  # fmt: skip
def test_an_interception_lies_within_its_span(
    e: tuple[float, float], ratio: float, toward: float, blur: float, far: float, way: float
) -> None:
    ax, ay = ratio * cos(toward), ratio * sin(toward)
    least, greatest = intercept_span(*e, Velocity(ax, ay), blur)
    ex, ey = e[0] + far * blur * cos(way), e[1] + far * blur * sin(way)
    for l in np.roots([1.0 - ratio * ratio, -2.0 * (ax * ex + ay * ey), -(ex * ex + ey * ey)]):
        is_real = abs(l.imag) < 1e-12 * max(hypot(ex, ey), abs(l.real))
        if is_real and 0.0 <= l.real < 1e6:
            slack = 1e-6 * (1.0 + l.real)
            assert least - slack <= l.real <= greatest + slack


@given(
    word=st.integers(0, 5), first=numbers(0.0, 6.0), middle=numbers(0.0, 6.0),
    last=numbers(0.0, 6.0), blurs=st.tuples(numbers(0.0, 0.3), numbers(0.0, 0.3)),
    shares=st.tuples(numbers(-1.0, 1.0), numbers(-1.0, 1.0)), start=st.tuples(places, places),
    leader=courses, limit=numbers(0.1, 3.0),
    rate=st.one_of(numbers(-1.0, 1.0), st.sampled_from([0.0, 9e-7, -2e-6])),
    guess=st.one_of(st.just(inf), numbers(0.0, 20.0)),
)  # fmt: skip
def test_a_breach_is_never_made_up(
    word: int, first: float, middle: float, last: float, blurs: tuple[float, float],
    shares: tuple[float, float], start: tuple[float, float], leader: float, limit: float,
    rate: float, guess: float,
) -> None:  # fmt: skip
    signs = tuple(SIGNS[word].tolist())
    table = np.array([[0.0, 0.0, 0.0, leader, rate], [5.0, 0.0, 0.0, 0.0, 0.0]])
    scene = Scene(table, 0.7, limit, 0.0)
    table[1, 1:4] = leader_at(scene, 0, 5.0)
    until = first + middle + last
    near = NearWord(signs, first, blurs[0], middle, blurs[1], until)
    on = Flown(0.0, 1.0, 0.0, 0.0)
    breach = breach_time(Pose(*start, 0.0), near, on, scene, 0.02, guess)
    if breaks_limit(Pose(*start, 0.0), near, on, scene, 0.02):
        assert breach < until  # a guess may find one where none was seen, and misses none
    if breach == inf:
        return
    amounts = (
        max(first + shares[0] * blurs[0], 0.0),
        max(middle + shares[1] * blurs[1], 0.0),
        20.0,
    )
    closest, x, y, h, t = inf, *start, 0.0, 0.0
    for sign, amount in zip(signs, amounts, strict=True):
        for along in np.linspace(0.0, min(amount, until - t), 400):
            px, py, _ = fly_piece(Pose(x, y, h), sign, along)
            lx, ly, _ = leader_at(scene, 0 if t + along < 5.0 else 1, t + along)
            closest = min(closest, float(np.hypot(px - lx, py - ly)))
        x, y, h = fly_piece(Pose(x, y, h), sign, amount)
        t += amount
        if t >= until:
            break
    assert closest < limit + 0.05  # sampled every 0.015 R


def test_a_breach_is_where_it_is_said_to_be() -> None:
    """Of single words, beside leaders that turn and then keep straight."""
    rng = np.random.default_rng(4)
    breaches = 0
    for _ in range(2_000):
        table = np.zeros((2, 5))
        table[0, 3:] = rng.uniform(0.0, 6.0), rng.uniform(-1.0, 1.0)
        scene = Scene(table, 0.7, rng.uniform(0.1, 3.0), 0.0)
        table[1] = 5.0, *leader_at(scene, 0, 5.0), 0.0
        signs, amounts = tuple(SIGNS[rng.integers(6)].tolist()), rng.uniform(0.0, 6.0, 3)
        start = Pose(*rng.uniform(-4.0, 4.0, 2), rng.uniform(0.0, 6.0))
        word = NearWord(signs, amounts[0], 0.0, amounts[1], 0.0, sum(amounts))
        t = breach_time(start, word, Flown(0.0, 1.0, 0.0, 0.0), scene, 0.02, rng.uniform(0.0, 9.0))
        if t == inf:
            continue
        breaches += 1
        at, left = start, t
        for sign, amount in zip(signs, amounts, strict=True):
            at = fly_piece(at, sign, min(amount, left))
            left -= min(amount, left)
        there = leader_at(scene, 0 if t < 5.0 else 1, t)
        assert hypot(at.x - there.x, at.y - there.y) < scene.d_min
    assert breaches > 400

"""Isochrones: the times are those of plan, the lines lie on their levels and keep off jumps."""

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest

from relguide import LEFT, RIGHT, FlyStraight, Leader, Plan, Pursuer, Situation, TurnTo, Wind, plan
from relguide.kernels.maps.field import DELAY
from relguide.maps.constrained_times import CONSTRAINED
from relguide.maps.contours import JUMP, TOLERANCE, Contour, Field
from relguide.maps.isochrones import (
    MAX_LEVELS,
    NAMES,
    Grid,
    Isochrones,
    isochrones,
    round_levels,
    times_around,
)
from relguide.planning.words import candidates
from relguide.units import DEG

STRAIGHT = Situation(
    pursuer=Pursuer(x=-40e3, y=40e3, heading=100 * DEG, tas=240.0, max_bank=25 * DEG),
    leader=Leader(x=3e3, y=-2e3, heading=60 * DEG, tas=200.0),
    slot_distance=12e3,
    min_separation=9260.0,
    wind=Wind(east=20.0, north=-8.0),
)
TURNING = replace(
    STRAIGHT,
    leader=replace(
        STRAIGHT.leader,
        intent=(
            FlyStraight(duration=60.0),
            TurnTo(heading=150 * DEG, turn=RIGHT, bank=20 * DEG),
        ),
    ),
)
GRID = Grid(x=0.0, y=0.0, columns=64, rows=48)
CASES = pytest.mark.parametrize("situation", [STRAIGHT, TURNING], ids=["straight", "turning"])


def move(situation: Situation, x: float, y: float) -> Situation:
    return replace(situation, pursuer=replace(situation.pursuer, x=float(x), y=float(y)))


def nodes(grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.meshgrid(*grid.axes)
    return x.ravel(), y.ravel()


@pytest.fixture(scope="module")
def drawn() -> dict[Situation, Isochrones]:
    return {situation: isochrones(situation, GRID) for situation in (STRAIGHT, TURNING)}


@CASES
def test_times_are_those_of_plan(situation: Situation, drawn: dict[Situation, Isochrones]) -> None:
    field, (x, y) = drawn[situation].field, nodes(GRID)
    rng = np.random.default_rng(4)
    seen = set()
    free, limited = ~field.limited & (field.words != DELAY), field.limited
    for nodes_of, most in ((free, 60), (limited, 6), (field.words == DELAY, 6)):
        chosen = np.flatnonzero(nodes_of)
        for i in rng.choice(chosen, min(most, len(chosen)), replace=False):
            answer = plan(move(situation, x[i], y[i]))
            if not isinstance(answer, Plan):
                assert field.time[i] == inf
                continue
            time, word = field.time[i], NAMES[field.words[i]]
            bound = answer.optimality.lower_bound
            if abs(field.lower_bound[i] - bound) > 1e-6:  # no path arrives just as the slot opens
                assert field.lower_bound[i] < bound
                assert not candidates(answer.situation).reachable_at_release
            if limited[i]:
                assert answer.time_to_converge <= time + 1e-6
                assert answer.time_to_converge >= field.lower_bound[i] - 1e-6
            else:
                assert time == pytest.approx(answer.time_to_converge, abs=1e-6)
                assert answer.optimality.proof == "relaxation"
                assert word in (answer.word, "delay")
            seen.add(word)
    assert len(seen) >= 4
    assert ("delay" in seen) == bool(situation.leader.intent)


@CASES
def test_a_time_is_that_of_a_plan_or_infinite(
    situation: Situation, drawn: dict[Situation, Isochrones]
) -> None:
    field = drawn[situation].field
    assert np.all(field.lower_bound <= field.time)
    assert np.all((field.time < inf) == (field.words < NAMES.index("")))
    assert np.all(field.proved <= (field.time == field.lower_bound))
    assert field.proved.mean() > 0.8
    assert field.limited.any()
    lost = np.hypot(nodes(GRID)[0] - 3e3, nodes(GRID)[1] + 2e3) < situation.min_separation - 1.0
    assert np.all(field.time[lost] == inf)


def test_the_mirror_image_takes_as_long() -> None:
    north = replace(
        TURNING,
        leader=replace(TURNING.leader, x=0.0, y=0.0, heading=0.0),
        wind=Wind(),
    )
    east = replace(
        north,
        pursuer=replace(north.pursuer, heading=2.0 * pi - north.pursuer.heading),
        leader=replace(
            north.leader,
            intent=(
                FlyStraight(duration=60.0),
                TurnTo(heading=210 * DEG, turn=LEFT, bank=20 * DEG),
            ),
        ),
    )
    x, y = nodes(GRID)
    one, other = times_around(north)(x, y), times_around(east)(-x, y)
    near = ~np.isclose(one.lower_bound, other.lower_bound, rtol=0.0, atol=1e-6)
    assert near.mean() < 1e-3  # a node on a jump falls to either side by rounding
    both = (one.time < inf) & (other.time < inf)
    assert np.isclose(one.time[both], other.time[both], rtol=0.0, atol=1e-6).mean() > 0.999
    assert (one.time < inf).sum() == pytest.approx((other.time < inf).sum(), abs=5)


def vertices(contours: tuple[Contour, ...]) -> tuple[np.ndarray, np.ndarray]:
    points = [line for contour in contours for line in contour.lines]
    levels = [np.full(len(line), c.level) for c in contours for line in c.lines]
    return np.concatenate(points), np.concatenate(levels)


@CASES
def test_vertices_lie_on_their_levels(
    situation: Situation, drawn: dict[Situation, Isochrones]
) -> None:
    points, levels = vertices(drawn[situation].contours)
    assert len(points) > 300
    off = times_around(situation)(points[:, 0], points[:, 1]).time - levels
    # a vertex on the brink of a jump may fall off it by the rounding of its place
    assert np.mean(abs(off) <= TOLERANCE + 1e-3) > 0.999


@CASES
def test_no_line_crosses_a_jump(situation: Situation, drawn: dict[Situation, Isochrones]) -> None:
    evaluate = times_around(situation)
    tried = 0
    for contour in drawn[situation].contours:
        for line in contour.lines:
            assert len(line) > 1
            for share in (0.5, 0.25, 0.75):
                at = line[:-1] * (1.0 - share) + line[1:] * share
                off = abs(evaluate(at[:, 0], at[:, 1]).time - contour.level)
                tried += len(off)
                assert np.all(off <= (JUMP + 1e-6 if share == 0.5 else 2.0 * JUMP))
    assert tried > 900


@CASES
def test_regions_tile_the_grid(situation: Situation, drawn: dict[Situation, Isochrones]) -> None:
    def shoelace(ring: np.ndarray) -> float:
        (x, y), (u, v) = ring[:-1].T, ring[1:].T
        return 0.5 * float(np.sum(x * v - u * y))

    regions = drawn[situation].regions
    covered = 0.0
    for region in regions:
        for outline, *holes in region.polygons:
            assert np.array_equal(outline[0], outline[-1])
            covered += abs(shoelace(outline)) - sum(abs(shoelace(hole)) for hole in holes)
    # where three regions meet in a cell, its middle is left out
    assert 0.97 < covered / (GRID.width * GRID.height) <= 1.0 + 1e-9
    assert {region.word for region in regions} >= {"LSL", "RSR", "LSR", "RSL", ""}
    assert {region.limited for region in regions} == {False, True}


def test_an_outline_is_where_the_word_changes(drawn: dict[Situation, Isochrones]) -> None:
    evaluate = times_around(STRAIGHT)
    step = np.array((GRID.width / (GRID.columns - 1), GRID.height / (GRID.rows - 1)))
    (region,) = (r for r in drawn[STRAIGHT].regions if (r.word, r.limited) == ("RSL", False))
    number = NAMES.index("RSL")
    _, y = GRID.axes
    changes = []
    for ring in (ring for polygon in region.polygons for ring in polygon):
        inner = (abs(ring) < 0.49 * np.array((GRID.width, GRID.height))).all(axis=1)
        for px, py in ring[inner]:
            row = (py - y[0]) / step[1]
            along = np.array((1.0, 0.0)) if abs(row - round(row)) < 1e-6 else np.array((0.0, 1.0))
            ends = np.array([(px, py)] * 2) + np.outer((-0.1251, 0.1251), along * step)
            found = evaluate(ends[:, 0], ends[:, 1])
            inside = (found.words == number) & ~found.limited
            changes.append(inside[0] != inside[1])
    assert np.mean(changes) > 0.9  # the rest has a third word on its edge


def test_an_exact_area_is_that_of_plan_where_the_limit_binds() -> None:
    grid = Grid(x=3e3, y=-2e3, width=60e3, height=45e3, columns=12, rows=9)
    counted: list[int] = []
    fast = isochrones(STRAIGHT, grid).field
    exact = isochrones(STRAIGHT, grid, exact=True, progress=counted.append)
    x, y = nodes(grid)
    binding = np.flatnonzero(fast.limited)
    assert sum(counted) == len(binding) > 0
    for i in binding.tolist():
        answer = plan(move(STRAIGHT, x[i], y[i]))
        expected = answer.time_to_converge if isinstance(answer, Plan) else inf
        assert exact.field.time[i] == pytest.approx(expected, abs=1e-2)
    better = exact.field.time < fast.time
    assert better.any()
    assert np.all(exact.field.words[better] == CONSTRAINED)
    assert np.array_equal(exact.field.time[~fast.limited], fast.time[~fast.limited])


def test_any_times_will_do() -> None:
    def cone(x: np.ndarray, y: np.ndarray) -> Field:
        time = np.hypot(x, y) / 100.0
        word = np.where(x > 0.0, 0, 1).astype(np.int8)
        return Field(time=time, lower_bound=time, words=word, limited=np.zeros(len(x), bool))

    area = isochrones(STRAIGHT, GRID, [300.0], evaluate=cone)
    ((line,),) = (contour.lines for contour in area.contours)
    assert np.array_equal(line[0], line[-1])
    assert np.hypot(*line.T) == pytest.approx(30e3, abs=100.0 * TOLERANCE)
    assert [(r.word, r.limited) for r in area.regions] == [("LSL", False), ("RSR", False)]


def test_a_jump_cuts_the_lines_that_end_at_it() -> None:
    def cliff(x: np.ndarray, y: np.ndarray) -> Field:
        time = 300.0 + y / 100.0 + np.where(x > 0.4321, 100.0, 0.0)
        same = np.zeros(len(x))
        return Field(
            time=time, lower_bound=time, words=same.astype(np.int8), limited=same.astype(bool)
        )

    (contour,) = isochrones(STRAIGHT, GRID, [350.0], evaluate=cliff).contours
    assert len(contour.lines) == 2
    for line in contour.lines:
        assert np.ptp(line[:, 1]) < 100.0 * TOLERANCE
        assert np.all(line[:, 0] < 0.4321) or np.all(line[:, 0] > 0.4321)


def test_without_any_plan_there_is_nothing_to_draw() -> None:
    behind = replace(STRAIGHT, leader=replace(STRAIGHT.leader, tas=390.0))
    grid = Grid(x=-150e3, y=-150e3, width=20e3, height=20e3, columns=4, rows=4)
    area = isochrones(behind, grid)
    assert np.all(area.field.time == inf)
    assert area.contours == ()
    assert [(region.word, region.limited) for region in area.regions] == [("", False)]
    assert isochrones(behind, grid, [600.0]).contours == (Contour(level=600.0, lines=()),)


def test_levels_are_round_and_not_too_many(drawn: dict[Situation, Isochrones]) -> None:
    levels = round_levels(drawn[STRAIGHT].field)
    assert 5 <= len(levels) <= 20
    assert all(level % 15.0 == 0.0 for level in levels)
    assert [c.level for c in drawn[STRAIGHT].contours] == list(levels)
    assert isochrones(STRAIGHT, GRID, [600, 300, 300]).contours[0].level == 300.0


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"columns": 1}, "columns must be a whole number from 2"),
        ({"rows": 513}, "rows must be a whole number from 2"),
        ({"width": 10.0}, "grid.width must lie in"),
        ({"height": inf}, "grid.height must be a finite number"),
        ({"x": 990e3}, "must lie within"),
    ],
)
def test_a_grid_checks_itself(changes: dict[str, float], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(GRID, **changes)


def test_levels_are_checked() -> None:
    with pytest.raises(ValueError, match="A level must lie in"):
        isochrones(STRAIGHT, GRID, [-1.0])
    with pytest.raises(ValueError, match=f"at most {MAX_LEVELS} levels"):
        isochrones(STRAIGHT, GRID, [60.0] * 65)
    assert NAMES[DELAY] == "delay"

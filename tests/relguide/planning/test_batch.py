"""Many at once: the same answers as one by one, whatever the number of threads."""

import re
from collections.abc import Iterable
from dataclasses import fields, replace
from math import inf, nan, pi

import numpy as np
import pytest

from relguide import Leader, NoPlan, Plan, Pursuer, Situation, Wind, plan
from relguide.planning import batch
from relguide.planning.batch import BLOCK, Situations, Times, plan_arrays
from relguide.units import DEG

RNG = np.random.default_rng(3)
N = 200
COLUMNS = Situations(
    pursuer_x=RNG.uniform(-40e3, 40e3, N),
    pursuer_y=RNG.uniform(-40e3, 40e3, N),
    pursuer_heading=RNG.uniform(0.0, 2.0 * pi, N),
    pursuer_tas=RNG.uniform(180.0, 260.0, N),
    max_bank=RNG.uniform(15 * DEG, 30 * DEG, N),
    leader_heading=RNG.uniform(0.0, 2.0 * pi, N),
    leader_tas=RNG.uniform(150.0, 240.0, N),
    slot_distance=12e3,
    min_separation=9e3,
    wind_east=RNG.uniform(-30.0, 30.0, N),
    wind_north=10.0,
)


PER_ROW = [f.name for f in fields(COLUMNS) if np.ndim(getattr(COLUMNS, f.name)) == 1]


def one(i: int) -> Situation:
    px, py, psi, tas, bank, lx, ly, leading, leader_tas, distance, nearest, east, north = (
        float(column[i]) for column in COLUMNS.columns()
    )
    return Situation(
        pursuer=Pursuer(x=px, y=py, heading=psi, tas=tas, max_bank=bank),
        leader=Leader(x=lx, y=ly, heading=leading, tas=leader_tas),
        slot_distance=distance,
        min_separation=nearest,
        wind=Wind(east=east, north=north),
    )


def test_each_row_is_what_plan_says() -> None:
    answers = plan_arrays(COLUMNS)
    seen = set()
    for i in range(N):
        answer = plan(one(i))
        if isinstance(answer, NoPlan):
            assert answers.verdict[i] == answer.reason
            assert answers.time_to_converge[i] == inf
        else:
            assert isinstance(answer, Plan)
            assert answers.verdict[i] == "planned"
            assert answers.time_to_converge[i] == pytest.approx(answer.time_to_converge, abs=1e-3)
            assert answers.proved[i] == (answer.optimality.proof == "relaxation")
            assert answers.lower_bound[i] == pytest.approx(answer.optimality.lower_bound, abs=1e-3)
            if answers.proved[i]:
                assert answers.word[i] == answer.word
        seen.add(str(answers.verdict[i]))
        seen.add(str(answers.word[i]))
    assert {"planned", "separation_already_lost", "constrained", "LSL"} <= seen


def test_threads_change_nothing_and_progress_counts() -> None:
    done: list[int] = []
    single = plan_arrays(COLUMNS, threads=1, progress=done.append)
    several = plan_arrays(COLUMNS, threads=4)
    assert np.array_equal(single.time_to_converge, several.time_to_converge)
    assert sum(done) == N


def test_without_the_limit_nothing_is_lost() -> None:
    free = plan_arrays(COLUMNS, limited=False)
    held = plan_arrays(COLUMNS)
    assert not np.any(free.verdict == "separation_already_lost")
    reached = np.isfinite(free.time_to_converge)
    assert np.all(free.time_to_converge[reached] <= held.time_to_converge[reached] + 1e-9)
    assert np.all(free.proved[reached])


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"pursuer_x": nan}, "pursuer.x must be a finite number, not nan."),
        ({"leader_y": -inf}, "leader.y must be a finite number, not -inf."),
        ({"leader_tas": 20.0}, "leader.tas must lie in 30 … 400 m/s, not 20 m/s."),
        ({"max_bank": 1.2}, "pursuer.max_bank must lie in 1 … 60 °, not 68.7549354 °."),
        ({"slot_distance": 8e3}, "slot_distance must be at least min_separation (9000 m), not"),
        ({"slot_distance": 3e5}, "slot_distance must lie in 0 … 200000 m, not 300000 m."),
        ({"min_separation": -1.0}, "min_separation must lie in 0 … 200000 m, not -1 m."),
        ({"wind_east": 200.0}, "wind.speed must lie in 0 … 150 m/s, not"),
        ({"wind_north": nan}, "wind.north must be a finite number, not nan."),
        ({"pursuer_y": 2e6}, "pursuer.y must lie in -1e+06 … 1e+06 m, not 2000000 m."),
        ({"leader_heading": nan}, "leader.heading must be a finite number, not nan."),
        (
            {"pursuer_heading": 1e300},
            "pursuer.heading must lie in -12.5664 … 12.5664 rad, not 1e+300",
        ),
        (
            {"leader_heading": 0.0, "leader_tas": 80.0, "wind_east": 0.0, "wind_north": -79.5},
            "The leader makes no headway on its final leg in this wind (0.5 m/s over the ground",
        ),
    ],
)
def test_a_row_that_cannot_be_flown_is_refused_as_a_situation_is(
    changes: dict[str, float], sentence: str
) -> None:
    changed = replace(COLUMNS, **changes)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="^Situation 0: " + re.escape(sentence)):
        plan_arrays(changed)


def test_a_bound_may_be_met_to_rounding() -> None:
    calm = replace(COLUMNS, wind_east=0.0, wind_north=0.0)
    for name, at in (("pursuer_tas", 400.0), ("leader_tas", 30.0), ("max_bank", 60.0 * DEG)):
        for value in (np.nextafter(at, 0.0), np.nextafter(at, 1e9)):
            replace(calm, **{name: value}).columns()  # type: ignore[arg-type]


def test_the_first_bad_row_is_named_wherever_it_is() -> None:
    x = np.zeros(2 * BLOCK + 5)
    tas = np.full(2 * BLOCK + 5, 240.0)
    x[BLOCK + 3], x[BLOCK + 7], tas[BLOCK + 2] = nan, nan, 10.0
    many = Situations(
        pursuer_x=x, pursuer_y=9e3, pursuer_heading=0.0, pursuer_tas=tas, max_bank=0.4,
        leader_tas=200.0, slot_distance=12e3, min_separation=9e3,
    )  # fmt: skip
    with pytest.raises(ValueError, match=rf"^Situation {BLOCK + 2}: pursuer\.tas"):
        plan_arrays(many)
    tas[BLOCK + 2] = 240.0
    with pytest.raises(ValueError, match=rf"^Situation {BLOCK + 3}: pursuer\.x"):
        plan_arrays(many)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"max_bank": "0.4"}, "max_bank must be numbers"),
        ({"max_bank": None}, "max_bank must be numbers"),
        ({"max_bank": True}, "max_bank must be numbers, not bool"),
        ({"max_bank": 1j}, "max_bank must be numbers, not complex128"),
        ({"max_bank": 10**400}, "max_bank must be numbers"),
        ({"max_bank": np.full((N, 1), 0.4)}, "max_bank must be a number or a column"),
        ({"max_bank": np.full(N + 1, 0.4)}, "pursuer_x has 200 and max_bank has 201"),
    ],
)
def test_columns_that_are_none_are_named(changes: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        plan_arrays(replace(COLUMNS, **changes))  # type: ignore[arg-type]


def test_what_is_asked_must_make_sense() -> None:
    for wrong in (None, {}, COLUMNS.columns()):
        with pytest.raises(ValueError, match="must be a Situations"):
            plan_arrays(wrong)  # type: ignore[arg-type]
    for threads in (0, -1, 1.5):
        with pytest.raises(ValueError, match="threads must be"):
            plan_arrays(COLUMNS, threads=threads)  # type: ignore[arg-type]


def test_blocks_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = plan_arrays(COLUMNS)
    monkeypatch.setattr(batch, "BLOCK", 64)
    parts = plan_arrays(COLUMNS)
    for field in fields(Times):
        assert np.array_equal(getattr(whole, field.name), getattr(parts, field.name))
    assert np.array_equal(whole.planned, whole.verdict == "planned")


def test_no_situations_are_answered_too() -> None:
    assert len(plan_arrays(replace(COLUMNS, **dict.fromkeys(PER_ROW, ()))).word) == 0


def test_beyond_the_horizon_as_plan_says() -> None:
    tas = 272.1898354009719
    slow = Situations(
        pursuer_x=-212e3, pursuer_y=460e3, pursuer_heading=0.4, pursuer_tas=tas, max_bank=0.43,
        leader_heading=3.4, leader_tas=np.nextafter(tas, 0.0), slot_distance=200e3,
        min_separation=140e3,
    )  # fmt: skip
    answers = plan_arrays(slow, limited=False)
    assert answers.verdict.tolist() == ["beyond_horizon"]
    assert answers.time_to_converge.tolist() == [inf]


def test_columns_go_to_a_frame_and_back() -> None:
    """A frame's rows are named tuples, its columns arrays of one length."""
    frame = COLUMNS.to_dict()
    assert {len(column) for column in frame.values()} == {len(frame["pursuer_x"])}
    times, again = plan_arrays(COLUMNS), plan_arrays(Situations(**frame))
    assert isinstance(times, Iterable)
    assert [*times] == [*again] == [times[row] for row in range(len(times))]


def test_miles_given_as_metres_are_asked_about() -> None:
    with pytest.raises(ValueError, match=r"slot_distance is in metres, .* Did you mean 6 NM\?"):
        plan_arrays(replace(COLUMNS, slot_distance=6, min_separation=5))


def test_times_are_rows_and_columns() -> None:
    times = plan_arrays(
        Situations(
            pursuer_x=0.0,
            pursuer_y=-40e3,
            pursuer_heading=0.0,
            pursuer_tas=[220.0, 220.0, 180.0],
            max_bank=25.0 * DEG,
            leader_tas=[180.0, 200.0, 180.0],
            slot_distance=9e3,
            min_separation=5e3,
        )
    )
    assert len(times) == 3
    assert times[0] == (pytest.approx(775.0), pytest.approx(775.0), "planned", "LSL")
    assert times[0].word == "LSL"
    assert times[-1].verdict == "slot_unreachable"
    assert [row.time_to_converge for row in times] == times.time_to_converge.tolist()
    assert len(times[times.planned]) == 2
    assert times[1:].verdicts.tolist() == times.verdicts[1:].tolist()
    columns = times.to_dict()
    assert list(columns) == ["time_to_converge", "lower_bound", "verdict", "word"]
    assert {len(column) for column in columns.values()} == {3}
    assert repr(times) == "Times(3 situations, 2 with a plan, 775.0 … 1550.0 s)"
    assert repr(times[2:]) == "Times(1 situations, 0 with a plan)"

"""Labels where the limit binds: exact, the same wherever made, refused when damaged."""

from concurrent.futures import Executor, Future, ThreadPoolExecutor
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from relguide import Leader, NoPlan, Plan, Pursuer, Situation, plan
from relguide.kernels.words.branches import needs_mirror
from relguide.learn.boundary.template_label_file import (
    grow_template_labels,
    load_template_labels,
    save_template_labels,
)
from relguide.learn.boundary.template_labels import (
    TemplateBox,
    TemplateLabelRequest,
    TemplateLabels,
    advance_paths,
    answers_of,
    join_labels,
    make_template_labels,
    template_label_chunk,
)
from relguide.units import DEG
from tests.relguide.learn.boundary.template_networks import labels

SMALL = TemplateLabelRequest(count=70, seed=3, chunk=20)


def same(a: TemplateLabels, b: TemplateLabels) -> bool:
    return all(np.array_equal(x, y) for x, y in zip(a.columns(), b.columns(), strict=True))


def needs_any_mirror(situations: np.ndarray) -> bool:
    return any(needs_mirror(y, h) for y, h in situations[:, 1:3].tolist())


def situation_of(row: np.ndarray) -> Situation:
    """A row of labels as a situation: the leader at the origin, on heading north."""
    x, y, h, alpha, slot, limit = row.tolist()
    tas = 240.0
    pursuer = Pursuer(x=0.0, y=0.0, heading=0.0, tas=tas, max_bank=25 * DEG)
    radius = pursuer.turn_radius
    return Situation(
        pursuer=replace(pursuer, x=-y * radius, y=(x - slot) * radius, heading=-h),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=alpha * tas),
        slot_distance=slot * radius,
        min_separation=limit * radius,
    )


def test_the_answers_are_the_exact_planners() -> None:
    found = labels()
    scale = situation_of(found.situations[0]).pursuer.turn_radius / 240.0
    for n in range(0, 1500, 30):
        answer = plan(situation_of(found.situations[n]))
        time = float(found.times[n, 2]) * scale
        if time < inf:
            assert isinstance(answer, Plan)
            assert answer.optimality.proof == "bound"
            assert answer.time_to_converge == pytest.approx(time, abs=0.01)
        elif isinstance(answer, Plan):  # found only by the last resort, which is not learnt
            assert found.counts[n] == 0
        else:
            assert isinstance(answer, NoPlan)


def test_every_situation_lies_in_the_box_and_binds() -> None:
    found, box = labels(), TemplateBox()
    x, y, h, alpha, slot, limit = found.situations.T
    assert (y >= 0.0).all()
    assert ((h >= 0.0) & (h < 2.0 * np.pi)).all()
    assert ((alpha >= box.min_ratio) & (alpha <= box.max_ratio)).all()
    assert ((limit >= box.min_limit) & (limit <= box.max_limit)).all()
    assert ((slot >= limit) & (slot <= box.max_slot * limit)).all()
    assert (np.hypot(x - slot, y) >= limit).all()
    assert (found.times[:, 0] < found.times[:, 2]).all()  # the limit costs time
    assert (found.times[:, 2] <= found.times[:, 1]).all()
    assert np.bincount(found.sources).tolist() == [525, 375, 375, 225]


def test_some_situations_lie_along_the_ways_of_others() -> None:
    found = template_label_chunk(replace(SMALL, count=300, chunk=300), 0)
    drawn = {tuple(row) for row in found.situations[found.sources < 3, 3:].tolist()}
    along = found.situations[found.sources == 3]
    assert len(along) == 45
    assert {tuple(row) for row in along[:, 3:].tolist()} <= drawn
    only = template_label_chunk(replace(SMALL, shares=(0.0, 0.0, 0.0, 1.0)), 0)
    assert len(only) == 20  # none to lie along: drawn as the others are


def test_what_is_left_of_a_way_is_the_fastest_from_there() -> None:
    left = advance_paths(labels().paths, np.random.default_rng(1))
    turning = (labels().counts > 1) & (labels().legs[:, 0, 3] > 0.05)
    assert len(left.times) == turning.sum() > 300
    assert (left.times < labels().times[turning, 2]).all()
    assert not needs_any_mirror(left.situations)
    rows = np.arange(0, len(left.times), 5)
    times, _, _ = answers_of(left.situations[rows])
    late = times[:, 2] - left.times[rows]
    assert np.abs(late).max() < 2e-3
    assert np.mean(np.abs(late) < 1e-6) > 0.9


class Here(Executor):
    """Makes everything at once, in order."""

    def submit(self, task: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_result(task(*args, **kwargs))
        return future


def test_the_same_request_gives_the_same_labels_anywhere() -> None:
    with ThreadPoolExecutor(2) as pool:
        threads = join_labels(dict(make_template_labels(SMALL, pool)))
    here = join_labels(dict(make_template_labels(SMALL, Here())))
    assert same(threads, here)
    assert len(here) == 70
    assert same(join_labels({0: template_label_chunk(SMALL, 0)}), template_label_chunk(SMALL, 0))
    other = template_label_chunk(replace(SMALL, seed=4), 0)
    assert not np.array_equal(other.situations, here.situations[:20])


def test_a_run_that_was_stopped_goes_on_to_the_same_end(tmp_path: Path) -> None:
    whole = dict(grow_template_labels(SMALL, tmp_path / "whole", Here(), resume=False))
    part = tmp_path / "part"
    run = grow_template_labels(SMALL, part, Here(), resume=False)
    next(run), next(run)
    run.close()
    part.write_bytes(part.read_bytes()[:-100])  # stopped while it wrote
    made: list[int] = []

    class Counting(Here):
        def submit(self, task: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
            made.append(1)
            return super().submit(task, *args, **kwargs)

    again = dict(grow_template_labels(SMALL, part, Counting(), resume=True))
    assert same(join_labels(again), join_labels(whole))
    assert len(made) == 3  # of four chunks one was whole
    assert same(
        join_labels(dict(grow_template_labels(SMALL, part, Counting(), resume=True))),
        join_labels(whole),
    )
    assert len(made) == 3
    with pytest.raises(ValueError, match="begun with another request"):
        list(grow_template_labels(replace(SMALL, seed=9), part, Here(), resume=True))
    with pytest.raises(ValueError, match="--resume goes on with it"):
        list(grow_template_labels(SMALL, part, Here(), resume=False))
    with pytest.raises(ValueError, match="nothing to resume"):
        list(grow_template_labels(SMALL, tmp_path / "none", Here(), resume=True))


def test_a_run_that_is_killed_in_its_first_chunk_can_go_on(tmp_path: Path) -> None:
    """Nothing had been written by then, and it was said to be of another request."""
    part, left = tmp_path / "part", tmp_path / "left"

    class Killed(Here):
        def submit(self, task: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
            left.write_bytes(part.read_bytes())
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        next(grow_template_labels(SMALL, part, Killed(), resume=False))
    again = dict(grow_template_labels(SMALL, left, Here(), resume=True))
    assert same(join_labels(again), join_labels(dict(make_template_labels(SMALL, Here()))))


def test_a_file_keeps_all_and_others_are_refused(tmp_path: Path) -> None:
    found, file = template_label_chunk(SMALL, 0), tmp_path / "labels.npz"
    save_template_labels(found, SMALL, {"command": "it"}, file)
    read, about = load_template_labels(file)
    assert same(read, found)
    assert about["provenance"] == {"command": "it"}
    assert about["request"]["seed"] == 3
    file.write_bytes(file.read_bytes()[:1000])
    with pytest.raises(ValueError, match="holds no labels of relguide dataset --method templates"):
        load_template_labels(file)
    save_template_labels(replace(found, counts=found.counts[:5]), SMALL, {}, file)
    with pytest.raises(ValueError, match="do not fit together"):
        load_template_labels(file)


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda: TemplateLabelRequest(count=0), "whole numbers"),
        (lambda: TemplateLabelRequest(count=5, shares=(0.5, 0.5, 0.5, 0.5)), "sum up to 1"),
        (lambda: TemplateBox(max_ratio=1.0), "Speed ratios"),
        (lambda: TemplateBox(min_limit=0.0), "d_min must reach"),
        (lambda: TemplateBox(max_slot=1.0), "max_slot and max_range"),
    ],
)
def test_what_is_no_request_is_refused(make: Any, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        make()

"""Labels: exact, the same wherever and however often a chunk is made, refused when damaged."""

from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from math import inf, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from relguide import Situations, plan_arrays
from relguide.kernels.words.branches import BRANCHES
from relguide.learn.training.chunks import ATTEMPTS
from relguide.learn.words.branch_labels import (
    SOURCES,
    LabelRequest,
    Labels,
    canonical,
    held_out_regions,
    join_labels,
    label_chunk,
    load_labels,
    make_labels,
    save_labels,
)
from relguide.units import DEG, G0
from tests.relguide.learn.words.networks import REQUEST, labels

SMALL = LabelRequest(count=700, seed=3, chunk=100)


def same(a: Labels, b: Labels) -> bool:
    return (
        np.array_equal(a.situations, b.situations)
        and np.array_equal(a.times, b.times)
        and np.array_equal(a.sources, b.sources)
    )


def test_the_least_time_is_the_exact_planners() -> None:
    found = label_chunk(SMALL, 0)
    x, y, h, alpha = found.situations.T
    radius = 240.0**2 / (G0 * np.tan(25 * DEG))
    # the leader flies north, at a slot's distance ahead of it
    times = plan_arrays(
        Situations(
            pursuer_x=-y * radius, pursuer_y=x * radius, pursuer_heading=-h, pursuer_tas=240.0,
            max_bank=25 * DEG, leader_x=0.0, leader_y=12e3, leader_heading=0.0,
            leader_tas=240.0 * alpha, slot_distance=12e3, min_separation=0.0,
        ),
        limited=False,
    )  # fmt: skip
    within = times.time_to_converge < inf
    assert within.sum() > 90
    least = found.times.min(axis=1) * radius / 240.0
    assert least[within] == pytest.approx(times.time_to_converge[within], rel=1e-9)
    words = [BRANCHES[best].split()[0] for best in found.best[within]]
    assert np.mean(np.array(words) == times.word[within]) > 0.98  # ties go either way


def test_every_source_brings_what_it_is_for() -> None:
    found = labels()
    box, reverse, edge = (found.best[found.sources == n] for n in range(3))
    shares = [np.bincount(best, minlength=8) / len(best) for best in (box, reverse)]
    rare = BRANCHES.index("RSR")
    assert shares[1][rare] > 5.0 * shares[0][rare]
    two = np.sort(found.times, axis=1)[:, :2]
    close = two[:, 1] < 1.02 * two[:, 0]
    assert np.mean(close[found.sources == 2]) > 2.0 * np.mean(close[found.sources == 0])
    assert len(edge) == round(0.3 * 4000) * 3


@pytest.mark.slow
def test_closed_loops_bring_more_and_leave_the_others_as_they_are() -> None:
    found = label_chunk(replace(SMALL, loops=0.2), 1)
    loop = found.sources == SOURCES.index("loop")
    assert loop.sum() == 20
    assert np.array_equal(found.situations[~loop], label_chunk(SMALL, 1).situations)
    assert same(found, label_chunk(replace(SMALL, loops=0.2), 1))
    x, y, _, alpha = found.situations[loop].T
    assert np.hypot(x, y).max() <= SMALL.box.max_range
    assert SMALL.box.min_ratio <= alpha.min() <= alpha.max() <= SMALL.box.max_ratio
    assert y.min() >= 0.0
    assert found.times[loop].min(axis=1).max() < inf
    # of two flights, whose leaders keep their speed; the first of them cannot be followed
    assert len(set(alpha.round(1))) <= 2
    with pytest.raises(ValueError, match="loops must be a share from 0 to 1, not 2"):
        replace(SMALL, loops=2.0)


def test_labels_are_in_the_box_and_on_the_left() -> None:
    x, y, h, alpha = labels().situations.T
    box = REQUEST.box
    assert np.hypot(x, y).max() <= box.max_range * (1.0 + 1e-12)
    assert box.min_ratio <= alpha.min() <= alpha.max() <= box.max_ratio
    assert y.min() >= 0.0
    assert 0.0 <= h.min() <= h.max() < 2.0 * pi
    assert all(inside.sum() > 50 for inside in held_out_regions(labels().situations).values())


def test_a_mirror_image_is_looked_at_from_the_left() -> None:
    left = np.array([[1.0, 2.0, 4.0, 0.5], [1.0, 0.0, 1.0, 0.5], [1.0, 0.0, 0.0, 0.5]])
    right = left * (1.0, -1.0, -1.0, 1.0)
    assert canonical(left) == pytest.approx(left)
    assert canonical(right) == pytest.approx(left)


def test_few_labels_are_labels_too() -> None:
    for shares in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
        for seed in range(5):
            request = LabelRequest(count=1, seed=seed, shares=shares)
            assert len(label_chunk(request, 0)) == 1


class Losing(Executor):
    """Loses every chunk's worker the first `times` times, and makes some chunks twice."""

    def __init__(self, times: int) -> None:
        self.times = times
        self.begun: dict[int, int] = {}

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        (number,) = args
        self.begun[number] = self.begun.get(number, 0) + 1
        if self.begun[number] <= self.times:
            future.set_exception(ConnectionResetError("the worker is gone"))
        else:
            fn(number)
            future.set_result(fn(number))
        return future


def test_lost_workers_lose_nothing_and_double_nothing() -> None:
    executor = Losing(times=2)
    chunks = list(make_labels(SMALL, executor))
    assert sorted(number for number, _ in chunks) == list(range(SMALL.chunks))
    assert set(executor.begun.values()) == {3}
    whole = {number: label_chunk(SMALL, number) for number in range(SMALL.chunks)}
    assert same(join_labels(dict(chunks)), join_labels(whole))
    assert len(np.unique(join_labels(whole).situations, axis=0)) == SMALL.count


def test_a_chunk_lost_for_good_is_said() -> None:
    with pytest.raises(OSError, match=f"was lost {ATTEMPTS} times, at last by: the worker is gone"):
        list(make_labels(SMALL, Losing(times=99)))


@pytest.mark.slow
def test_any_executor_makes_the_same_labels() -> None:
    with ThreadPoolExecutor(3) as threads:
        by_threads = join_labels(dict(make_labels(SMALL, threads)))
    with ProcessPoolExecutor(1) as processes:
        by_processes = join_labels(dict(make_labels(replace(SMALL), processes)))
    assert len(by_threads) == SMALL.count
    assert same(by_threads, by_processes)
    assert not same(by_threads, join_labels({0: label_chunk(replace(SMALL, seed=4), 0)}))


def test_files_come_back_and_damaged_ones_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "labels.npz"
    found = label_chunk(SMALL, 1)
    save_labels(found, SMALL, {"program": "relguide"}, file)
    read, about = load_labels(file)
    assert same(read, found)
    assert about["request"]["seed"] == 3
    assert about["provenance"] == {"program": "relguide"}
    file.write_bytes(file.read_bytes()[:-100])
    with pytest.raises(ValueError, match="holds no labels of relguide dataset"):
        load_labels(file)
    save_labels(replace(found, times=found.times[1:]), SMALL, {}, file)
    with pytest.raises(ValueError, match="do not fit together"):
        load_labels(file)
    save_labels(replace(found, times=np.full_like(found.times, inf)), SMALL, {}, file)
    with pytest.raises(ValueError, match="without an answer"):
        load_labels(file)


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"count": 0}, "count and chunk must be whole numbers"),
        ({"shares": (0.5, 0.1, 0.1)}, "shares must be 0 or more and sum up to 1"),
    ],
)
def test_a_request_that_is_none_is_refused(wrong: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(SMALL, **wrong)

"""A Dask cluster makes the same parts: a real scheduler, two worker processes, one of them killed.

Each part is made with the number of its process, so that a test can see who made it.
"""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from relguide.campaign import campaign
from relguide.learn.training import chunks
from relguide.learn.training.chunks import Cluster, gather
from relguide.learn.words.branch_labels import (
    LabelRequest,
    Labels,
    join_labels,
    label_chunk,
    load_labels,
)
from relguide.parallel import cluster as clusters
from relguide.parallel.cluster import cluster, make_alike
from relguide.parallel.program import program
from tests.bodies import BODY
from tests.command_line import NEAR, Run, write
from tests.relguide.parallel.dask_cluster import LocalCluster, local_cluster

REQUEST = LabelRequest(count=2000, seed=11, chunk=50)
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def machines(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster]:
    """A scheduler with two workers; who kills one adds another."""
    with local_cluster(tmp_path_factory.mktemp("dask")) as found:
        found.add_worker()
        found.add_worker()
        yield found


def sign(request: LabelRequest, number: int) -> tuple[int, Labels]:
    """A part, and the process that made it."""
    return os.getpid(), label_chunk(request, number)


def deadly(number: int) -> int:
    """A part that no worker survives."""
    os._exit(number)


def told_nothing(sentence: str) -> None:
    raise AssertionError(sentence)


def test_a_worker_killed_half_way_loses_nothing_and_doubles_nothing(
    machines: LocalCluster,
) -> None:
    found: list[tuple[int, Labels]] = []
    makers: set[int] = set()
    with cluster(machines.address, told_nothing) as workers:
        assert isinstance(workers, Cluster)
        assert workers.cores == 2
        for number, (maker, labels) in gather(partial(sign, REQUEST), REQUEST.chunks, workers):
            found.append((number, labels))
            makers.add(maker)
            if len(found) == REQUEST.chunks // 2:
                machines.kill_worker(maker)
    machines.add_worker()
    assert len(makers) == 2  # the other made what was left
    assert os.getpid() not in makers
    assert sorted(number for number, _ in found) == list(range(REQUEST.chunks))
    here = {number: label_chunk(REQUEST, number) for number in range(REQUEST.chunks)}
    made, local = join_labels(dict(found)), join_labels(here)
    for name in Labels.__slots__:
        assert getattr(made, name).tobytes() == getattr(local, name).tobytes()


def test_the_commands_give_what_they_give_here(run: Run, machines: LocalCluster) -> None:
    exact = ("dataset", "--method", "exact", "--count", "12000", "--json", "--out")
    assert run(*exact, "here.npz")[::2] == (0, "")
    assert run(*exact, "there.npz", "--dask", machines.address)[::2] == (0, "")
    here, there = (load_labels(Path(name))[0] for name in ("here.npz", "there.npz"))
    assert np.array_equal(here.situations, there.situations)
    assert np.array_equal(here.times, there.times)
    audit = ("audit", "--count", "12000", "--beside", "0", "--table")
    code, told_here, err = run(*audit)
    assert (code, err) == (0, "")
    code, told_there, err = run(*audit, "--dask", machines.address)
    assert (code, err) == (0, "")
    assert "in closed loops" in told_here
    assert found_in(told_here) == found_in(told_there)


def test_a_batch_is_answered_as_it_is_here(run: Run, machines: LocalCluster) -> None:
    bodies = [{"id": n, **(BODY, NEAR)[n % 2]} for n in range(450)] + [{"id": "last"}]
    write("".join(json.dumps(body) + "\n" for body in bodies), "all.jsonl")
    batch = ("plan", "--batch", "all.jsonl")
    code, out, err = run(*batch, "--out", "there.jsonl", "--dask", machines.address)
    assert (code, out.startswith("there.jsonl: 451 answers, in ")) == (1, True)
    assert err == "relguide: 1 line is no valid situation, the first is line 451.\n"
    assert run(*batch, "--out", "here.jsonl", "--processes", "1")[::2] == (1, err)
    here, there = (
        [json.loads(line) | {"compute_ms": 0} for line in Path(name).read_text().splitlines()]
        for name in ("here.jsonl", "there.jsonl")
    )
    assert here == there
    code, _, err = run(*batch, "--dask", machines.address, "--processes", "2")
    assert code == 2
    assert "not allowed with argument" in err


def found_in(told: str) -> list[str]:
    """What an audit says, less how long a query took."""
    before, _, after = told.partition("CPU time of one query")
    _, _, findings = after.partition("\n  ")
    return (before + findings).splitlines()


def test_a_part_that_kills_its_workers_is_given_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(chunks, "ATTEMPTS", 2)
    tolerance = {"DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "0"}
    with local_cluster(tmp_path, **tolerance) as machines:
        machines.add_worker()
        machines.add_worker()
        with (
            cluster(machines.address, told_nothing) as workers,
            pytest.raises(OSError, match="Part 0 was lost 2 times, at last by: Attempted to run"),
        ):
            list(gather(deadly, 1, workers))


def test_a_cluster_without_workers_is_waited_for_and_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said: list[str] = []
    with local_cluster(tmp_path) as machines:
        monkeypatch.setattr(clusters, "COUNTED_EVERY", 0.2)

        def add_one(sentence: str) -> None:
            said.append(sentence)
            machines.add_worker()

        with monkeypatch.context() as patch, cluster(machines.address, said.append) as workers:
            patch.setattr(clusters, "NO_WORKERS", 0.5)
            with pytest.raises(TimeoutError, match=r"had no workers for 0\.5 s"):
                list(gather(partial(sign, REQUEST), 2, workers))
        said.clear()
        with cluster(machines.address, add_one) as workers:
            parts = dict(gather(partial(sign, REQUEST), 2, workers))
    assert sorted(parts) == [0, 1]
    assert said == [f"{machines.address} has no workers: waiting up to 120 s for one."]


def test_a_scheduler_that_is_gone_gives_a_sentence(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(clusters, "REACHED_WITHIN", 2.0)
    (tmp_path / "dask").mkdir()
    with local_cluster(tmp_path / "dask") as machines:
        machines.add_worker()
        address = machines.address

        with cluster(address, told_nothing) as workers:
            stream = gather(partial(sign, REQUEST), REQUEST.chunks, workers)
            next(stream)
            machines.scheduler.kill()
            with pytest.raises(ConnectionError, match="scheduler is gone, and did not come back"):
                list(stream)
    assert run("audit", "--dask", address)[::2] == (
        2, f"relguide: {address}: no Dask scheduler answered within 2 s.\n",
    )  # fmt: skip


def test_another_program_is_refused(
    machines: LocalCluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert make_alike(program(), abs, -3) == 3
    asked = dict(program()) | {"its code": "another"}
    with cluster(machines.address, told_nothing) as workers:
        monkeypatch.setattr(clusters, "program", lambda: tuple(asked.items()))
        with pytest.raises(ValueError, match=r"worker tcp\S+ has its code \w+, and here is anoth"):
            list(gather(partial(sign, REQUEST), 3, workers))


class OtherPackages:
    """A client of a cluster with other packages than it has itself."""

    def get_versions(self, packages: list[str]) -> dict[str, Any]:
        here = {"packages": dict.fromkeys(packages, "9.9")}
        worker = {"packages": here["packages"] | {"numpy": None}}
        return {"client": here, "scheduler": here, "workers": {"tcp://h:1": worker}}


def test_packages_that_differ_are_refused() -> None:
    with pytest.raises(ValueError, match="worker tcp://h:1 does not have numpy, and here"):
        clusters._check_machines(OtherPackages())


def test_without_dask_it_is_said_what_to_install(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert run("audit", "--dask", "tcp://127.0.0.1:1")[::2] == (
        2,
        "relguide: This needs the package distributed, which is not installed: "
        "pip install 'relguide[cluster]' brings it.\n",
    )


def test_misuse_is_said_in_a_sentence(run: Run) -> None:
    code, _, err = run("audit", "--dask", "nowhere")
    assert code == 2
    assert err.startswith("relguide: nowhere is no address of a Dask scheduler: ")
    tree = ("dataset", "--method", "reverse-dp", "--out", "tree.npz", "--dask", "tcp://h:1")
    assert run(*tree)[2].startswith("relguide: A tree is grown on one machine: --dask is for ")
    assert "not allowed with argument" in run("audit", "--dask", "tcp://h:1", "--threads", "2")[2]


def test_the_library_does_not_load_dask() -> None:
    modules = "relguide, relguide.__main__, relguide.cli.workers, relguide.parallel.cluster"
    loaded = f"import sys, {modules}; print('dask' in sys.modules)"
    said = subprocess.run([sys.executable, "-c", loaded], capture_output=True, check=True)
    assert said.stdout.strip() == b"False"


def test_a_campaign_on_a_cluster_is_the_same(machines: LocalCluster, tmp_path: Path) -> None:
    asked = {"campaign": {"flights": 12, "family": "mixed", "seed": 2, "limit_s": 120}}
    far = campaign(asked, tmp_path / "far", dask=machines.address)
    near = campaign(asked, tmp_path / "near", processes=1)
    assert far.drop_columns(["cpu_s"]).equals(near.drop_columns(["cpu_s"]))

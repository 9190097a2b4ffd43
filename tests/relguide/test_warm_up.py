"""After `python -m relguide.warm_up` nothing is left to compile, and stale code is never run."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from relguide.kernels import cache

USED = """
import sys
from importlib import import_module
from itertools import islice
from pkgutil import walk_packages
from numba.core.dispatcher import Dispatcher
from relguide import Plan, Situations, alternatives, check, kernels, plan, plan_arrays, prove
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.learn.audits.branch_judging import audit_request, judge_chunk, latencies
from relguide.learn.words.branch_labels import LabelRequest, label_chunk
from relguide.learn.words.branch_network import features_of, load_network
from relguide.learn.network_planner import network_planner
from relguide.learn.tree.regular_planner import regular_planner
from relguide.warm_up import _steps
from tests.situations import golden

def called():
    found = walk_packages(kernels.__path__, "relguide.kernels.")
    modules = [import_module(module.name) for module in found]
    found = {f for module in modules for f in vars(module).values() if isinstance(f, Dispatcher)}
    return {f"{f.py_func.__name__}{sig}" for f in found for sig in f.signatures}

for *_, step in _steps():
    step()
compiled = called()
for situation, _ in golden("reference")[::7]:
    planned = plan(situation)
    if isinstance(planned, Plan):
        alternatives(planned)
        check(planned, situation)
        prove(planned, seconds=0.01)
for name in ("fig_6a", "fig_6b"):
    for _ in islice(fly(scenario(name), plan), 3000):
        pass
plan_arrays(Situations(
    pursuer_x=range(-9000, 9000, 3000), pursuer_y=12000, pursuer_heading=1, pursuer_tas=240,
    max_bank=0.4, leader_tas=200, slot_distance=9000, min_separation=8000,
))
network = load_network()
for situation, _ in golden("reference")[::7]:
    network_planner(network)(situation)
    regular_planner(situation)
latencies(network, audit_request(network, 100, 1))
judge_chunk(network, audit_request(network, 100, 1), 0)
features_of(label_chunk(LabelRequest(count=100), 0).situations)
sys.exit(", ".join(called() - compiled) or 0)
"""
"""What a user may do; its exit status names the kernels that are then compiled after all."""


def _run(*command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *command],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_nothing_is_left_to_compile() -> None:
    used = _run("-c", USED)
    assert used.returncode == 0, f"compiled after all: {used.stderr}"


@pytest.mark.slow
def test_it_is_said_where_kernels_are_kept_and_then_nothing_more() -> None:
    warmed = _run("-m", "relguide.warm_up")
    assert warmed.returncode == 0, warmed.stderr
    assert "The kernels are compiled" in warmed.stdout
    again = _run("-m", "relguide.warm_up")
    assert (again.stdout, again.stderr) == ("The kernels are compiled.\n", "")


def test_a_stamp_changes_with_what_is_imported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kernels = tmp_path / "kernels"
    (kernels / "words").mkdir(parents=True)
    (kernels / "base").mkdir()
    (tmp_path / "units.py").write_text("G0 = 9.8\n")
    (kernels / "words" / "top.py").write_text("from relguide.kernels.words.middle import f\n")
    (kernels / "words" / "middle.py").write_text("from relguide.kernels.base.turn import g\n")
    (kernels / "base" / "turn.py").write_text("from relguide.units import G0\n")
    (kernels / "base" / "apart.py").write_text("")
    monkeypatch.setattr(cache, "HERE", kernels)

    def stamps() -> dict[str, str]:
        cache._made_of.cache_clear()
        cache._stamp.cache_clear()
        return {file.stem: cache._stamp((file,)) for file in kernels.rglob("*.py")}

    before = stamps()
    (tmp_path / "units.py").write_text("G0 = 9.80665\n")
    after = stamps()
    assert {name for name in before if before[name] != after[name]} == {"top", "middle", "turn"}


def test_a_folder_that_can_only_be_read_serves_if_it_was_filled(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read_only, empty = tmp_path / "read_only", tmp_path / "empty"
    read_only.mkdir()
    monkeypatch.setattr(cache, "_places", lambda: [empty, read_only])
    monkeypatch.setattr(cache, "_can_write", lambda place: False)
    assert not cache.filled(read_only)
    assert cache.folder.__wrapped__().name.startswith("relguide-")
    cache.record(read_only)
    assert cache.filled(read_only)
    assert cache.folder.__wrapped__() == read_only
    (read_only / cache.RECORD).write_text("{")
    assert not cache.filled(read_only)


def test_kernels_are_kept_where_we_say() -> None:
    from relguide.kernels.base.motion import advance

    assert advance.stats.cache_path == str(cache.folder())

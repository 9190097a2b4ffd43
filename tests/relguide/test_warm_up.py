"""After `python -m relguide.warm_up` nothing is left to compile, and stale code is never run."""

import ast
import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from relguide import warm_up
from relguide.kernels import cache, compiling

USED = """
import sys
from importlib import import_module
from itertools import islice
from pkgutil import walk_packages
from numba.core.dispatcher import Dispatcher
from relguide import Plan, Situations, alternatives, check, kernels, plan, plan_arrays, prove
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.learn.audits.branch_judging import branch_audit_request, judge_chunk, latencies
from relguide.learn.words.branch_labels import LabelRequest, label_chunk
from relguide.learn.words.branch_network import features_of, load_network
from relguide.learn.network_planner import network_planner
from relguide.learn.tree.regular_planner import regular_planner
from relguide.warm_up import STEPS
from tests.situations import golden

def called():
    found = walk_packages(kernels.__path__, "relguide.kernels.")
    modules = [import_module(module.name) for module in found]
    found = {f for module in modules for f in vars(module).values() if isinstance(f, Dispatcher)}
    return {f"{f.py_func.__name__}{sig}" for f in found for sig in f.signatures}

counts, compiled = {}, set()
for name, step in STEPS.items():
    step.run()
    counts[name] = len(called() - compiled)
    compiled = called()
print(counts)
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
latencies(network, branch_audit_request(network, 100, 1))
judge_chunk(network, branch_audit_request(network, 100, 1), 0)
features_of(label_chunk(LabelRequest(count=100), 0).situations)
sys.exit(", ".join(called() - compiled) or 0)
"""
"""What a user may do; its exit status names the kernels that are then compiled after all."""


FLOWN = """
import sys
from importlib import import_module
from pkgutil import walk_packages
from numba.core.dispatcher import Dispatcher
from relguide import kernels, plan
from relguide.flying.flight import LeaderHeading, LeaderSpeed, fly
from relguide.flying.scenarios import scenario
from relguide.warm_up import STEPS
from tests.flights import saying

def called():
    found = walk_packages(kernels.__path__, "relguide.kernels.")
    modules = [import_module(module.name) for module in found]
    found = {f for module in modules for f in vars(module).values() if isinstance(f, Dispatcher)}
    return {
        f"{f.py_func.__name__}{sig}" for f in found for sig in f.signatures
        if f.py_func.__module__.startswith(kernels.__name__ + ".flight")
    }

STEPS["flying"].run()
compiled = called()
surprises = (100.0, LeaderHeading(heading=3.0)), (200.0, LeaderSpeed(tas=150.0))
for name in ("fig_6a", "fig_6b"):
    for commands in (saying(), saying(*surprises)):
        for _ in fly(scenario(name), plan, commands=commands, sample_period=1.0):
            pass
sys.exit(", ".join(called() - compiled) or 0)
"""
"""First flights after the step that is for them; as above, of the kernels that fly."""


def _run(*command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *command],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_nothing_is_left_to_compile_and_as_much_is_compiled_as_is_said() -> None:
    used = _run("-c", USED)
    assert used.returncode == 0, f"compiled after all: {used.stderr}"
    counts = ast.literal_eval(used.stdout)
    said = {name: step.kernels for name, step in warm_up.STEPS.items()}
    far = {name: n for name, n in counts.items() if abs(n - said[name]) > 2 + 0.05 * n}
    assert not far, f"steps.py says {said}"


@pytest.mark.slow
def test_a_first_flight_waits_for_no_kernel_of_its_own() -> None:
    used = _run("-c", FLOWN)
    assert used.returncode == 0, f"compiled in flight: {used.stderr}"


@pytest.mark.slow
def test_it_says_where_kernels_are_kept_and_then_nothing_more() -> None:
    warmed = _run("-m", "relguide.warm_up")
    assert warmed.returncode == 0, warmed.stderr
    assert "The kernels are compiled and" in warmed.stdout
    again = _run("-m", "relguide.warm_up")
    assert (again.stdout, again.stderr) == ("The kernels are compiled and in place.\n", "")


def test_a_step_waits_for_those_it_builds_on() -> None:
    order = list(warm_up.STEPS)
    for name, step in warm_up.STEPS.items():
        assert all(order.index(before) < order.index(name) for before in step.after)
    assert warm_up._ready(["flying", "limited", "tree"], ()) == ["flying"]
    assert warm_up._ready(["limited", "proofs", "tree"], ()) == ["limited", "tree"]
    assert warm_up._ready(["proofs", "tree"], ["limited"]) == ["tree"]


def test_where_nothing_is_missing_nothing_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "folder", lambda: tmp_path)
    cache.record(warm_up.STEPS, tmp_path)
    before = sorted(tmp_path.iterdir())
    assert [state.done for state in warm_up.prepare((), jobs=1)] == [()]
    assert sorted(tmp_path.iterdir()) == before


def test_steps_run_in_processes_and_are_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "folder", lambda: tmp_path)
    monkeypatch.setattr(warm_up, "STEPS", {
        "first": warm_up.Step("one", 4, lambda: None),
        "second": warm_up.Step("two", 4, lambda: None, after=("first",)),
    })  # fmt: skip
    _workers(monkeypatch, f"print({warm_up.COMPILED!r} * 6, end='')")
    states = list(warm_up.prepare(["first", "second"], jobs=2))
    assert states[0] == ("one", 0.0, 0, ())
    assert ("one", 0.25, 1, ()) in states
    assert ("two", 0.75, 7, ("first",)) in states  # more than said, and not done for that
    assert states[-1] == ("", 1.0, 8, ("first", "second"))
    assert cache.is_warm("first", tmp_path)
    assert cache.is_full(tmp_path)
    assert warm_up.missing(["first", "second"]) == ()


def test_a_step_that_breaks_off_says_why_and_is_not_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "folder", lambda: tmp_path)
    _workers(monkeypatch, "raise SystemExit('the disk is full')")
    with pytest.raises(warm_up.WarmUpError, match="the disk is full"):
        list(warm_up.prepare(["flying"], jobs=1))
    assert warm_up.missing(["flying"]) == ("flying",)


def test_steps_are_ended_when_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "folder", lambda: tmp_path)
    _workers(monkeypatch, "import time; time.sleep(60)")
    states = list(warm_up.prepare(["flying"], jobs=1, stopped=lambda: True))
    assert states == [(warm_up.STEPS["flying"].title, 0.0, 0, ())]
    assert not cache.is_warm("flying", tmp_path)


def _workers(monkeypatch: pytest.MonkeyPatch, code: str) -> None:
    """Run something else in the place of every step."""
    start = subprocess.Popen

    def begin(command: list[str], **options: Any) -> "subprocess.Popen[str]":
        return start([sys.executable, "-c", code], **options)

    monkeypatch.setattr(warm_up.subprocess, "Popen", begin)


SAVES = """
import sys
from relguide.kernels import cache
index = cache.LockedIndex(str(cache.folder()), "f-1.py3", "stamp")
for i in range(30):
    index.save((sys.argv[1], i), (sys.argv[1], i))
"""


@pytest.mark.slow
def test_processes_that_compile_the_same_kernel_do_not_mix_it_up(tmp_path: Path) -> None:
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    processes = [
        subprocess.Popen([sys.executable, "-c", SAVES, name], env=environment) for name in "abcd"
    ]
    assert [process.wait() for process in processes] == [0] * 4
    index = cache.LockedIndex(str(tmp_path / "relguide"), "f-1.py3", "stamp")
    keys = [(name, i) for name in "abcd" for i in range(30)]
    assert [index.load(key) for key in keys] == keys


def test_kernels_of_a_wheel_become_this_machines_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shipped, place, other = tmp_path / "shipped", tmp_path / "place", tmp_path / "other"
    for each in (shipped, place, other):
        each.mkdir()
    here = cache._expected_record()
    for_any = [*here[:-2], *cache.ANY_CPU]
    index = cache.LockedIndex(str(shipped), "f-1.py3", "stamp")
    index.save(("types", tuple(for_any[-3:]), "code"), "machine code")
    monkeypatch.setattr(cache, "_expected_record", lambda: for_any)
    cache.record(["flying", cache.EVERYTHING], shipped)
    monkeypatch.setattr(cache, "_expected_record", lambda: here)

    monkeypatch.setattr(cache, "folder", lambda: place)
    cache.adopt(shipped)
    assert cache.is_full(place)
    assert cache.is_warm("flying", place)
    own = cache.LockedIndex(str(place), "f-1.py3", "stamp")
    assert own.load(("types", tuple(here[-3:]), "code")) == "machine code"
    (place / "f-1.py3.nbi").unlink()
    cache.adopt(shipped)  # once is enough
    assert not (place / "f-1.py3.nbi").exists()

    monkeypatch.setattr(cache, "folder", lambda: other)
    monkeypatch.setattr(cache, "_expected_record", lambda: ["other sources", *here[1:]])
    cache.adopt(shipped)
    assert not list(other.glob("*.nbi"))


@pytest.mark.parametrize(("terminal", "spent"), [(True, 0.4), (False, 2.1)])
def test_the_first_use_is_announced_once(
    terminal: bool,
    spent: float,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    first = compiling.FirstUse()
    monkeypatch.setattr(sys.stderr, "isatty", lambda: terminal, raising=False)
    first._count(0.5 * spent)
    assert capsys.readouterr().err == ""
    first._count(0.5 * spent)
    first._count(spent)
    said = capsys.readouterr().err
    assert said == f"{compiling.ONCE.format(folder=cache.folder())}"


NOWHERE = """
import sys
from pathlib import Path
from relguide.kernels import cache, compiling
cache._can_write = cache.is_full = lambda place: False
cache.folder.cache_clear()
compiling.first_use._count(5.0)
print(cache.folder())
assert cache.folder().is_dir()
"""

CHILD = """
import subprocess
subprocess.run([sys.executable, "-c", '''
from relguide.kernels import cache
cache._can_write = cache.is_full = lambda place: False
cache.folder.cache_clear()
print(cache.folder())
'''])
"""


def test_where_nothing_can_be_kept_it_says_so_with_the_cure_and_cleans_up() -> None:
    done = _run("-c", NOWHERE)
    assert done.returncode == 0, done.stderr
    assert "they can be kept in none of" in done.stderr
    assert "NUMBA_CACHE_DIR" in done.stderr
    assert not Path(done.stdout.strip()).exists()
    with_child = _run("-c", NOWHERE + CHILD)
    assert len({*with_child.stdout.split()}) == 1


def test_memory_limits_the_processes(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(warm_up.os, "sched_getaffinity", lambda _: range(8), raising=False)
    for gigabytes, jobs in ((0.5, 1), (3.5, 3), (64.0, 8)):
        monkeypatch.setattr(warm_up, "_available_memory", lambda g=gigabytes: int(g * 2**30))
        assert warm_up.usual_jobs() == jobs
    assert warm_up._left_to_container(tmp_path) == sys.maxsize
    (tmp_path / "memory.current").write_text("1000\n")
    (tmp_path / "memory.max").write_text("max\n")
    assert warm_up._left_to_container(tmp_path) == sys.maxsize
    (tmp_path / "memory.max").write_text("5000\n")
    assert warm_up._left_to_container(tmp_path) == 4000


def test_a_stamp_changes_with_what_is_imported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kernels = tmp_path / "kernels"
    (kernels / "words" / "room").mkdir(parents=True)
    (kernels / "base").mkdir()
    (tmp_path / "units.py").write_text("G0 = 9.8\n")
    (kernels / "words" / "top.py").write_text("from relguide.kernels.words.room.middle import f\n")
    (kernels / "words" / "room" / "middle.py").write_text(
        "from relguide.kernels.base.turn import g\n"
    )
    (kernels / "base" / "turn.py").write_text("from relguide.units import G0\n")
    (kernels / "base" / "apart.py").write_text("")
    monkeypatch.setattr(cache, "HERE", kernels)

    def stamps() -> dict[str, str]:
        cache._digest_and_imports.cache_clear()
        cache.stamp.cache_clear()
        return {file.stem: cache.stamp((file,)) for file in kernels.rglob("*.py")}

    before = stamps()
    (tmp_path / "units.py").write_text("G0 = 9.80665\n")
    after = stamps()
    assert {name for name in before if before[name] != after[name]} == {"top", "middle", "turn"}


def test_a_stamp_changes_with_the_room_of_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Machine code names the modules of its types."""
    rooms = [tmp_path / "kernels" / room for room in ("words", "base")]
    monkeypatch.setattr(cache, "HERE", tmp_path / "kernels")
    for room in rooms:
        room.mkdir(parents=True)
        (room / "turn.py").write_text("")
    first, second = (cache.stamp((room / "turn.py",)) for room in rooms)
    assert first != second


def test_whatever_a_kernel_imports_of_ours_is_seen() -> None:
    for file in (cache.HERE / "__init__.py").parent.glob("*/**/*.py"):
        found = set[Path]()
        for node in ast.walk(ast.parse(file.read_bytes())):
            if isinstance(node, ast.ImportFrom) and str(node.module).startswith("relguide."):
                place = cache.HERE.parent.joinpath(*str(node.module).split(".")[1:])
                names = [alias.name for alias in node.names]
                found |= (
                    {place / f"{name}.py" for name in names}
                    if place.is_dir()
                    else {place.with_suffix(".py")}
                )
        assert set(cache._digest_and_imports(file)[1]) == found, file


def test_a_folder_that_can_only_be_read_serves_if_it_was_filled(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(cache.SHARED, "")  # so that it is unset again, whatever is set below
    monkeypatch.delenv(cache.SHARED)
    read_only, empty = tmp_path / "read_only", tmp_path / "empty"
    read_only.mkdir()
    monkeypatch.setattr(cache, "places", lambda: [empty, read_only])
    monkeypatch.setattr(cache, "_can_write", lambda place: False)
    assert not cache.is_full(read_only)
    assert cache.folder.__wrapped__().name.startswith("relguide-")
    cache.record([cache.EVERYTHING], read_only)
    assert cache.is_full(read_only)
    assert cache.folder.__wrapped__() == read_only
    (read_only / f"{cache.EVERYTHING}{cache.RECORD}").write_text("{")
    assert not cache.is_full(read_only)


@pytest.mark.parametrize(
    "rest", [b"cno_such_module\nType\n.", b"crelguide.units\nNoSuchType\n.", b"", b"\x80"]
)
def test_an_index_that_cannot_be_read_is_out_of_date_and_nothing_worse(
    tmp_path: Path, rest: bytes
) -> None:
    """After an upgrade in place it may name types of modules that are no more."""
    index = cache.LockedIndex(str(tmp_path), "kernel", "stamp")
    index.save("signature", "machine code")
    assert index.load("signature") == "machine code"
    (file,) = tmp_path.glob("*.nbi")
    file.write_bytes(pickle.dumps(index._version) + rest)
    assert index.load("signature") is None
    index.save("signature", "compiled anew")
    assert index.load("signature") == "compiled anew"


@pytest.mark.parametrize("step", ["_save_data", "_save_index"])
@pytest.mark.parametrize("after", [False, True], ids=["before", "after"])
def test_a_process_that_is_killed_while_it_saves_leaves_no_code_of_other_sources(
    step: str, after: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A file keeps its name from sources to sources: who took the old for the new would crash."""
    older = cache.LockedIndex(str(tmp_path), "kernel", "older sources")
    older.save("signature", "older machine code")
    newer = cache.LockedIndex(str(tmp_path), "kernel", "newer sources")
    save = getattr(newer, step)

    def be_killed(*arguments: object) -> None:
        if after:
            save(*arguments)
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(newer, step, be_killed)
        with pytest.raises(KeyboardInterrupt):
            newer.save("signature", "newer machine code")
    assert newer.load("signature") in (None, "newer machine code")
    assert older.load("signature") in (None, "older machine code")
    newer.save("signature", "newer machine code")
    newer.save("another", "more")
    assert newer.load("signature") == "newer machine code"
    assert newer.load("another") == "more"


def test_kernels_are_kept_where_we_say() -> None:
    from relguide.kernels.base.motion import advance

    assert advance.stats.cache_path == str(cache.folder())

"""A batch as a process with others: killed and resumed, stopped by Ctrl-C, fed by a pipe."""

import csv
import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import pyarrow.parquet as pq
import pytest

from tests.bodies import BODY, change
from tests.command_line import NEAR, UNREACHABLE, Run
from tests.relguide.cli.test_batch import lines_of, without_time

COUNT = 3000
BODIES = [{"id": n, **(BODY, NEAR, change("leader.intent", []))[n % 3]} for n in range(COUNT)]
"""They take a second: every third some milliseconds, as the limit binds there."""
SMALL = """
import sys
from relguide.__main__ import main
from relguide.cli.batch import order, part
order.AT_ONCE, part.KEPT_EVERY = dict.fromkeys(order.AT_ONCE, 5), 0.05
sys.exit(main(["plan", "--batch", *sys.argv[1:]]))
"""
"""The command with chunks of five lines, so that there is something to stop."""
slow = pytest.mark.slow


@contextmanager
def begin(*arguments: str, **options: Any) -> Iterator[subprocess.Popen[str]]:
    """The command in a group of processes of its own, as a terminal starts it."""
    with subprocess.Popen(
        [sys.executable, "-c", SMALL, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        **options,
    ) as running:
        try:
            yield running
        finally:
            if running.poll() is None:
                os.killpg(running.pid, signal.SIGKILL)


def wait_for(what: Callable[[], bool], within: float = 300.0) -> None:
    end = monotonic() + within
    while not what():
        assert monotonic() < end
        sleep(0.02)


def answered(record: Path) -> int:
    """How many answers a record says that count."""
    try:
        return int(json.loads(record.read_text())["reached"]["answers"])
    except FileNotFoundError:
        return 0


def is_gone(group: int) -> bool:
    """Whether no process of a group is left."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return True
    return False


@pytest.fixture
def situations(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("all.jsonl").write_text("".join(json.dumps(body) + "\n" for body in BODIES))
    return "all.jsonl"


@slow
@pytest.mark.parametrize("out", ["out.jsonl", "out.csv", "out.parquet"])
def test_a_killed_run_goes_on_where_it_was(run: Run, situations: str, out: str) -> None:
    options = ("--out", out, "--processes", "2")
    part, record = Path(f"{out}.part"), Path(f"{out}.part.json")
    with begin(situations, *options) as running:
        wait_for(lambda: answered(record) >= 50)
        running.kill()
        running.wait()
        wait_for(lambda: is_gone(running.pid), within=10.0)  # its helpers follow it
    assert not Path(out).exists()
    kept = json.loads(record.read_text())["reached"]
    assert 50 <= kept["answers"] < COUNT
    before = part.read_bytes()[: kept["written"]]
    with part.open("ab") as torn:
        torn.write(b'{"id": 7, "sta')

    # any number of processes may go on with it
    again = ("plan", "--batch", situations, "--out", out, "--processes", "1")
    code, _, err = run(*again)
    assert code == 2
    assert f"{part} is left from a run that was stopped: --resume goes on with it" in err
    code, _, err = run(*again, "--resume", "--fields", "times")
    assert code == 2
    assert f"{part} is of a run that was asked for something else" in err
    assert part.read_bytes().startswith(before)

    code, said, err = run(*again, "--resume")
    assert (code, err) == (0, "")
    assert said.startswith(f"{out}: {COUNT:,} answers, in ")
    assert not part.exists()
    assert not record.exists()
    whole = ("--out", f"whole{Path(out).suffix}", "--processes", "1")
    assert run("plan", "--batch", situations, *whole)[0] == 0
    assert same(out, f"whole{Path(out).suffix}")
    if out.endswith("l"):
        assert Path(out).read_bytes().startswith(before)  # nothing is answered twice


def same(one: str, other: str) -> bool:
    """Whether two files have the same answers, whatever they took to compute."""
    if one.endswith(".jsonl"):
        return without_time(lines_of(one)) == without_time(lines_of(other))
    tables = []
    for name in (one, other):
        if name.endswith(".csv"):
            tables.append(without_time(list(csv.DictReader(Path(name).read_text().splitlines()))))
        else:
            tables.append(without_time(pq.read_table(name).to_pylist()))
    return tables[0] == tables[1]


@slow
def test_an_input_that_has_changed_is_not_gone_on_with(run: Run, situations: str) -> None:
    options = ("--out", "out.jsonl", "--fields", "times", "--processes", "1")
    Path("few.jsonl").write_text("".join(Path(situations).read_text().splitlines(True)[:50]))
    record = Path("out.jsonl.part.json")
    with begin(situations, *options) as running:
        wait_for(lambda: answered(record) >= 50)
        running.kill()
    lines = Path(situations).read_text().splitlines(keepends=True)
    Path(situations).write_text("".join([*lines[1:], lines[0]]))
    kept = record.read_text()
    for changed in (situations, "few.jsonl"):
        code, out, err = run("plan", "--batch", changed, *options, "--resume")
        assert (code, out) == (2, "")
        assert err.startswith("relguide: out.jsonl.part was made of another input: ")
        assert json.loads(record.read_text()) == json.loads(kept)
    Path(situations).write_text("".join(lines))
    assert run("plan", "--batch", situations, *options, "--resume")[0] == 0
    assert [answer["id"] for answer in lines_of("out.jsonl")] == list(range(COUNT))


@slow
@pytest.mark.parametrize("processes", ["1", "2"])
def test_ctrl_c_stops_all_and_keeps_what_is_done(run: Run, situations: str, processes: str) -> None:
    options = ("--out", "out.jsonl", "--processes", processes)
    with begin(situations, *options) as running:
        wait_for(lambda: answered(Path("out.jsonl.part.json")) >= 50)
        os.killpg(running.pid, signal.SIGINT)
        _, err = running.communicate(timeout=30)
    assert running.returncode == 130
    assert err.strip() == (
        "relguide: What is done is in out.jsonl.part: --resume goes on with it.\n\n"
        "relguide: stopped."
    )
    assert is_gone(running.pid)
    assert answered(Path("out.jsonl.part.json")) >= 50
    options = ("--out", "out.jsonl", "--processes", "1")
    assert run("plan", "--batch", situations, *options, "--resume")[0] == 0
    assert [answer["id"] for answer in lines_of("out.jsonl")] == list(range(COUNT))


@slow
@pytest.mark.parametrize("processes", ["1", "3"])
def test_answers_come_in_order_from_any_number_of_processes(
    run: Run, situations: str, processes: str
) -> None:
    bodies = [*BODIES[:100], *({"id": n, **UNREACHABLE} for n in range(100, 110)), {"id": 110}]
    Path(situations).write_text("".join(json.dumps(body) + "\n" for body in bodies))
    with begin(situations, "--processes", processes) as running:
        out, err = running.communicate(timeout=120)
    assert running.returncode == 1
    assert err == "relguide: 1 line is no valid situation, the first is line 111.\n"
    answers = [json.loads(line) for line in out.splitlines()]
    assert [answer["id"] for answer in answers] == list(range(111))
    assert answers[-1]["line"] == 111
    whole = run("plan", "--batch", situations, "--processes", "1")[1]
    assert without_time(answers) == without_time([json.loads(x) for x in whole.splitlines()])


@slow
@pytest.mark.parametrize("processes", ["1", "2"])
def test_a_pipe_is_answered_line_by_line(tmp_path: Path, processes: str) -> None:
    """Whoever asks one at a time and waits for the answer gets it."""
    with begin("-", "--processes", processes, stdin=subprocess.PIPE) as running:
        assert running.stdin is not None
        assert running.stdout is not None
        for body in BODIES[:12]:
            running.stdin.write(json.dumps(body) + "\n")
            running.stdin.flush()
            assert json.loads(running.stdout.readline())["id"] == body["id"]
        running.stdin.close()
        assert running.wait(timeout=30) == 0


@slow
def test_a_reader_that_has_seen_enough_ends_all(situations: str) -> None:
    with begin(situations, "--processes", "2") as running:
        assert running.stdout is not None
        running.stdout.readline()
        running.stdout.close()
        assert running.wait(timeout=60) == 1
        assert running.stderr is not None
        assert running.stderr.read() == ""
    wait_for(lambda: is_gone(running.pid), within=10.0)

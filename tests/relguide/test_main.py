"""The command line: what it prints, how it ends, and that it never shows a traceback."""

import gzip
import json
import signal
import socket
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import monotonic, sleep
from typing import Any
from urllib.request import urlopen

import pytest

from relguide.__main__ import main
from relguide.contract.recorder import replay
from relguide.flying.documents import FlightStarted
from tests.relguide.contract.test_contract import BODY, changed

FIGURES = {
    "joined",
    "join_time_s",
    "planned_time_s",
    "least_separation_m",
    "heading_swing_deg",
    "bank_reversals",
    "replans",
    "fallbacks",
    "track_nm",
    "simulated_s",
    "wall_s",
}
NEAR = {
    "pursuer": {**BODY["pursuer"], "x_m": -20000, "y_m": 3000},
    "leader": {**BODY["leader"], "intent": []},
    "slot_distance_m": 10000,
    "min_separation_m": 9260,
}
UNREACHABLE = changed("leader.tas_mps", 300)

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run a command in a folder of its own: exit code, standard output, standard error."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")

    def run(*arguments: str) -> tuple[int, str, str]:
        try:
            code = main(arguments)
        except SystemExit as end:  # argparse ends so
            code = int(end.code or 0)
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        return code, out, err

    return run


def written(content: Any, name: str = "situation.json") -> str:
    Path(name).write_text(content if isinstance(content, str) else json.dumps(content), "utf-8")
    return name


# --- plan ---------------------------------------------------------------------------------------


def test_plan_prints_the_plan(run: Run) -> None:
    code, out, err = run("plan", written(BODY))
    reply = json.loads(out)
    assert (code, err) == (0, "")
    assert (reply["status"], reply["planner"]) == ("planned", "exact")
    assert reply["compute_ms"] < 1000.0  # without loading the kernels


@pytest.mark.slow
def test_plan_reads_standard_input() -> None:
    done = process("plan", "-", input=json.dumps({"id": "a", **BODY}))
    assert done.returncode == 0
    assert json.loads(done.stdout)["id"] == "a"


def test_no_plan_is_an_answer_with_exit_1(run: Run) -> None:
    code, out, _ = run("plan", written(UNREACHABLE))
    assert code == 1
    assert json.loads(out)["status"] == "no_plan"
    code, out, _ = run("plan", written(UNREACHABLE), "--table")
    assert code == 1
    assert "No plan (slot_unreachable)" in out


def test_the_table_is_for_people(run: Run) -> None:
    code, out, _ = run("plan", written(BODY), "--table")
    assert code == 0
    assert "Joins in 19:38.5 by RSR" in out
    assert "43.4°" in out
    assert "NM" in out
    assert "…" not in out
    assert max(map(len, out.splitlines())) <= 100


def test_the_table_says_why_each_other_way_lost(run: Run) -> None:
    _, out, _ = run("plan", written(BODY), "--table")
    lines = out.splitlines()
    (head,) = [line for line in lines if line.split()[:1] == ["instead"]]
    others = lines[lines.index(head) + 2 : -1]
    assert [line.split()[0] for line in others] == ["LSR", "RSL", "LSL", "LRL", "RLR"]
    # aligned: each reason begins below its heading
    at = head.index("why not")
    assert others[0][at:].rstrip() == "2,115 s slower"
    assert others[-1][at:].rstrip() == "no such path to the slot"


def test_optimality_is_told_on_demand(run: Run) -> None:
    code, out, _ = run("plan", written(BODY), "--optimality")
    assert code == 0
    assert json.loads(out)["optimality"]["switching_ok"] is True
    assert len(json.loads(out)["optimality"]["panel"]["t_s"]) > 100
    code, out, _ = run("plan", "situation.json", "--table", "--optimality")
    assert code == 0
    assert "Stationary, as eq. (16) asks: H is within " in out
    assert "Stationary" not in run("plan", "situation.json", "--table")[1]
    code, out, _ = run("plan", "--batch", written(json.dumps(BODY), "a.jsonl"), "--optimality")
    assert json.loads(out)["optimality"]["switching_ok"] is True
    code, out, _ = run("plan", written(UNREACHABLE), "--optimality")
    assert (code, json.loads(out)["status"]) == (1, "no_plan")


def test_a_planner_to_come_is_refused(run: Run) -> None:
    for command in (("plan", written(BODY)), ("fly", "fig_6b")):
        code, out, err = run(*command, "--planner", "regular_dp")
        assert (code, out) == (2, "")
        assert err == "relguide: The planner regular_dp is not part of this version: use exact.\n"


def test_the_network_plans_a_situation_and_a_batch(run: Run) -> None:
    code, out, err = run("plan", written(BODY), "--planner", "network")
    by_network, exact = json.loads(out), json.loads(run("plan", written(BODY))[1])
    assert (code, err) == (0, "")
    assert (by_network["planner"], exact["planner"]) == ("network", "exact")
    assert by_network["time_to_converge_s"] == exact["time_to_converge_s"]
    assert by_network["optimality"]["proof"] == "bound"
    assert by_network["optimality"]["lower_bound_s"] < exact["time_to_converge_s"]
    table = run("plan", written(BODY), "--planner", "network", "--table")[1]
    assert "Planner network, " in table
    out = run("plan", "--batch", written(json.dumps(BODY), "a.jsonl"), "--planner", "network")[1]
    assert json.loads(out)["planner"] == "network"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("", "This is not JSON"),
        ("[", "This is not JSON"),
        (
            changed("pursuer.tas_mps", "fast"),
            'pursuer.tas_mps: must be a number, not the text "fast".',
        ),
        (changed("pursuer.tas_mps", ...), "pursuer.tas_mps: is missing."),
    ],
)
def test_a_bad_situation_is_misuse(run: Run, content: Any, sentence: str) -> None:
    for command in ("plan", "fly"):
        code, out, err = run(command, written(content))
        assert (code, out) == (2, "")
        assert err.startswith(f"relguide: {sentence}")


@pytest.mark.parametrize(
    "arguments",
    [
        (),
        ("dance",),
        ("plan",),
        ("plan", "none.json"),
        ("plan", "."),
        ("plan", "\0"),
        ("plan", sys.executable),
        ("plan", "--batch", "none.jsonl"),
        ("plan", "--batch", "."),
        ("plan", "none.json", "--planner", "best"),
        ("plan", "none.json", "--batch", "--table"),
        ("check",),
        ("check", "none.json"),
        ("check", "-", "-"),
        ("fly", "fig_7"),
        ("fly", "none.json"),
        ("fly", "none.csv"),
        ("fly", "fig_6b", "--record", "flight.txt"),
        ("fly", "fig_6b", "--record", "no/such/folder/flight.jsonl"),
        ("fly", "fig_6b", "--seed", "-1"),
        ("fly", "fig_6b", "--seed", "1" * 30),
        ("replay", "none.jsonl"),
        ("replay", sys.executable),
        ("serve", "--port", "0"),
        ("serve", "--port", "99999"),
        ("serve", "--host", "203.0.113.1"),
    ],
)
def test_misuse_is_told_in_a_sentence(run: Run, arguments: tuple[str, ...]) -> None:
    code, out, err = run(*arguments)
    assert (code, out) == (2, "")
    last = err.splitlines()[-1]
    assert last.startswith("relguide")
    assert len(last) > 20


@pytest.mark.parametrize("command", ["plan", "check", "fly", "replay", "serve"])
def test_help_has_examples(run: Run, command: str) -> None:
    code, out, _ = run(command, "--help")
    assert code == 0
    assert f"examples:\n  relguide {command}" in out
    assert command in run("--help")[1]


# --- batch --------------------------------------------------------------------------------------


def test_a_batch_is_answered_in_order(run: Run) -> None:
    lines = [{"id": n, **(UNREACHABLE if n == 2 else BODY)} for n in range(4)]
    file = written("\n".join(map(json.dumps, lines)), "batch.jsonl")
    code, out, err = run("plan", "--batch", file)
    replies = [json.loads(line) for line in out.splitlines()]
    assert (code, err) == (0, "")
    assert [reply["id"] for reply in replies] == [0, 1, 2, 3]
    assert [reply["status"] for reply in replies] == ["planned", "planned", "no_plan", "planned"]


def test_a_bad_line_is_answered_in_its_place(run: Run) -> None:
    lines = [json.dumps(BODY), "{", json.dumps({"id": "x"}), "", json.dumps({"id": "y", **BODY})]
    code, out, err = run("plan", "--batch", written("\n".join(lines), "batch.jsonl"))
    replies = [json.loads(line) for line in out.splitlines()]
    assert code == 1
    assert [reply["status"] for reply in replies] == ["planned", "invalid", "invalid", "planned"]
    assert [reply.get("id") for reply in replies] == [None, None, "x", "y"]
    assert replies[1]["message"].startswith("This is not JSON")
    assert err == "relguide: 2 lines are no valid situation, the first is line 2.\n"


def test_an_empty_batch_has_no_answers(run: Run) -> None:
    assert run("plan", "--batch", written("", "batch.jsonl")) == (0, "", "")


# --- check --------------------------------------------------------------------------------------


def test_check_judges_the_fastest_plan_and_what_is_entered(run: Run) -> None:
    situation = written(NEAR)
    code, out, err = run("check", situation)
    found = json.loads(out)
    assert (code, err, found["passed"]) == (0, "", True)
    triplets = written({"triplets": found["triplets"]}, "triplets.json")
    code, out, _ = run("check", situation, triplets)
    assert (code, json.loads(out)["reaches_slot"]) == (0, True)
    code, out, _ = run("check", situation, triplets, "--table", "--figure", "plan.svg")
    assert code == 0
    assert "Reaches the slot (18), (19)" in out
    assert "Keeps d_min (20)" in out
    assert "Stationary" in out
    assert Path("plan.svg").read_text("utf-8").startswith("<svg")
    found["triplets"][0]["theta_deg"] += 10.0
    off = written({"triplets": found["triplets"]}, "off.json")
    code, out, _ = run("check", situation, off, "--table")
    assert code == 1
    assert "Misses the slot" in out
    assert "It does not reach the slot." in out


def test_check_without_a_plan_and_with_a_leader_that_turns(run: Run) -> None:
    code, out, err = run("check", written({**NEAR, "leader": {**NEAR["leader"], "tas_mps": 390}}))
    assert (code, out) == (1, "")
    assert "cannot be caught" in err
    code, out, err = run("check", written(BODY))
    assert (code, out) == (2, "")
    assert "the intent of this one turns" in err


# --- fly and replay -----------------------------------------------------------------------------


@pytest.mark.slow
def test_fly_prints_the_contracts_figures(run: Run) -> None:
    code, out, _ = run("fly", "fig_6b", "--json")
    figures = json.loads(out)
    assert set(figures) == FIGURES
    assert (code, figures["joined"]) == (0, True)
    assert figures["simulated_s"] >= figures["join_time_s"] > 0.0
    assert figures["track_nm"] * 1852.0 == pytest.approx(figures["join_time_s"] * 240.0, rel=0.05)


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """A short flight: its recording, and its figures."""
    folder = tmp_path_factory.mktemp("flown")
    (folder / "near.json").write_text(json.dumps(NEAR))
    file = folder / "near.jsonl.gz"
    done = process("fly", str(folder / "near.json"), "--json", "--record", str(file), "--seed", "7")
    assert done.returncode == 0
    return file, json.loads(done.stdout)


@pytest.mark.slow
def test_a_recording_replays_to_the_same_figures(
    run: Run, flown: tuple[Path, dict[str, Any]]
) -> None:
    file, figures = flown
    code, out, _ = run("replay", str(file), "--json")
    told = json.loads(out)
    assert (code, told["complete"]) == (0, True)
    assert told["title"] == "The situation of near.json"
    documents = list(replay(file))
    assert told["documents"] == len(documents)
    assert isinstance(documents[0], FlightStarted)
    assert documents[0].seed == 7
    for name in FIGURES - {"wall_s"}:
        assert told[name] == pytest.approx(figures[name], rel=1e-9)
    code, out, _ = run("replay", str(file))
    assert code == 0
    for word in ("engaged", "least separation", "fallbacks"):
        assert word in out


@pytest.mark.slow
def test_of_a_damaged_recording_the_good_part_is_told(
    run: Run, flown: tuple[Path, dict[str, Any]]
) -> None:
    whole = gzip.decompress(flown[0].read_bytes())
    Path("near.jsonl").write_bytes(whole[: len(whole) // 2])
    code, out, err = run("replay", "near.jsonl", "--json")
    told = json.loads(out)
    assert code == 1
    assert told["complete"] is False
    assert told["documents"] > 10
    assert err.startswith("relguide: near.jsonl, line")
    assert err.endswith("the file is cut short here; what comes before is good.\n")
    Path("near.jsonl").write_bytes(b"".join(whole.splitlines(keepends=True)[:-1]))
    code, out, err = run("replay", "near.jsonl")
    assert code == 1
    assert "engaged" in out
    assert "ends before its flight does" in err


@pytest.mark.slow
def test_fly_without_a_plan_fails(run: Run) -> None:
    code, out, err = run("fly", written(UNREACHABLE), "--json")
    assert code == 1
    assert err == "relguide: It did not join within 3600 s.\n"
    assert json.loads(out)["joined"] is False


# --- as a process -------------------------------------------------------------------------------


def process(*arguments: str, input: str = "") -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "relguide", *arguments],
        input=input,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )


@pytest.mark.slow
def test_a_reader_that_has_seen_enough_is_no_error(tmp_path: Path) -> None:
    batch = tmp_path / "batch.jsonl"
    batch.write_text(f"{json.dumps(BODY)}\n" * 300)
    command = f"{sys.executable} -m relguide plan --batch {batch} | head -1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=120)
    assert json.loads(done.stdout)["status"] == "planned"
    assert done.stderr == ""


@pytest.mark.slow
def test_ctrl_c_stops_it_with_a_word() -> None:
    with subprocess.Popen(
        [sys.executable, "-m", "relguide", "plan", "--batch", "-"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as running:
        assert running.stdin is not None
        assert running.stdout is not None
        running.stdin.write(f"{json.dumps(BODY)}\n" * 20)
        running.stdin.flush()
        assert running.stdout.read(1) == "{"  # it is planning now
        running.send_signal(signal.SIGINT)
        _, err = running.communicate(timeout=60)
        assert running.returncode == 130
        assert err.strip() == "relguide: stopped."


def test_help_loads_nothing_heavy() -> None:
    program = (
        "import sys, relguide\n"
        "before = set(sys.modules)\n"
        "import relguide.__main__ as m\n"
        "try: m.main(['plan', '--help'])\n"
        "except SystemExit: pass\n"
        "heavy = {'torch', 'fastapi', 'uvicorn', 'pydantic', 'rich', 'numba', 'pyproj'}\n"
        "print('HEAVY', *sorted(heavy & (set(sys.modules) - before)))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout.splitlines()[-1] == "HEAVY"


@pytest.mark.slow
def test_serve_serves_and_stops(tmp_path: Path) -> None:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with subprocess.Popen(
        [sys.executable, "-m", "relguide", "serve", "--port", str(port)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as running:
        try:
            assert running.stdout is not None
            said = running.stdout.readline()
            assert said == f"relguide is on http://127.0.0.1:{port} (Ctrl-C stops it)\n"
            assert answers(f"http://127.0.0.1:{port}/healthz", within=60.0)
            taken = process("serve", "--port", str(port))
            assert taken.returncode == 2
            assert f"127.0.0.1, port {port}: Address already in use." in taken.stderr
        finally:
            running.send_signal(signal.SIGINT)
            running.wait(timeout=30)
    assert running.returncode in (0, 130)


def answers(url: str, *, within: float) -> bool:
    end = monotonic() + within
    while monotonic() < end:
        try:
            with urlopen(url, timeout=5) as response:
                return bool(response.status == 200)
        except OSError:
            sleep(0.1)
    return False

"""The command line: what it prints, how it ends, and that it never shows a traceback."""

import json
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.bodies import AMID, BODY, change
from tests.command_line import NEAR, UNREACHABLE, Run, process, write

ROUND = str(Path(__file__).parents[3] / "examples" / "round.json")
"""A situation in which d_min makes the plan longer."""

# --- plan ---------------------------------------------------------------------------------------


def test_plan_prints_the_plan(run: Run) -> None:
    code, out, err = run("plan", write(BODY))
    reply = json.loads(out)
    assert (code, err) == (0, "")
    assert (reply["status"], reply["planner"]) == ("planned", "exact")
    assert reply["compute_ms"] < 1000.0  # without loading the kernels


@pytest.mark.slow
def test_plan_reads_standard_input() -> None:
    done = process("plan", "-", input=json.dumps({"id": "a", **BODY}))
    assert done.returncode == 0
    assert json.loads(done.stdout)["id"] == "a"


def test_planners_are_compared_in_json_and_in_a_table(run: Run) -> None:
    code, out, err = run("plan", write(BODY), "--compare")
    assert (code, err) == (0, "")
    planners = json.loads(out)["planners"]
    assert [each["planner"] for each in planners] == [
        "exact", "network", "regular_dp", "printed_network",
    ]  # fmt: skip
    code, out, _ = run("plan", write(BODY), "--compare", "--table")
    assert code == 0
    assert "The paper's network: Not flown: it ends " in out
    code, _, err = run("plan", write(BODY), "--compare", "--planner", "network")
    assert code == 2
    assert "leave out --batch, --prove, --include and --planner" in err


def test_no_plan_is_an_answer_with_exit_1(run: Run) -> None:
    code, out, _ = run("plan", write(UNREACHABLE))
    assert code == 1
    assert json.loads(out)["status"] == "no_plan"
    code, out, _ = run("plan", write(UNREACHABLE), "--table")
    assert code == 1
    assert "No plan (slot_unreachable)" in out


def test_the_table_is_for_people(run: Run) -> None:
    code, out, _ = run("plan", write(BODY), "--table")
    assert code == 0
    assert "Joins in 19:38.5 by RSR" in out
    assert "43.4°" in out
    assert "NM" in out
    assert "…" not in out
    assert max(map(len, out.splitlines())) <= 100


def test_the_table_says_how_near_others_come(run: Run) -> None:
    code, out, _ = run("plan", write(AMID), "--table")
    assert code == 0
    lines = out.splitlines()
    (head,) = [at for at, line in enumerate(lines) if line.strip().startswith("keeps clear of")]
    others = json.loads(run("plan", write(AMID), "--json")[1])["separation"]["others"]
    assert [line.split()[0] for line in lines[head + 2 : head + 6]] == [o["ident"] for o in others]
    for line, other in zip(lines[head + 2 :], others, strict=False):
        assert f"{other['least_m'] / 1852.0:.2f} NM" in line
        assert ("out of it" in line) == (other["min_separation_m"] == 0.0)


def test_the_table_says_whether_the_gap_is_closed(run: Run) -> None:
    for options in ((), ("--prove", "10")):
        reply = json.loads(run("plan", ROUND, *options)[1])
        _, out, _ = run("plan", ROUND, *options, "--table")
        gap = reply["time_to_converge_s"] - reply["optimality"]["lower_bound_s"]
        open_ = reply["optimality"]["proof"] not in ("relaxation", "certified")
        said = f"gap of {gap:.1f} s is open" if open_ else "gap closed"
        assert said in " ".join(out.split())
        assert ("closed" in said) == bool(options)


def test_the_table_says_why_each_other_way_lost(run: Run) -> None:
    assert "instead" not in run("plan", write(BODY), "--table")[1]
    _, out, _ = run("plan", "situation.json", "--table", "--include", "alternatives")
    lines = out.splitlines()
    (head,) = [line for line in lines if line.split()[:1] == ["instead"]]
    others = lines[lines.index(head) + 2 : -1]
    assert [line.split()[0] for line in others] == ["LSR", "RSL", "LSL", "LRL", "RLR"]
    # aligned: each reason begins below its heading
    at = head.index("why not")
    assert others[0][at:].rstrip() == "2,115 s slower"
    assert others[-1][at:].rstrip() == "no such path to the slot"


def test_optimality_is_printed_on_demand(run: Run) -> None:
    code, out, _ = run("plan", write(BODY), "--include", "optimality")
    assert code == 0
    assert json.loads(out)["optimality"]["stationary"] is True
    assert len(json.loads(out)["optimality"]["costates"]["t_s"]) > 100
    code, out, _ = run("plan", "situation.json", "--table", "--include", "optimality")
    assert code == 0
    assert "Stationary, as eq. (16) asks: H is within " in out
    assert "Stationary" not in run("plan", "situation.json", "--table")[1]
    code, out, _ = run(
        "plan", "--batch", write(json.dumps(BODY), "a.jsonl"), "--include", "optimality"
    )
    assert json.loads(out)["optimality"]["stationary"] is True
    code, out, _ = run("plan", write(UNREACHABLE), "--include", "optimality")
    assert (code, json.loads(out)["status"]) == (1, "no_plan")


def test_the_papers_tree_plans_a_situation(run: Run) -> None:
    code, out, err = run("plan", write(BODY), "--planner", "regular_dp")
    by_tree, exact = json.loads(out), json.loads(run("plan", write(BODY))[1])
    assert (code, err) == (0, "")
    assert by_tree["planner"] == "regular_dp"
    assert by_tree["time_to_converge_s"] >= exact["time_to_converge_s"]
    assert by_tree["separation"]["least_m"] >= BODY["min_separation_m"]


def test_the_network_plans_a_situation_and_a_batch(run: Run) -> None:
    code, out, err = run("plan", write(BODY), "--planner", "network")
    by_network, exact = json.loads(out), json.loads(run("plan", write(BODY))[1])
    assert (code, err) == (0, "")
    assert (by_network["planner"], exact["planner"]) == ("network", "exact")
    assert by_network["time_to_converge_s"] == exact["time_to_converge_s"]
    proved, best = by_network["optimality"], exact["optimality"]
    assert proved["proof"] == best["proof"] == "relaxation"
    assert proved["lower_bound_s"] == pytest.approx(best["lower_bound_s"], abs=1e-6)
    table = run("plan", write(BODY), "--planner", "network", "--table")[1]
    assert "Planner network, " in " ".join(table.split())
    out = run("plan", "--batch", write(json.dumps(BODY), "a.jsonl"), "--planner", "network")[1]
    assert json.loads(out)["planner"] == "network"


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("", "This is not JSON"),
        ("[", "This is not JSON"),
        (
            change("pursuer.tas_mps", "fast"),
            'pursuer.tas_mps: must be a number, not the text "fast".',
        ),
        (
            change("pursuer.tas_mps", ...),
            "pursuer.tas_mps: is missing: it must lie in 30 … 400 m/s.",
        ),
    ],
)
def test_a_bad_situation_is_misuse(run: Run, content: Any, sentence: str) -> None:
    for command in ("plan", "fly"):
        code, out, err = run(command, write(content))
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
def test_misuse_gives_a_sentence(run: Run, arguments: tuple[str, ...]) -> None:
    code, out, err = run(*arguments)
    assert (code, out) == (2, "")
    last = err.splitlines()[-1]
    assert last.startswith("relguide")
    assert len(last) > 20


@pytest.mark.parametrize("option", ["--prove", "--deadline"])
@pytest.mark.parametrize("given", ["soon", "-1", "nan", "3601"])
def test_times_are_refused_in_one_sentence(run: Run, option: str, given: str) -> None:
    code, out, err = run("plan", "none.json", option, given)
    assert (code, out) == (2, "")
    assert err.endswith(f"{option}: must be a number of seconds from 0 to 3600, not {given}\n")


@pytest.mark.parametrize("command", ["plan", "check", "fly", "replay", "serve"])
def test_help_has_examples(run: Run, command: str) -> None:
    code, out, _ = run(command, "--help")
    assert code == 0
    assert f"examples:\n  relguide {command}" in out
    assert command in run("--help")[1]


# --- batch --------------------------------------------------------------------------------------


def test_a_batch_is_answered_in_order(run: Run) -> None:
    lines = [{"id": n, **(UNREACHABLE if n == 2 else BODY)} for n in range(4)]
    file = write("\n".join(map(json.dumps, lines)), "batch.jsonl")
    code, out, err = run("plan", "--batch", file)
    replies = [json.loads(line) for line in out.splitlines()]
    assert (code, err) == (0, "")
    assert [reply["id"] for reply in replies] == [0, 1, 2, 3]
    assert [reply["status"] for reply in replies] == ["planned", "planned", "no_plan", "planned"]


def test_a_bad_line_is_answered_in_its_place(run: Run) -> None:
    lines = [json.dumps(BODY), "{", json.dumps({"id": "x"}), "", json.dumps({"id": "y", **BODY})]
    code, out, err = run("plan", "--batch", write("\n".join(lines), "batch.jsonl"))
    replies = [json.loads(line) for line in out.splitlines()]
    assert code == 1
    assert [reply["status"] for reply in replies] == ["planned", "invalid", "invalid", "planned"]
    assert [reply.get("id") for reply in replies] == [None, None, "x", "y"]
    assert replies[1]["message"].startswith("This is not JSON")
    assert err == "relguide: 2 lines are no valid situation, the first is line 2.\n"


def test_one_situation_and_many_are_told_apart(run: Run) -> None:
    lines = write("\n".join([json.dumps(BODY)] * 2), "batch.jsonl")
    for command in ("plan", "fly"):
        code, _, err = run(command, lines)
        assert code == 2
        assert "a situation a line: relguide plan --batch plans them all" in err
    assert run("plan", write(json.dumps(BODY) + "\n"))[0] == 0
    code, _, err = run("plan", "--batch", write(json.dumps(BODY, indent=2)))
    assert code == 1
    assert err.endswith("relguide: If situation.json is one situation, leave --batch out.\n")


def test_miles_given_as_metres_are_asked_about(run: Run) -> None:
    code, _, err = run("plan", write(BODY | {"slot_distance_m": 6, "min_separation_m": 5}))
    assert code == 0
    assert "relguide: slot_distance_m is 6 m. If 6 NM are meant: 11112.\n" in err
    assert "relguide: min_separation_m is 5 m. If 5 NM are meant: 9260.\n" in err


def test_an_empty_batch_has_no_answers(run: Run) -> None:
    assert run("plan", "--batch", write("", "batch.jsonl")) == (0, "", "")


# --- check --------------------------------------------------------------------------------------


def test_check_judges_the_fastest_plan_and_what_is_entered(run: Run) -> None:
    situation = write(NEAR)
    code, out, err = run("check", situation)
    found = json.loads(out)
    assert (code, err, found["passed"]) == (0, "", True)
    triplets = write({"triplets": found["triplets"]}, "triplets.json")
    code, out, _ = run("check", situation, triplets)
    assert (code, json.loads(out)["reaches_slot"]) == (0, True)
    code, out, _ = run("check", situation, triplets, "--table", "--figure", "plan.svg")
    assert code == 0
    assert "Reaches the slot (18), (19)" in out
    assert "Keeps d_min (20)" in out
    assert "Stationary" in out
    assert Path("plan.svg").read_text("utf-8").startswith("<svg")
    found["triplets"][0]["theta_deg"] += 10.0
    off = write({"triplets": found["triplets"]}, "off.json")
    code, out, err = run("check", situation, off, "--figure", "off.svg")
    assert (code, json.loads(out)["passed"]) == (1, False)
    assert err == "relguide: off.svg shows a trajectory that misses the slot.\n"
    assert "; failed: it misses the slot" in Path("off.svg").read_text("utf-8")
    assert "failed" not in Path("plan.svg").read_text("utf-8")
    code, out, _ = run("check", situation, off, "--table")
    assert code == 1
    assert "Misses the slot" in out
    assert "It does not reach the slot." in out


def test_check_says_which_file_is_wrong(run: Run) -> None:
    situation, triplets = write(NEAR), write({"triplets": []}, "triplets.json")
    one = write([{"epsilon": 1, "theta_deg": 60.0, "l_m": 0.0}], "one.json")
    for arguments, sentence in (
        ((triplets, situation), "triplets.json holds triplets: name the situation before them."),
        ((situation, one), "one.json: This must be an object with fields, not a list."),
        ((situation, "--figure", "plan.pdf"), "--figure: must end in .svg, not be plan.pdf"),
    ):
        code, out, err = run("check", *arguments)
        assert (code, out) == (2, "")
        assert sentence in err
    assert not Path("plan.pdf").exists()


def test_check_without_a_plan_and_with_a_leader_that_turns(run: Run) -> None:
    code, out, err = run("check", write({**NEAR, "leader": {**NEAR["leader"], "tas_mps": 390}}))
    assert (code, out) == (1, "")
    assert "cannot be caught" in err
    code, out, err = run("check", write(BODY))
    assert (code, out) == (2, "")
    assert "the intent of this one turns: leave it out." in err


def test_what_may_be_compiled_is_what_the_steps_are_named_by() -> None:
    from relguide.cli.warm_up_command import FOR
    from relguide.warm_up import SETS

    assert FOR == tuple(SETS)

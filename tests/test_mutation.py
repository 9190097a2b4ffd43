"""The tool that puts faults into the code: on a module made for it, and whether its lists hold."""

import subprocess
import tomllib
from pathlib import Path

import pytest

from tools.mutation.chosen_tests import judges_of
from tools.mutation.named import NAMED, Named
from tools.mutation.operators import edits
from tools.mutation.outcomes import EQUIVALENT, Journal, Outcome, score, survivors
from tools.mutation.sampling import mutant, sample
from tools.mutation.workshop import Workshop

ROOT = Path(__file__).parents[1]
PLANNING, KERNELS = Path("relguide/planning"), Path("relguide/kernels")
TOY = '''"""A toy."""


def count(values: list[float], limit: float = 0.5) -> int:
    """How many lie above a limit."""
    found = 0
    for value in values:
        if abs(value) - 1 > limit and not value == 7.0:
            found += 1
    return found
'''
TEST = """from relguide.planning.toy import count


def test_it_counts():
    assert count([1.0, 2.0, -3.0]) == 2
"""


def test_a_fault_is_a_few_bytes_of_what_runs() -> None:
    faults = {(edit.operator, edit.apply(TOY.encode()).decode()) for edit in edits(TOY.encode())}
    changes = {
        ("comparison", "- 1 > limit", "- 1 <= limit"),
        ("comparison", "value == 7.0", "value != 7.0"),
        ("arithmetic", "abs(value) - 1", "abs(value) + 1"),
        ("drop a term", "abs(value) - 1", "abs(value)"),
        ("and, or", "and not", "or not"),
        ("drop a condition", "not value == 7.0", "True"),
        ("drop a sign", "not value == 7.0", "(value == 7.0)"),
        ("constant", "0.5", "0.75"),
        ("constant", "0.5", "0.0"),
        ("function", "abs(value)", "(value)"),
        ("drop a statement", "found += 1", "pass"),
    }
    assert faults >= {(name, TOY.replace(before, after)) for name, before, after in changes}
    assert len({text for _, text in faults}) == len(faults)
    for _, text in faults:
        compile(text, "toy.py", "exec")
        assert text.startswith('"""A toy."""')


def test_numbers_of_whole_things_are_also_missed_by_one() -> None:
    texts = {edit.apply(b"if n < 3:\n    pass\n") for edit in edits(b"if n < 3:\n    pass\n")}
    assert {b"if n <= 3:\n    pass\n", b"if n >= 3:\n    pass\n"} <= texts


def test_a_larger_sample_goes_on_from_a_smaller_one_and_no_file_is_left_out() -> None:
    some = sample(ROOT, [PLANNING, KERNELS], 300, seed=1)
    assert sample(ROOT, [PLANNING, KERNELS], 20, seed=1) == some[:20]
    assert sample(ROOT, [PLANNING, KERNELS], 20, seed=2) != some[:20]
    long = {"contact_search.py", "plan.py", "touch_points.py", "word_bound.py"}
    assert long <= {one.file.name for one in some}
    with pytest.raises(FileNotFoundError, match=r"no relguide/planing"):
        sample(ROOT, [Path("relguide/planing")], 1, seed=1)


def test_a_file_is_judged_by_its_own_tests_those_of_its_users_and_the_golden_answers() -> None:
    names = [test.name for test in judges_of(ROOT, KERNELS / "bounds/words/contact_bound.py")]
    assert names[0] == "test_contact_bound.py"
    assert names[-1] == "test_golden.py"
    assert "test_untouched.py" in names


@pytest.mark.slow
def test_faults_are_noticed_or_not_and_the_source_comes_back(tmp_path: Path) -> None:
    root, tests = tmp_path / "repository", [Path("tests/relguide/planning/test_toy.py")]
    toy = PLANNING / "toy.py"
    hasty = Path("tools/mutation/hasty.py")
    for file, text in ((toy, TOY), (tests[0], TEST), (hasty, (ROOT / hasty).read_text())):
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        (root / file).write_text(text)
    for package in ("relguide", PLANNING, "tests", "tools", "tools/mutation"):
        (root / package / "__init__.py").touch()
    subprocess.run(["git", "init", "-q"], cwd=root, check=True)
    workshop = Workshop(root=root, folder=tmp_path / "workshop")
    workshop.open()
    journal = Journal(tmp_path / "journal.jsonl")
    results = {}
    for named in (
        Named(name="noticed", file=str(toy), before="found += 1", after="found += 2"),
        Named(name="unnoticed", file=str(toy), before="== 7.0", after="== 8.0"),
        Named(name="broken", file=str(toy), before="abs(value)", after="absent(value)"),
    ):
        fault = named.mutant(root)
        verdict = workshop.judge(fault, tests)
        journal.note(fault, verdict)
        results[named.name] = verdict.result, verdict.by
    by = "tests/relguide/planning/test_toy.py::test_it_counts"
    assert results == {
        "noticed": ("killed", by),
        "unnoticed": ("survived", ""),
        "broken": ("killed", by),
    }
    assert (workshop.tree / toy).read_text() == (root / toy).read_text() == TOY
    outcomes = list(journal.judged().values())
    assert score(outcomes) == (2, 3)
    (text,) = survivors(outcomes)
    assert text.startswith("relguide/planning/toy.py:8\n")
    assert text.endswith("!= 8.0:") or "== 8.0" in text


def test_an_equivalent_does_not_count() -> None:
    common = {"file": "a.py", "line": 1, "changed": ("- a", "+ b"), "by": ""}
    results = ("killed", "timeout", "survived", "equivalent")
    assert score([Outcome(result=result, **common) for result in results]) == (2, 3)


@pytest.mark.parametrize("fault", NAMED, ids=lambda fault: fault.name)
def test_faults_with_a_name_still_fit_the_code(fault: Named) -> None:
    made = fault.mutant(ROOT)
    compile(made.text, fault.file, "exec")
    assert made.changed


def test_faults_that_may_survive_have_a_reason_and_still_fit_the_code() -> None:
    for one in tomllib.loads(EQUIVALENT.read_text()).get("equivalent", []):
        assert len(one["reason"]) > 20
        lines = [line.strip() for line in (ROOT / one["file"]).read_text().splitlines()]
        for changed in one["changed"]:
            assert changed.startswith("+ ") or changed[2:] in lines, changed


def test_a_fault_with_a_name_must_be_somewhere_and_only_there() -> None:
    gone = Named(name="gone", file="relguide/units.py", before="no such text", after="")
    with pytest.raises(ValueError, match=r"gone: relguide/units.py must hold once"):
        gone.mutant(ROOT)


def test_a_mutant_says_what_changed() -> None:
    source = (ROOT / "relguide/units.py").read_bytes()
    edit = edits(source)[0]
    made = mutant(ROOT, Path("relguide/units.py"), edit)
    assert made.changed[0].startswith("- ")
    assert made.changed[-1].startswith("+ ")
    assert source.splitlines()[made.line - 1].decode().strip() == made.changed[0][2:]

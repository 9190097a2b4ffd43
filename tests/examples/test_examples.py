"""The examples run, say what they should, and stay as short as they are meant to be."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "examples"
GYM = FOLDER / "gym_env.py"
"""Longer than the others, and with a package that no extra brings: `test_gym_env` runs it."""
EXAMPLES = sorted({*FOLDER.glob("*.py")} - {GYM})
SAYS = {
    "amid_traffic": ("storms.csv", "40.0 km: "),
    "own_leader": ("leader.csv", "joined: True, never closer than "),
    "own_planner": ("careful.jsonl", "(planner careful)"),
    "parameter_study": ("study.csv", "Times(775 situations, 775 with a plan, "),
    "plan_and_plot": ("plan.svg", "proof: relaxation"),
}
"""Of each: a file it writes, and something it prints."""


def test_there_are_five() -> None:
    assert [example.stem for example in EXAMPLES] == sorted(SAYS)


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.stem)
def test_it_has_twenty_statements_at_most(example: Path) -> None:
    tree = ast.parse(example.read_text("utf-8"))
    statements = [node for node in ast.walk(tree) if isinstance(node, ast.stmt)]
    docstrings = [s for s in statements if isinstance(s, ast.Expr) and _is_text(s.value)]
    assert len(statements) - len(docstrings) <= 20


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


@pytest.mark.slow
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.stem)
def test_it_runs(example: Path, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, example], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    file, said = SAYS[example.stem]
    assert (tmp_path / file).stat().st_size > 1_000
    assert said in done.stdout


@pytest.mark.slow
def test_they_pass_strict_typing() -> None:
    command = [sys.executable, "-m", "mypy", "--strict", *map(str, (*EXAMPLES, GYM))]
    done = subprocess.run(command, cwd=FOLDER.parent, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout

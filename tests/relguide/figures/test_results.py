"""Tables that figures are drawn from: the wheel carries each of them."""

import re
import tomllib
from pathlib import Path

import pytest

from relguide.figures import results
from relguide.figures.results import read_results

ROOT = Path(__file__).parents[3]


def test_a_table_is_read_by_its_headings() -> None:
    rows = read_results("intent.csv")
    assert {row["guidance"] for row in rows} >= {"intent known", "intent unknown"}


def test_a_table_that_is_not_installed_is_named() -> None:
    with pytest.raises(ValueError, match=r"The table none\.csv is missing"):
        read_results("none.csv")


def test_the_wheel_carries_all_that_figures_read() -> None:
    read = {
        name
        for file in (ROOT / "relguide" / "figures").rglob("*.py")
        for name in re.findall(r'"(\w+\.csv)"', file.read_text("utf-8"))
    }
    build = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"]
    carried = build["targets"]["wheel"]["force-include"]
    into = results.FOLDERS[0].relative_to(ROOT).as_posix()
    assert carried == {f"benchmarks/results/{name}": f"{into}/{name}" for name in sorted(read)}

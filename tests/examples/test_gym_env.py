"""The Gymnasium environment keeps the rules of one, and its regret is what the optimum leaves."""

import runpy
from typing import Any

import pytest
from gymnasium.utils.env_checker import check_env

from tests.examples.test_examples import GYM

EXAMPLE: dict[str, Any] = runpy.run_path(str(GYM))


def test_it_is_an_environment_of_120_lines_at_most() -> None:
    assert len(GYM.read_text("utf-8").splitlines()) <= 120
    check_env(EXAMPLE["JoinEnv"](), skip_render_check=True)


@pytest.mark.parametrize("seed", range(10))
def test_the_exact_plan_loses_nothing_and_a_rule_never_gains(seed: int) -> None:
    """But for the tolerance: 150 m at a closing speed of 40 m/s, and a step of 1 s."""
    exact = EXAMPLE["fly"](EXAMPLE["by_plan"], seed)
    assert exact["joined"]
    assert -150.0 / 40.0 <= exact["regret_s"] <= 1.0
    ruled = EXAMPLE["fly"](EXAMPLE["by_rule"], seed)
    assert ruled["optimum_s"] == exact["optimum_s"]
    assert ruled.get("regret_s", 0.0) >= -150.0 / 40.0

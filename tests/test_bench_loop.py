"""What the benchmark of whole flights says: nothing of a good planner, all of a bad one."""

from dataclasses import replace

import pytest

from relguide import plan
from tests.bench.loop import BREACH, Pair, failures, losses_table, pair, planners_table


def row(pairs: list[Pair]) -> list[str]:
    return [cell for column in losses_table(pairs).columns for cell in column.cells]  # type: ignore[misc]


@pytest.mark.slow
def test_a_planner_loses_nothing_to_itself_and_a_bad_one_is_told_of() -> None:
    same = pair(1, plan)
    assert same.loss == 0.0
    assert failures([same]) == []
    assert row([same]) == ["1", "1", "0.0000", "0.0000", "0.000", "0", "0"]
    assert [*planners_table([same]).columns[0].cells] == ["exact", "network"]
    end = same.network.end
    late = replace(same.network, end=replace(end, join_time=2.0 * end.join_time))
    assert replace(same, network=late).loss == pytest.approx(1.0)
    close = replace(same, network=replace(same.network, kept=BREACH - 0.1))
    assert "comes within 0.890 d_min by network" in failures([close])[0]
    lost = replace(same, network=replace(same.network, end=replace(end, joined=False)))
    assert lost.loss is None
    assert failures([lost]) == ["Flight 1 joins by the exact planner only."]
    assert row([lost]) == []

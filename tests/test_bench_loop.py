"""What the benchmark of whole flights says: nothing of a good planner, all of a bad one."""

from dataclasses import replace

import pytest
from rich.table import Table

from benchmarks.loop import (
    BREACH,
    decisions_table,
    failures,
    flights_table,
    fly_measured,
    losses_table,
    main,
)
from relguide import plan


def rows(table: Table) -> list[tuple[str, ...]]:
    return list(zip(*(map(str, column.cells) for column in table.columns), strict=True))


@pytest.mark.slow
def test_a_planner_loses_nothing_to_itself_and_a_bad_one_is_reported() -> None:
    one = fly_measured(1, plan)
    assert one.intent_known
    assert one.way
    assert len(one.spent) > 300
    same = {"exact": [one], "network": [one]}
    assert failures(same) == []
    assert rows(losses_table(same)) == [("1", "1", "0.0000", "0.0000", "0.000", "0", "0")]
    assert [row[0] for row in rows(flights_table(same))] == ["exact", "network"]
    assert [row[2] for row in rows(decisions_table(same))] == ["0.00", "0.00"]

    def by_network(**changes: object) -> dict[str, list[object]]:
        return {"exact": [one], "network": [replace(one, **changes)]}  # type: ignore[arg-type]

    late = by_network(result=replace(one.result, join_time=2.0 * one.result.join_time))
    assert rows(losses_table(late))[0][2] == "100.0000"
    close = failures(by_network(kept=BREACH - 0.1))
    assert (
        close[0] == "Flight 1 comes within 0.890 d_min by network, knowing what the leader will do."
    )
    assert close[1].endswith(f"by network, {one.kept:.3f} by the exact planner.")
    lost = by_network(result=replace(one.result, joined=False))
    assert failures(lost) == ["Flight 1 joins by the exact planner only."]
    assert rows(losses_table(lost)) == []


def test_what_nobody_could_keep_is_no_failure() -> None:
    one = fly_measured(1, plan, longest=3.0)
    head_on = replace(one, kept=0.7, result=replace(one.result, planned_time=0.0))
    assert failures({"exact": [head_on]}) == []
    assert rows(flights_table({"exact": [head_on]}))[0][-2:] == ("1", "1")
    unknown = replace(one, kept=0.7, intent_known=False)
    assert failures({"exact": [unknown]}) == []
    assert rows(flights_table({"exact": [unknown]}))[0][4] == "1 of 1"


@pytest.mark.slow
def test_one_planner_may_fly_alone(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--flights", "2", "--first", "8", "--only", "exact"]) == 0
    said = capsys.readouterr().out
    assert "2 flights at 1 Hz" in said
    assert "Join time by network" not in said

"""Rows of a campaign as the tables of docs/flight.md."""

from dataclasses import replace

from relguide.campaign.judge import failed_row
from relguide.campaign.row import FIGURES
from tools.campaign.tables import by_hand, distributions, ranking


def test_a_flight_that_fails_is_listed_and_not_counted() -> None:
    row = failed_row("declared", 0, ZeroDivisionError("by zero"))
    assert row.error == "ZeroDivisionError: by zero"
    assert distributions([row]) == []


def test_the_worst_comes_first_whichever_way_is_worse() -> None:
    row = replace(failed_row("declared", 0, ValueError()), error="")
    rows = [replace(row, number=i, least_share=share) for i, share in enumerate((1.2, 0.9, 1.1))]
    (least,) = (figure for figure in FIGURES if figure.name == "least_share")
    assert [one.number for _, one in ranking(least, rows)] == [1, 2, 0]
    (circle,) = (figure for figure in FIGURES if figure.name == "loops")
    assert [one.number for _, one in ranking(circle, rows)] == [0, 1, 2]


def test_flights_by_hand_are_shown_by_leader_and_all_together() -> None:
    row = replace(
        failed_row("flight_director", 0, ValueError()), error="", planned=True, joined=True,
        join_s=505.0, autopilot_join_s=500.0, within_bar_share=0.9, off_autopilot_m=20.0,
    )  # fmt: skip
    lost = replace(row, number=1, joined=False, join_s=None, autopilot_join_s=None)
    cells = by_hand([row, lost, replace(row, number=2, join_s=515.0)])
    assert [line[:2] for line in cells] == [["declared", "2"], ["undeclared", "1"], ["all", "3"]]
    declared, undeclared, _ = cells
    assert declared[3] == "100.0"
    assert declared[4].startswith("2.00 (0.04")
    assert declared[5:] == ["90.0", "20, 20", "0", "0"]
    assert undeclared[3:5] == ["0.0", ""]

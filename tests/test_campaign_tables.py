"""Rows of a campaign as the tables of docs/flight.md."""

from dataclasses import replace

from relguide.campaign.judge import failed_row
from relguide.campaign.row import FIGURES
from tools.campaign.tables import distributions, ranking


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

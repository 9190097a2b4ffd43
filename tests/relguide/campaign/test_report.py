"""What a report says, beside what is known: intervals that hold, and pairs that cancel."""

from dataclasses import replace

import numpy as np
import pytest

from relguide.campaign.campaign_file import read_campaign
from relguide.campaign.judge import failed_row
from relguide.campaign.report import FlownRow, mean_of, quantile, report
from relguide.learn.training.shares import Share

ASKED = read_campaign(
    {"campaign": {"flights": 4, "family": "declared"}, "sweep": {"wind_error_mps": [0.0, 5.0]}}
)


def test_none_of_a_hundred_thousand_is_less_than_four_in_as_many() -> None:
    low, high = Share(hits=0, of=100_000).interval
    assert low == 0.0
    assert high == pytest.approx(3.8e-5, abs=0.1e-5)


def test_intervals_hold_the_truth_as_often_as_they_say() -> None:
    rng = np.random.default_rng(1)
    truth = {0.5: 1.0 * np.log(2.0), 0.95: np.log(20.0)}
    for share, right in truth.items():
        hits = 0
        for _ in range(300):
            found = quantile(rng.exponential(size=400), share)
            hits += found.low <= right <= found.high
        assert 0.91 <= hits / 300 <= 0.985
    hits = 0
    for _ in range(300):
        found = mean_of(rng.normal(3.0, 2.0, 100))
        hits += found.low <= 3.0 <= found.high
    assert 0.91 <= hits / 300 <= 0.985


def test_quantiles_are_of_the_worse_side() -> None:
    values = np.arange(1.0, 101.0)
    assert quantile(values, 0.95).value == 95.0
    assert quantile(values, 0.95, low_is_worse=True).value == 6.0
    alone = quantile(np.array([7.0]), 0.99)
    assert (alone.value, alone.low, alone.high) == (7.0, 7.0, 7.0)


def test_pairs_are_compared_with_the_first_point_and_the_worst_are_named() -> None:
    good = replace(failed_row("declared", 0, ValueError()), error="", joined=True)
    flown = []
    for flight in range(8):
        number, at = divmod(flight, 2)
        row = replace(
            good, number=number, least_share=1.0 + 0.1 * number - 0.05 * at, join_s=100.0,
            joined=not (at and number == 2), why_not_joined="unable: speed" if flight == 5 else "",
        )  # fmt: skip
        flown.append(FlownRow(flight=flight, point=ASKED.points[at], row=row))
    found = report(ASKED, flown)
    first, second = found.points
    assert first.shares["joined"] == Share(hits=4, of=4)
    assert second.shares["joined"] == Share(hits=3, of=4)
    assert dict(second.why_not_joined) == {"unable: speed": 1}
    (least,) = (one for one in found.differences if one.figure == "least_share")
    assert (least.pairs, least.point) == (4, ASKED.points[1])
    # 0.05 in each pair: certain, though the flights themselves differ by 0.3
    assert least.mean.value == pytest.approx(-0.05)
    assert least.mean.high - least.mean.low < 1e-9
    assert [one.flight for _, one in found.worst["least_share"]] == [1, 0, 3, 2, 5, 4, 7, 6]
    assert "shown_replans" not in found.worst

"""A flight by hand beside the same flight by the autopilot."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from relguide.campaign.paths import distance_from
from relguide.campaign.row import Row
from relguide.flying.documents import Document, FlightEnded, Sample
from relguide.units import Metre


def with_autopilot(row: Row, by_hand: Sequence[Document], flown: Sequence[Document]) -> Row:
    """The row of a flight by hand, with what sets it apart from the autopilot's.

    Args:
        row: the flight's other figures.
        by_hand: its documents.
        flown: those of the same flight by the autopilot.
    """
    last, autopilots = by_hand[-1], flown[-1]
    assert isinstance(last, FlightEnded)
    assert isinstance(autopilots, FlightEnded)
    (end,), (theirs,) = last.results, autopilots.results
    (hands,) = end.by_hand
    limit = min(end.join_time, autopilots.t)
    return replace(
        row,
        autopilot_join_s=theirs.join_time if theirs.joined else None,
        autopilot_least_share=row.least_share * theirs.least_separation / end.least_separation,
        within_bar_share=hands.within_bar / hands.with_bars if hands.with_bars else None,
        tube_m=hands.tube,
        off_autopilot_m=_off_path(_places(by_hand, limit), _places(flown, autopilots.t)),
    )


def _places(documents: Sequence[Document], until: float) -> list[tuple[Metre, Metre]]:
    """Where the pursuer was at each sample."""
    samples = (one for one in documents if isinstance(one, Sample) and one.t <= until)
    return [(one.aircraft[0].x, one.aircraft[0].y) for one in samples]


def _off_path(places: list[tuple[Metre, Metre]], path: list[tuple[Metre, Metre]]) -> Metre:
    """Largest distance of some places from a path."""
    flown = np.array(path)
    return max(distance_from(flown, x, y) for x, y in places)

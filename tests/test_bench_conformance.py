"""The campaign of deviations: each kind is put into a flight that was flown, and found."""

import pytest

from benchmarks.conformance import FOUND_WITHIN, HEADINGS, Outcome, measure, table
from benchmarks.deviations import INJECTIONS


@pytest.mark.slow
def test_every_kind_is_found_in_time_and_nothing_else_is_said() -> None:
    outcomes = measure(0, tuple(INJECTIONS)) + measure(12, tuple(INJECTIONS))
    assert {one.kind for one in outcomes} >= set(INJECTIONS)
    assert [one for one in outcomes if one.failed] == []
    cells = table(outcomes)
    assert {len(line) for line in cells} == {len(HEADINGS)}
    assert [line[3] for line in cells[:2]] == ["0", "0"]


def test_what_is_late_or_false_has_failed() -> None:
    calm = Outcome(kind="calm", number=0, seconds=9, cautions=0, alerts=0, found=None)
    late = Outcome(
        kind="turns late", number=0, seconds=9, cautions=0, alerts=0, found=FOUND_WITHIN + 1.0
    )
    never = Outcome(kind="turns late", number=0, seconds=9, cautions=0, alerts=0, found=None)
    false = Outcome(kind="calm", number=0, seconds=9, cautions=1, alerts=0, found=None)
    assert [one.failed for one in (calm, late, never, false)] == [False, True, True, True]

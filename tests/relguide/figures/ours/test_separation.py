"""The example is one where the limit binds, and its plan keeps it."""

from relguide import Plan, candidates, plan
from relguide.figures.ours.separation import EXAMPLE
from relguide.planning.certificate import certify


def test_the_limit_binds_in_the_example() -> None:
    planned = plan(EXAMPLE)
    assert isinstance(planned, Plan)
    free = next(candidates(EXAMPLE).later).trajectory
    assert not certify(free, EXAMPLE).holds
    assert planned.certificate.holds
    assert planned.certificate.least_separation < 1.001 * EXAMPLE.min_separation

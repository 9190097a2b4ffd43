"""The short way to a plan's JSON: the same text as by cards and the wire's encoding."""

from dataclasses import replace

import numpy as np
import orjson
import pytest
from hypothesis import given

from benchmarks.deadline import draw
from relguide import Plan, Situation, plan
from relguide.contract.plain_answer import plain_plan
from relguide.contract.wire import to_wire
from relguide.flying.cards import plan_card
from relguide.planning.trajectory import BoundaryArc
from tests.situations import golden, situations


def by_cards(planned: Plan) -> bytes:
    written = to_wire(plan_card(planned))
    del written["alternatives"]
    return orjson.dumps(written)


def expect_the_same(situation: Situation, deadline: float | None = None) -> bool:
    """Whether there was something to compare."""
    planned = plan(situation, deadline=deadline)
    if not isinstance(planned, Plan):
        return False
    plain = plain_plan(planned)
    slides = any(isinstance(s, BoundaryArc) for s in planned.trajectory.segments)
    assert (plain is None) == slides
    if plain is not None:
        assert orjson.dumps(plain) == by_cards(planned)
    return plain is not None


@given(situations())
def test_any_plan(situation: Situation) -> None:
    expect_the_same(situation, 0.05)


def test_plans_of_extreme_situations() -> None:
    drawn = (draw(np.random.default_rng([77, k])) for k in range(150))
    assert sum(expect_the_same(situation, 0.02) for situation in drawn) > 50


def test_golden_plans() -> None:
    assert any(expect_the_same(situation, 0.2) for situation, _ in golden("coincidence")[:100])


def test_what_is_not_finite_is_left_to_those_who_refuse_it() -> None:
    situation, _ = golden("coincidence")[0]
    planned = plan(situation)
    assert isinstance(planned, Plan)
    certificate = replace(planned.certificate, at_time=float("nan"))
    wrong = replace(planned, certificate=certificate)
    assert plain_plan(wrong) is None
    with pytest.raises(ValueError, match="finite"):
        by_cards(wrong)

"""The audit where the limit binds: counts what it says, in situations the network has not seen."""

from dataclasses import replace
from functools import cache
from math import inf

import numpy as np
import pytest

from relguide.kernels.networks.templates import FREE, NONE, SEVERAL, TEMPLATES
from relguide.learn.audits.constrained_judging import ConstrainedVerdicts, template_latencies
from relguide.learn.audits.planner_judging import TAS, UNIT, PlannerVerdicts, situation_of
from relguide.learn.audits.template_audit import (
    TemplateAudit,
    template_audit_as_json,
    template_audit_of,
)
from relguide.learn.audits.template_judging import (
    TemplateVerdicts,
    join_template_verdicts,
    judge_template_chunk,
    judge_template_chunks,
    template_audit_request,
)
from relguide.learn.boundary.template_labels import (
    SOURCES,
    TemplateLabelRequest,
    template_label_chunk,
)
from relguide.learn.boundary.train_templates import WITHIN, targets_of
from relguide.learn.training.shares import Share
from relguide.learn.words.branch_network import load_network
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from tests.relguide.learn.boundary.template_networks import ways
from tests.relguide.learn.boundary.test_template_labels import Here

TOUCH, BOUNDARY_ARC = TEMPLATES.index("LSL left LSL"), TEMPLATES.index("LS left B")


def request(count: int = 60, seed: int = 9) -> TemplateLabelRequest:
    return replace(template_audit_request(ways(), count, seed), chunk=30)


@cache
def chunks() -> dict[int, TemplateVerdicts]:
    return dict(judge_template_chunks(ways(), load_network(), request(), Here()))


def audit() -> TemplateAudit:
    return template_audit_of(chunks())


def make_verdicts(*rows: tuple[int, int, float, float, bool, bool]) -> TemplateVerdicts:
    """As judged: template, that answered, exact and given time, whether named, whether held."""
    columns = (np.array(column) for column in zip(*rows, strict=True))
    templates, answered, exact, given, named, inside = columns
    n = len(rows)
    return TemplateVerdicts(
        bound=ConstrainedVerdicts(
            situations=np.arange(6.0 * n).reshape(n, 6),
            sources=np.zeros(n, dtype=np.int8),
            templates=templates.astype(np.int8),
            named=named,
            doubt=np.where(named, 0.02, 0.4),
            own=np.where(inside, 0.3, 1e-5),
            inside=inside,
            held=np.full(n, 2, dtype=np.int8),
            exact=exact.astype(float),
            answered=answered.astype(np.int8),
            given=given.astype(float),
        ),
        everywhere=PlannerVerdicts(
            binds=np.arange(n) == 0, named=named, exact=exact.astype(float),
            given=given.astype(float),
        ),
    )  # fmt: skip


def test_delays_and_their_reasons_are_counted() -> None:
    late = 0.1 / UNIT
    found = template_audit_of(
        {
            0: make_verdicts(
                (TOUCH, TOUCH, 10.0, 10.0, True, True),
                (TOUCH, BOUNDARY_ARC, 10.0, 11.0, False, False),  # left out of the set
                (BOUNDARY_ARC, TOUCH, 10.0, 10.5, False, True),  # held, not solved
                (
                    SEVERAL,
                    TOUCH,
                    10.0,
                    10.2,
                    True,
                    True,
                ),  # of no template, though its share is large
                (TOUCH, TOUCH, 100.0, 100.0 + 0.9 * late, True, True),
                (TOUCH, TOUCH, 100.0, 100.0 + 1.1 * late, True, True),
                (TOUCH, SEVERAL, 10.0, inf, False, True),  # passed on
                (NONE, FREE, inf, 20.0, False, True),  # an answer where there is none
                (NONE, SEVERAL, inf, inf, True, True),
                (TOUCH, BOUNDARY_ARC, 10.0, 9.0, False, True),  # sooner than the search
            )
        }
    )
    every = found.groups[-1]
    assert (every.name, every.size) == ("all", 10)
    assert every.named == Share(hits=5, of=10)
    assert every.covered == Share(hits=6, of=7)
    assert every.late.answered == Share(hits=7, of=8)
    assert every.late.late == Share(hits=4, of=7)
    assert (every.late.invented, every.late.sooner) == (Share(hits=1, of=2), 1)
    assert every.late.gaps[-1] == pytest.approx(0.1)
    assert found.worth == Share(hits=3, of=7)
    assert found.reasons == {"left out": 1, "not solved": 1, "of no template": 1}
    assert [miss.reason for miss in found.misses] == ["left out", "not solved", "of no template"]
    first = found.misses[0]
    assert (first.fastest, first.answered) == ("LSL left LSL", "LS left B")
    assert (first.gap, first.late) == (pytest.approx(0.1), pytest.approx(1.0))
    assert first.situation == tuple(np.arange(6.0, 12.0))
    assert [group.name for group in found.templates][:2] == ["LSL left LSL", "none"]
    assert [group.size for group in found.everywhere] == [9, 1, 10]
    assert found.everywhere[2].late == every.late
    assert [(doubt.said, doubt.wrong.of) for doubt in found.doubts] == [
        (pytest.approx(0.02), 5), (pytest.approx(0.4), 5),
    ]  # fmt: skip


def test_what_it_counts_adds_up() -> None:
    found = audit()
    groups = {group.name: group for group in found.groups}
    assert list(groups) == [*SOURCES, "all"]
    assert sum(groups[source].size for source in SOURCES) == groups["all"].size == 60
    assert sum(group.size for group in found.templates) == 60
    assert sum(group.named.hits for group in found.templates) == groups["all"].named.hits
    assert sum(doubt.wrong.of for doubt in found.doubts) == 60
    assert groups["all"].named.hits > 25  # the small network is right in more than half
    assert groups["all"].late.invented.hits == 0
    assert sum(found.reasons.values()) == found.worth.hits
    free, binds, every = found.everywhere
    assert every.size == free.size + binds.size == 60
    assert free.size > binds.size
    assert free.named.hits >= 0.97 * free.size
    assert every.late.gaps[0] == 0.0
    told = template_audit_as_json(found)
    assert told["groups"]["all"]["named"]["hits"] == groups["all"].named.hits
    assert set(told["everywhere"]["it binds"]["gap_percent"]) == {"p50", "p99", "p99.9", "max"}


def test_the_exact_answers_are_the_searchs() -> None:
    labels, found = template_label_chunk(request(), 0), chunks()[0].bound
    assert np.array_equal(found.situations, labels.situations)
    assert np.array_equal(found.exact, labels.times[:, 2])
    assert np.array_equal(found.templates, targets_of(labels.paths)[0])
    there = np.isfinite(found.exact)
    assert np.mean(found.given[there] > found.exact[there] - WITHIN) > 0.95  # nor it beaten
    # what is named and held is answered without loss, unless it is passed on
    sure = found.named & there & (found.templates != SEVERAL) & (found.given < inf)
    assert (found.given[sure] <= found.exact[sure] + 2.0 * WITHIN).all()


def test_everywhere_is_flown_by_an_airliner_of_that_scale() -> None:
    row = chunks()[0].bound.situations[0]
    situation = situation_of(row)
    assert situation.pursuer.turn_radius / TAS == pytest.approx(UNIT)
    exact = chunks()[0].bound.exact
    for number in np.flatnonzero(np.isfinite(exact))[:3]:
        answer = plan(situation_of(chunks()[0].bound.situations[number]))
        assert isinstance(answer, Plan)
        assert answer.time_to_converge / UNIT == pytest.approx(exact[number], abs=1e-3)


def test_it_is_the_same_each_time_and_sees_other_situations_than_the_training() -> None:
    again = {
        number: judge_template_chunk(ways(), load_network(), request(), number) for number in (1, 0)
    }
    assert template_audit_of(again) == audit()
    assert len(join_template_verdicts(again).everywhere) == 60
    seen = replace(ways(), about={"dataset": {"seed": 5}})
    with pytest.raises(ValueError, match="has seen the situations of seed 5"):
        template_audit_request(seen, 10, 5)


def test_a_network_that_knows_nothing_is_found_out() -> None:
    layers = ways().layers
    blind = replace(ways(), layers=layers._replace(last=0.0 * layers.last))
    found = judge_template_chunk(blind, load_network(), request(), 0).bound
    assert found.named.mean() < chunks()[0].bound.named.mean()
    silent = judge_template_chunk(replace(ways(), most=0), load_network(), request(), 0)
    assert (silent.bound.given == inf).all()
    assert (silent.everywhere.given[silent.everywhere.binds] == inf).all()
    assert template_audit_of({0: silent}).worth == Share(hits=0, of=0)


def test_one_query_is_timed() -> None:
    found = template_latencies(ways(), chunks()[0].bound.situations)
    assert set(found) == {"network", "search"}
    for asked in found.values():
        assert 0.0 < asked.median <= asked.late
        assert asked.mean > 0.0

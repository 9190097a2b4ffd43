"""The audit: counts what it says, on situations the network has not seen."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from math import inf

import numpy as np
import pytest

from relguide.kernels.words.branches import BRANCHES
from relguide.learn.audits.branch_audit import Audit, audit_as_json, audit_of
from relguide.learn.audits.branch_judging import (
    WORTH,
    BranchVerdicts,
    branch_audit_request,
    judge_chunk,
    judge_chunks,
    latencies,
)
from relguide.learn.audits.gaps import SMALL
from relguide.learn.training.shares import Share
from relguide.learn.words.branch_labels import label_chunk, times_of
from relguide.learn.words.branch_network import load_network
from tests.relguide.learn.words.networks import REQUEST, network


def audit(count: int, seed: int = 1, *, least_share: float | None = None) -> Audit:
    asked = network() if least_share is None else replace(network(), least_share=least_share)
    request = replace(branch_audit_request(asked, count, seed), chunk=1000)
    with ThreadPoolExecutor(1) as executor:
        return audit_of(dict(judge_chunks(asked, request, executor)))


def test_shares_come_with_wilsons_interval() -> None:
    low, high = Share(hits=95, of=100).interval
    assert (low, high) == (pytest.approx(0.8883, abs=1e-3), pytest.approx(0.9785, abs=1e-3))
    assert Share(hits=10, of=10).interval[1] == pytest.approx(1.0)
    assert Share(hits=10, of=10).interval[0] < 0.75
    assert Share(hits=0, of=0).interval == (0.0, 1.0)


def test_what_it_counts_adds_up() -> None:
    found = audit(3000)
    groups = {group.name: group for group in found.groups}
    held_out = [group for name, group in groups.items() if name.startswith("unseen ")]
    assert len(held_out) == 3
    # a situation in two regions counts in both
    assert 3000 <= sum(group.size for group in found.groups) < 3050
    assert sum(group.size for group in found.classes) == groups["random"].size
    assert [group.name for group in found.classes] == list(BRANCHES)
    for group in (*found.groups, *found.classes):
        hits = [share.hits for share in group.tops]
        assert hits == sorted(hits)
        assert group.gaps == tuple(sorted(group.gaps))
        assert group.covered.of + group.fallbacks.hits == group.size
    assert groups["random"].tops[0].hits > 0.9 * groups["random"].size
    assert groups["random"].covered.hits > 0.98 * groups["random"].covered.of
    assert groups["at switching surfaces"].mean_set > groups["random"].mean_set
    assert sum(doubt.wrong.of for doubt in found.doubts) == 2400
    assert [doubt.said for doubt in found.doubts] == sorted(doubt.said for doubt in found.doubts)
    assert all(size.lost.of == 2400 for size in found.sets)
    told = audit_as_json(found)
    assert told["groups"]["random"]["top_1"]["hits"] == groups["random"].tops[0].hits
    assert set(told["branches"]["LSL"]["gap_percent"]) == {"p50", "p99", "p99.9", "max"}


def test_it_is_the_same_each_time_and_sees_other_situations_than_the_training() -> None:
    assert audit(1000) == audit(1000)
    with pytest.raises(ValueError, match="has seen the situations of seed 5"):
        audit(10, seed=REQUEST.seed)


def test_a_network_that_knows_nothing_is_found_out() -> None:
    layers = network().layers
    blind = replace(network(), layers=layers._replace(last=0.0 * layers.last), most=8)
    request = branch_audit_request(blind, 500, 1)
    found = judge_chunk(blind, request, 0)
    assert isinstance(found, BranchVerdicts)
    assert np.mean(found.ranks == 0) < 0.7
    none = judge_chunk(replace(blind, most=0), request, 0)
    assert (none.held == 0).all()
    assert (none.gap == inf).all()
    assert audit_of({0: none}).groups[0].fallbacks.hits == audit_of({0: none}).groups[0].size


def test_the_gap_is_that_of_what_would_be_flown() -> None:
    request = branch_audit_request(network(), 500, 1)
    found, labels = judge_chunk(network(), request, 0), label_chunk(request, 0)
    assert np.array_equal(found.best, labels.best)
    finite = found.gap[found.gap < inf]
    assert finite.min() == 0.0
    # a gap is between two of the branches that exist
    for row in np.flatnonzero((found.gap > 0.0) & (found.gap < inf)):
        others = labels.times[row] / labels.times[row].min() - 1.0
        assert np.abs(others - found.gap[row]).min() < 1e-9


def test_a_larger_set_loses_less() -> None:
    sizes = audit(3000).sets
    assert [size.mean_set for size in sizes] == sorted((s.mean_set for s in sizes), reverse=True)
    assert [size.lost.hits for size in sizes] == sorted(size.lost.hits for size in sizes)
    assert sizes[0].lost.hits < sizes[-1].lost.hits
    assert all(size.worth.hits <= size.lost.hits for size in sizes)


def test_every_gap_comes_with_what_explains_it() -> None:
    found = audit(3000, least_share=0.1)
    gaps = [miss.gap for miss in found.misses]
    assert gaps == sorted(gaps, reverse=True)
    assert 3 < len(gaps) == found.worth.hits
    assert gaps[0] == max(group.gaps[-1] for group in found.groups)
    assert gaps[-1] > WORTH
    for miss in found.misses:
        times = times_of(np.array([miss.situation]))[0]
        assert BRANCHES[times.argmin()] == miss.fastest
        assert times[BRANCHES.index(miss.answered)] == pytest.approx(times.min() * (1.0 + miss.gap))
        assert miss.explained == (min(miss.birth, miss.switch) <= SMALL)
    assert found.unexplained == sum(not miss.explained for miss in found.misses)
    told = audit_as_json(found)
    assert told["largest_gaps"][0]["gap_percent"] == 100.0 * gaps[0]
    assert told["unexplained"] == found.unexplained


def test_the_weights_that_come_along_are_good() -> None:
    shipped = load_network()
    request = replace(branch_audit_request(shipped, 4000, 11), chunk=4000)
    groups = audit_of({0: judge_chunk(shipped, request, 0)}).groups
    assert groups[0].tops[0].hits > 0.99 * groups[0].size
    assert groups[0].covered.hits > 0.995 * groups[0].size


def test_one_query_is_timed() -> None:
    found = latencies(network(), branch_audit_request(network(), 300, 1))
    assert set(found) == {"network", "all words"}
    for asked in found.values():
        assert 0.0 < asked.median <= asked.late
        assert asked.mean > 0.0

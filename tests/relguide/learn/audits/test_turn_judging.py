"""The audit of the network of turning leaders: fresh situations, and what is not counted."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from relguide.kernels.networks.turn_templates import DELAYED
from relguide.learn.audits.turn_judging import (
    judge_turn_chunks,
    turn_audit_of,
    turn_audit_request,
    turn_latencies,
)
from relguide.learn.boundary.turn_network import TURNING
from tests.relguide.learn.boundary.turn_networks import turns


def test_an_audit_judges_what_a_search_would_answer() -> None:
    request = turn_audit_request(turns(), 250, 11)
    with ThreadPoolExecutor(1) as pool:
        chunks = dict(judge_turn_chunks(turns(), request, pool))
    audit, judged = turn_audit_of(chunks, TURNING.templates)
    assert DELAYED in chunks[0].templates
    assert len(judged) == np.sum(chunks[0].templates != DELAYED)
    everything = audit.groups[-1]
    assert everything.size == len(judged)
    assert everything.late.answered.value > 0.6
    assert everything.late.late.value < 0.05
    assert everything.late.invented.hits == 0
    asked = turn_latencies(turns(), judged)
    alone, whole, search = asked.values()
    assert alone.mean <= whole.mean < search.mean


def test_the_situations_of_the_training_are_no_test() -> None:
    with pytest.raises(ValueError, match="has seen"):
        turn_audit_request(turns(), 10, turns().about["dataset"]["seed"])

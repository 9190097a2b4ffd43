"""A leader that is reported second by second: it flies there, and its pursuer follows it."""

from collections.abc import Iterable
from math import cos, hypot, pi, sin

import numpy as np
import pytest

from relguide.flying.documents import CommandGiven, Document, FlightStarted, LeaderChanged, Sample
from relguide.flying.flight import fly
from relguide.flying.orders import Command, LeaderHeading, LeaderReport
from relguide.flying.scenarios import scenario
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.plan import plan
from relguide.units import DEG

SPEED, LEVEL, RATE = 200.0, 9_449.0, 1.2 * DEG
TURN = (60.0, 120.0)
"""It turns right between these [s]."""


def truth(t: float) -> tuple[float, float, float]:
    """Where it really is: straight on to the east, a turn of 72°, straight on."""
    turning = min(max(t - TURN[0], 0.0), TURN[1] - TURN[0])
    heading = 0.5 * pi + RATE * turning
    radius = SPEED / RATE
    x, y = SPEED * min(t, TURN[0]), 0.0
    x += radius * (cos(0.5 * pi) - cos(heading))
    y += radius * (sin(heading) - sin(0.5 * pi))
    left = max(t - TURN[1], 0.0)
    return x + SPEED * left * sin(heading), y + SPEED * left * cos(heading), heading


def report(t: float) -> LeaderReport:
    x, y, track = truth(t)
    return LeaderReport(x=x, y=y, track=track, ground_speed=SPEED, altitude=LEVEL)


def reports(t: float) -> Iterable[Command]:
    return [report(t + 1.0)] if t.is_integer() else []


def flown(commands: object = reports, until: float = 900.0) -> list[Document]:
    documents = []
    for document in fly(scenario("fig_6b"), plan, commands=commands):  # type: ignore[arg-type]
        if document.t > until:
            break
        documents.append(document)
    return documents


@pytest.fixture(scope="module")
def documents() -> list[Document]:
    return flown()


def samples(documents: list[Document]) -> list[Sample]:
    return [d for d in documents if isinstance(d, Sample)]


def test_it_is_where_it_is_reported_between_reports_too(documents: list[Document]) -> None:
    for sample in samples(documents):
        leader, (x, y, heading) = sample.aircraft[1], truth(sample.t)
        assert hypot(leader.x - x, leader.y - y) < 0.5
        assert abs(wrap_signed(leader.heading - heading)) < 0.2 * DEG
        assert leader.tas == pytest.approx(SPEED, abs=0.5)
        assert leader.altitude == pytest.approx(LEVEL)


def test_its_turn_is_seen_as_a_turn_and_nothing_else_is_said(documents: list[Document]) -> None:
    said = [d for d in documents if isinstance(d, LeaderChanged)]
    assert [d.change for d in said[:1]] == ["intent_withdrawn"]
    assert all(TURN[0] - 1.0 < d.t < TURN[1] + 10.0 for d in said[1:])
    assert len(said) < 10
    banks = [one.aircraft[1].bank for one in samples(documents) if 65.0 < one.t < 115.0]
    assert np.allclose(banks, np.arctan(SPEED * RATE / 9.80665), atol=0.5 * DEG)


def test_its_pursuer_keeps_the_minimum_and_joins(documents: list[Document]) -> None:
    (started,) = (d for d in documents if isinstance(d, FlightStarted))
    last = samples(documents)[-1].guidance[0]
    assert last.least_separation >= started.links[0].min_separation - 1.0
    assert last.joined or last.mode in ("capture", "converge")


def test_without_a_report_it_flies_on_as_it_flew() -> None:
    def before_the_turn(t: float) -> Iterable[Command]:
        return reports(t) if t < 40.0 else []

    for sample in samples(flown(before_the_turn, 150.0)):
        leader = sample.aircraft[1]
        assert hypot(leader.x - SPEED * sample.t, leader.y) < 0.5
        assert leader.heading == pytest.approx(0.5 * pi, abs=0.01 * DEG)


def test_who_is_ordered_is_reported_no_more() -> None:
    def ordered(t: float) -> Iterable[Command]:
        if t == 40.0:
            return [LeaderHeading(heading=180.0 * DEG)]
        return reports(t) if t < 40.0 else []

    last = samples(flown(ordered, 150.0))[-1].aircraft[1]
    assert last.heading == pytest.approx(180.0 * DEG, abs=0.5 * DEG)


def test_it_is_flown_again_to_the_bit_by_its_documents(documents: list[Document]) -> None:
    given: dict[float, list[Command]] = {}
    for document in documents:
        if isinstance(document, CommandGiven):
            given.setdefault(document.t, []).append(document.command)
    again = flown(lambda t: given.pop(t, []))
    assert samples(again) == samples(documents)

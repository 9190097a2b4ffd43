"""An aircraft that brakes less than its data say: guidance learns it, and d_min is kept."""

from collections.abc import Iterable
from dataclasses import replace

import pytest

from relguide.flying import simulation
from relguide.flying.airframe import Airframe
from relguide.flying.documents import Document, FlightEnded, Sample
from relguide.flying.flight import world_of
from relguide.flying.simulation import simulate
from relguide.flying.world import World
from tests.relguide.flying.guidance.beliefs import behind

FAST = behind(along=45_000.0, tas=235.0, leader_tas=150.0)
"""Closes at 85 m/s: it has to brake for a minute and a half."""


def world(**true: float) -> World:
    """Of a pursuer whose airframe is not what guidance believes."""
    built = world_of(FAST)
    pursuer, leader = built.aircraft
    airframe: Airframe = replace(pursuer.airframe, **true)
    return replace(
        built, aircraft=(replace(pursuer, airframe=airframe, believed=pursuer.airframe), leader)
    )


def flown(which: World) -> list[Document]:
    return list(simulate(which, sample_period=1.0))


def without_learning(which: World) -> list[Document]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(simulation, "learn_braking", lambda *_: None)
        return flown(which)


def samples(documents: Iterable[Document]) -> list[Sample]:
    return [document for document in documents if isinstance(document, Sample)]


@pytest.mark.parametrize("share", [0.4, 0.5])
def test_weak_brakes_are_found_out_before_d_min_is_lost(share: float) -> None:
    """Without speed brakes and with so little of its drag: 0.2 m/s², 0.27 m/s²."""
    kind = world_of(FAST).aircraft[0].airframe
    weak = world(
        zero_lift_drag=share * kind.zero_lift_drag,
        induced_drag=share * kind.induced_drag,
        speed_brake_drag=0.0,
    )
    *_, end = flown(weak)
    assert isinstance(end, FlightEnded)
    (result,) = end.results
    assert result.joined
    assert result.losses == ()
    *_, unlearned = without_learning(weak)
    assert isinstance(unlearned, FlightEnded)
    assert unlearned.results[0].least_separation < result.least_separation
    assert share > 0.4 or unlearned.results[0].losses


@pytest.mark.parametrize(
    "true",
    [
        {},
        {"speed_time_constant": 6.5},
        {"speed_time_constant": 3.5},
        {"speed_brake_drag": 0.03, "zero_lift_drag": 0.024},
    ],
    ids=["as believed", "slower autothrust", "quicker autothrust", "stronger brakes"],
)
def test_nothing_is_learnt_where_it_brakes_as_believed(true: dict[str, float]) -> None:
    which = world(**true)
    assert samples(flown(which)) == samples(without_learning(which))

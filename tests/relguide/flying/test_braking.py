"""An aircraft that brakes less than its data say: guidance learns it, and d_min is kept."""

from collections.abc import Iterable
from dataclasses import replace
from math import pi, sin
from types import SimpleNamespace

import pytest

from relguide.flying import simulation
from relguide.flying.airframe import Airframe
from relguide.flying.braking import learn_braking
from relguide.flying.documents import Document, FlightEnded, Sample
from relguide.flying.fleet import Fleet
from relguide.flying.flight import world_of
from relguide.flying.pursuit import begin_pursuit
from relguide.flying.simulation import simulate
from relguide.flying.world import World
from relguide.kernels.flight.energy import full_deceleration
from relguide.kernels.flight.flight_records import Control
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


def wobbling(amplitude: float, period: float = 17.0) -> list[Document]:
    """Flown with an airspeed that swings by an amplitude [m/s]."""
    fly_second = Fleet.fly_second

    def swing(fleet: Fleet, t: float) -> None:
        fly_second(fleet, t)
        turn = 2.0 * pi / period
        fleet.states[0, 5] += amplitude * (sin(turn * (t + 1.0)) - sin(turn * t))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Fleet, "fly_second", swing)
        return flown(world())


@pytest.mark.parametrize("amplitude", [0.1, 0.3, 1.0])
def test_a_wobble_of_the_airspeed_is_no_weak_brake(amplitude: float) -> None:
    *_, steady = flown(world())
    *_, end = wobbling(amplitude)
    assert isinstance(end, FlightEnded)
    assert isinstance(steady, FlightEnded)
    assert end.results[0].joined
    assert end.results[0].join_time == pytest.approx(steady.results[0].join_time, abs=5.0)


def test_what_was_learnt_is_forgotten_again() -> None:
    built = world()
    fleet = Fleet(built, 0.05)
    one = begin_pursuit(built, fleet, built.links[0])
    advice = SimpleNamespace(control=Control(0.0, 0.0, 100.0))
    one.advice = advice  # type: ignore[assignment]  # only what is asked of it is looked at
    for rate, learnt in ((0.4, 0.4), (1.6, None)):
        one.braked, tas = (), 230.0
        for _ in range(15):
            tas -= rate
            fleet.states[0, 5] = tas
            learn_braking(one, fleet)
        limits = fleet.believed_limits[0]
        if learnt:
            seen = full_deceleration(limits, 230.0 - 10.0 * rate, 1.0)
            assert seen == pytest.approx(learnt, abs=0.02)
        else:
            assert limits.braking == 1.0
    assert one.assignment.idle_deceleration == one.idle_deceleration


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

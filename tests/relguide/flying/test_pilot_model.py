"""A pilot flies along the bars: the perfect one as the autopilot does, any other by its seed."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from numpy.typing import NDArray

from relguide.contract.pilot_bodies import PilotBody, pilot_of
from relguide.flying.by_hand import is_announced
from relguide.flying.dispersion import disperse_pilot, random_situation
from relguide.flying.documents import FlightEnded, PlanChanged, Sample
from relguide.flying.fleet import Fleet
from relguide.flying.flight import Scenario, fly, world_of
from relguide.flying.guidance.announcements import Alerted
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.orders import SetAutopilot
from relguide.flying.pilot_model import PilotModel
from relguide.flying.scenarios import SCENARIOS, own_scenario, scenario
from relguide.kernels.flight.by_hand import REACTS_AT
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import DEG, NM

NO_MARGIN = replace(DEFAULT, by_hand_margin=1.0)
"""Plans by hand are those of the autopilot: so small a margin is none."""
STRAIGHT = Situation(
    pursuer=Pursuer(x=-20e3, y=-30e3, heading=40.0 * DEG, tas=230.0, max_bank=25.0 * DEG),
    leader=Leader(x=0.0, y=0.0, heading=75.0 * DEG, tas=190.0, intent=()),
    slot_distance=12e3,
    min_separation=5.0 * NM,
)

NEAR = Situation(
    pursuer=Pursuer(x=18.8e3, y=56.1e3, heading=236.0 * DEG, tas=212.0, max_bank=25.0 * DEG),
    leader=Leader(x=0.0, y=0.0, heading=4.5 * DEG, tas=206.0, intent=()),
    slot_distance=14.5e3,
    min_separation=10.15e3,
)
"""A plan that passes d_min closely."""


def path(flight: Scenario, seed: int = 0, until: float = 1e6) -> NDArray[np.float64]:
    """Where all aircraft are each second. shape (seconds, 2 aircraft and more)"""
    rows = []
    for one in fly(flight, plan, settings=NO_MARGIN, sample_period=1.0, seed=seed):
        if isinstance(one, Sample):
            if one.t > until:
                break
            rows.append([place for aircraft in one.aircraft for place in (aircraft.x, aircraft.y)])
    return np.array(rows)


def off(ours: NDArray[np.float64], theirs: NDArray[np.float64]) -> float:
    """How far apart two flights of the same aircraft are at most [m]."""
    assert ours.shape == theirs.shape
    return float(np.max(np.hypot(*np.moveaxis((ours - theirs).reshape(len(ours), -1, 2), -1, 0))))


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"bandwidth": 0.0}, "bandwidth must lie in 0.1 … 5 rad/s"),
        ({"delay": 2.0}, "delay must lie in 0 … 1.5 s"),
        ({"remnant": -0.1}, "remnant must lie in 0 … 1"),
        ({"threshold": 20.0 * DEG}, "threshold must lie in 0 … 10 °"),
        ({"reaction": 31.0}, "reaction must lie in 0 … 30 s"),
        ({"lead": -1.0}, "lead must lie in 0 … 2 s"),
    ],
)
def test_what_is_no_pilot_is_refused(wrong: dict[str, float], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        PilotModel(**wrong)


def test_a_pilot_prints_as_it_is_written() -> None:
    pilot = PilotModel(bandwidth=0.8, delay=0.2)
    assert eval(repr(pilot)) == pilot


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENARIOS)
def test_autopilot_and_perfect_pilot_fly_the_same_scenario(name: str) -> None:
    flight = scenario(name)
    assert off(path(flight), path(replace(flight, by_hand=PilotModel.perfect()))) < 5.0


@pytest.mark.slow
@pytest.mark.parametrize("number", range(1, 51))
def test_autopilot_and_perfect_pilot_fly_the_same_in_wind_and_gusts(number: int) -> None:
    """Half of them in wind, half in gusts."""
    flight = replace(own_scenario(random_situation(number)), gusts=1.5 if number % 2 else 0.0)
    assert off(path(flight), path(replace(flight, by_hand=PilotModel.perfect()))) < 5.0


def test_a_seed_flies_a_pilot_again_and_another_seed_does_not() -> None:
    flight = replace(own_scenario(STRAIGHT), by_hand=PilotModel())
    first = path(flight, 4, until=120.0)
    assert np.array_equal(first, path(flight, 4, until=120.0))
    assert 0.1 < off(first, path(flight, 5, until=120.0)) < 200.0


def test_a_mirrored_flight_is_flown_as_in_a_mirror() -> None:
    pursuer, leader = STRAIGHT.pursuer, STRAIGHT.leader
    mirrored = replace(
        STRAIGHT,
        pursuer=replace(pursuer, x=-pursuer.x, heading=-pursuer.heading % (360.0 * DEG)),
        leader=replace(leader, x=-leader.x, heading=-leader.heading % (360.0 * DEG)),
    )
    pilot = PilotModel(remnant=0.0)
    ours, theirs = (path(replace(own_scenario(one), by_hand=pilot)) for one in (STRAIGHT, mirrored))
    assert off(ours, theirs * np.array([-1.0, 1.0, -1.0, 1.0])) < 0.1


def test_a_pilot_comes_off_the_autopilots_path_and_joins_with_it() -> None:
    flight = own_scenario(STRAIGHT)
    ends = []
    for by_hand in (None, PilotModel()):
        *_, last = fly(replace(flight, by_hand=by_hand), plan, sample_period=1.0)
        assert isinstance(last, FlightEnded)
        ends.append(last.results[0])
    autopilot, hand = ends
    assert hand.joined
    assert hand.join_time == pytest.approx(autopilot.join_time, rel=0.05)
    (how,) = hand.by_hand
    assert how.within_bar > 0.8 * how.with_bars > 0.0
    assert 0.0 < how.tube < 250.0
    assert autopilot.by_hand == ()


def test_what_is_announced_meanwhile_puts_no_reaction_off() -> None:
    flight = replace(own_scenario(STRAIGHT), by_hand=PilotModel())
    fleet = Fleet(world_of(flight), 0.05)
    fleet.react(0, 10.0, 1.5)
    fleet.react(0, 11.0, 1.5)
    assert fleet.hands[0, REACTS_AT] == 11.5
    fleet.react(0, 12.0, 1.5)
    assert fleet.hands[0, REACTS_AT] == 13.5


def test_an_alert_that_is_over_is_nothing_to_look_at() -> None:
    alert = Alerted(
        subject="separation", level="caution", message="Separation in 60 s.",
        predicted_least=9e3, predicted_at=60.0, cleared=False,
    )  # fmt: skip
    assert is_announced(alert)
    assert not is_announced(replace(alert, cleared=True))


def test_a_margin_is_kept_beside_d_min_while_a_crew_flies() -> None:
    def margins(flight: Scenario) -> dict[float, float]:
        orders = {10.0: [SetAutopilot(on=False)], 20.0: [SetAutopilot(on=True)]}
        flown = fly(flight, plan, sample_period=1.0, commands=lambda t: orders.pop(t, []))
        found = {}
        for one in flown:
            if isinstance(one, Sample):
                found[one.t] = one.guidance[0].margin
                if one.t == 30.0:
                    break
        return found

    taken = margins(own_scenario(STRAIGHT))
    assert {t for t, margin in taken.items() if margin} == {float(t) for t in range(10, 20)}
    assert set(taken.values()) == {0.0, DEFAULT.by_hand_margin}


def test_plans_by_hand_keep_the_margin() -> None:
    kept = []
    for by_hand in (None, PilotModel()):
        flight = replace(own_scenario(NEAR), by_hand=by_hand)
        first = next(one for one in fly(flight, plan) if isinstance(one, PlanChanged))
        kept.append(first.plan.separation.least - NEAR.min_separation)
    autopilot, hand = kept
    assert DEFAULT.separation_buffer - 1.0 <= autopilot < DEFAULT.separation_buffer + 50.0
    assert hand >= DEFAULT.separation_buffer + DEFAULT.by_hand_margin - 1.0


def test_the_nearest_a_pilot_comes_is_not_below_d_min() -> None:
    flight = replace(own_scenario(NEAR), by_hand=PilotModel())
    apart = [
        hypot(one.aircraft[0].x - one.aircraft[1].x, one.aircraft[0].y - one.aircraft[1].y)
        for one in fly(flight, plan, sample_period=1.0)
        if isinstance(one, Sample)
    ]
    assert min(apart) >= NEAR.min_separation


def test_a_seed_draws_the_pilot_that_is_not_described() -> None:
    usual, names = PilotModel(), ("bandwidth", "delay", "remnant", "threshold", "reaction")
    assert disperse_pilot(usual, 0) == usual
    drawn = [disperse_pilot(usual, seed) for seed in range(1, 200)]
    for name in names:
        shares = [getattr(one, name) / getattr(usual, name) for one in drawn]
        assert 0.5 <= min(shares) < 0.55
        assert 1.45 < max(shares) <= 1.5
    assert disperse_pilot(PilotModel(lead=0.4), 7).lead == 0.4
    assert pilot_of(True, 7) == disperse_pilot(usual, 7) != usual
    assert pilot_of(PilotBody(), 7) == usual
    assert pilot_of(False, 7) is None

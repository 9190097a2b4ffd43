"""The first documents of a flight that follows its plan exactly: start, leader's route, plan."""

from math import radians
from typing import NamedTuple

from relguide.flying.aircraft_documents import AircraftCard, LinkCard
from relguide.flying.cards import path_point, path_segments, plan_card, wind_card
from relguide.flying.documents import FlightStarted, LeaderRoute, PlanChanged
from relguide.planning.alternatives import alternatives
from relguide.planning.outcome import Plan
from relguide.units import Second


class Opening(NamedTuple):
    """The first three documents."""

    started: FlightStarted
    route: LeaderRoute
    plan: PlanChanged


def opening_of(
    answer: Plan, *, own: str, leader: str, name: str, title: str, shown_for: Second
) -> Opening:
    """Of an A300 behind another, the plan engaged at once.

    Args:
        answer: the plan.
        own: the pursuer's ident.
        leader: the leader's.
        name: the scenario's.
        title: the same for people.
        shown_for: how much of the leader's route is given [s].
    """
    situation, at = answer.situation, answer.certificate.at_time
    wind, route = situation.wind, situation.leader.trajectory
    started = FlightStarted(
        t=0.0,
        scenario=name,
        title=title,
        planner="exact",
        aircraft=(
            AircraftCard(ident=own, aircraft_type="A300", max_bank=radians(25.0)),
            AircraftCard(ident=leader, aircraft_type="A300", max_bank=radians(20.0)),
        ),
        links=(
            LinkCard(
                pursuer=own,
                leader=leader,
                slot_distance=situation.slot_distance,
                min_separation=situation.min_separation,
                spacing="distance",
                spacing_time=0.0,
            ),
        ),
        wind=wind_card(wind),
        step=0.05,
        seed=0,
    )
    expected = LeaderRoute(
        t=0.0,
        ident=leader,
        expected_by=own,
        intent_known=bool(situation.leader.intent),
        segments=path_segments(route, wind=wind, horizon=shown_for),
    )
    engaged = PlanChanged(
        t=0.0,
        ident=own,
        reason="engaged",
        message="Converging.",
        plan=plan_card(answer, alternatives(answer)),
        leader_at_closest=path_point(route.pose_at(at), at, wind),
        pursuer_at_closest=path_point(answer.trajectory.pose_at(at), at, wind),
        announced=True,
        promised=answer.time_to_converge,
        tube=0.0,
        flown_least=answer.certificate.least_separation,
    )
    return Opening(started, expected, engaged)

"""answer(situation): the plan, or why there is none, in JSON; `bulk.py` answers many."""

from collections.abc import Collection, Iterable
from math import inf
from typing import TYPE_CHECKING, Any, Literal

from relguide.contract.bodies import Anchor, path_to_wire, plan_to_wire
from relguide.contract.refusal import ContractError
from relguide.contract.wire import to_wire
from relguide.flying.cards import no_plan_card, optimality_check, other_path_cards, plan_card
from relguide.planning.acceptance import ask
from relguide.planning.deadline import end_of, left_until
from relguide.planning.frames import LocalPlane
from relguide.planning.plan import NoPlan, Plan, Planner
from relguide.planning.situation import Situation
from relguide.units import Second

if TYPE_CHECKING:
    from relguide.flying.verdicts import OptimalityCheck
    from relguide.planning.alternatives import AnyAlternative

Include = Literal["alternatives", "paths", "optimality"]
"""What an answer contains only if asked for: the other paths to the slot and why each is not flown,
the same to be drawn, and how the plan meets Pontryagin's conditions. They take longer than the
plan."""
Form = Literal["json", "geojson"]
"""How a plan is written: as it is; or as GeoJSON, whose object has the members of the plan beside
its features."""
MOST_PATHS = 8
"""Most other paths that are given to be drawn, the fastest."""


def read_include(text: str) -> tuple[Include, ...]:
    """What to include, as the command line and REST name it: words with commas between.

    Raises:
        ValueError: for an unknown word.
    """
    chosen: list[Include] = []
    for word in text.split(","):
        match word.strip():
            case "alternatives" | "paths" | "optimality" as known:
                chosen.append(known)
            case "":
                pass
            case other:
                raise ValueError(
                    "include must be alternatives, paths or optimality, or some of them with "
                    f"commas, not {other}."
                )
    return tuple(chosen)


def answer(
    situation: Situation,
    anchor: Anchor,
    planner: Planner,
    *,
    include: Collection[Include] = (),
    deadline: Second | None = None,
    form: Form = "json",
) -> dict[str, Any]:
    """A plan, or why there is none, as a JSON object.

    Args:
        situation: what to plan.
        anchor: how its world frame lies on the earth.
        planner: who plans; its plan is checked as in flight, and if it may not be flown the exact
            plan takes its place.
        include: what to add to the plan.
        deadline: how long planner and alternatives may take, as in `ask` [s].
        form: how it is written.

    Raises:
        ValueError: if the deadline is out of range.
        ContractError: for GeoJSON of a situation that does not lie on the earth.
    """
    if form == "geojson":
        _expect_placed(anchor)
    until = end_of(deadline)
    planned = ask(planner, situation, deadline=left_until(until)).plan
    return answer_plan(planned, anchor, include=include, until=until, form=form)


def answer_plan(
    planned: Plan | NoPlan,
    anchor: Anchor,
    *,
    include: Collection[Include] = (),
    until: float = inf,
    form: Form = "json",
) -> dict[str, Any]:
    """As `answer`, of what has been planned; alternatives end by then, of `end_of` [s]."""
    match planned:
        case Plan():
            left = left_until(until)
            asked = not {"alternatives", "paths"}.isdisjoint(include)
            others = _alternatives(planned, left) if asked else ()
            reply = plan_to_wire(plan_card(planned, others), anchor)
            if "paths" in include:
                wind = planned.situation.wind
                cards = other_path_cards(others, wind, later=0.0, most=MOST_PATHS)
                reply["others"] = [path_to_wire(card, anchor) for card in cards]
            if "alternatives" not in include:
                del reply["alternatives"]
            if "optimality" in include:
                reply["optimality"] |= to_wire(check_optimality(planned))
            if form == "geojson":
                drawn = others if "paths" in include else ()
                reply = _collect(_features(planned, drawn, anchor)) | reply
            return reply
        case NoPlan():
            reply = to_wire(no_plan_card(planned))
            return _collect([]) | reply if form == "geojson" else reply


def _expect_placed(anchor: Anchor) -> LocalPlane:
    if isinstance(anchor, LocalPlane):
        return anchor
    nowhere = (
        "must be given as lat_deg, lon_deg in both aircraft for GeoJSON: x_m, y_m lie nowhere on "
        "the earth."
    )
    raise ContractError([("pursuer", nowhere), ("leader", nowhere)])


def _features(
    plan: Plan, others: "Iterable[AnyAlternative]", anchor: Anchor
) -> list[dict[str, Any]]:
    from relguide.contract.geojson import plan_features
    from relguide.planning.alternatives import Alternative

    paths = [(o.candidate.trajectory, o.why) for o in others if isinstance(o, Alternative)]
    return plan_features(
        plan.situation, plan.trajectory, paths[:MOST_PATHS], _expect_placed(anchor)
    )


def _collect(features: list[dict[str, Any]]) -> dict[str, Any]:
    return {"type": "FeatureCollection", "features": features}


def _alternatives(plan: Plan, deadline: Second | None) -> "tuple[AnyAlternative, ...]":
    from relguide.planning.alternatives import alternatives  # which a plan alone need not load

    return alternatives(plan, deadline=deadline)


def check_optimality(plan: Plan) -> "OptimalityCheck":
    """How a plan meets Pontryagin's conditions. Takes some milliseconds."""
    from relguide.planning.optimality import check

    return optimality_check(check(plan, plan.situation))

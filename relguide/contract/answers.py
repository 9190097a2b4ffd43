"""answer(situation): the plan, or why there is none, in JSON; `bulk.py` answers many."""

from collections.abc import Collection, Iterable
from math import inf
from typing import TYPE_CHECKING, Any, Literal, get_args

from relguide.contract.bodies import flown_to_wire, path_to_wire, plan_to_wire
from relguide.contract.places import Anchor
from relguide.contract.refusal import ContractError
from relguide.contract.wire import to_wire
from relguide.flying.cards import no_plan_card, optimality_check, other_path_cards, plan_card
from relguide.planning.acceptance import ask
from relguide.planning.deadline import end_of, left_until
from relguide.planning.frames import LocalPlane
from relguide.planning.outcome import NoPlan, Plan, Planner
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import Second

if TYPE_CHECKING:
    from relguide.flying.plan_documents import FlownCard, NotFlownCard
    from relguide.flying.verdicts import OptimalityCheck
    from relguide.planning.alternatives import AnyAlternative

Include = Literal["alternatives", "paths", "optimality", "flown"]
"""What an answer contains only if asked for: the other paths to the slot and why each is not flown,
the same to be drawn, how the plan meets Pontryagin's conditions, and the flight that guidance would
make of it. They take longer than the plan."""
Form = Literal["json", "geojson"]
"""How a plan is written: as it is; or as GeoJSON, whose object has the members of the plan beside
its features."""
INCLUDABLE: tuple[Include, ...] = get_args(Include)
"""All of it, as it is named."""
TO_FLY: Second = 0.03
"""How long a flight ahead may plan at the least, however late it is [s]: most take 4 ms in all."""
MOST_PATHS = 8
"""Most other paths that are given to be drawn, the fastest."""


def read_include(text: str) -> tuple[Include, ...]:
    """What to include, as the command line and REST name it: words with commas between.

    Raises:
        ValueError: for an unknown word.
    """
    words = [word.strip() for word in text.split(",")]
    for word in words:
        if word not in ("", *INCLUDABLE):
            *first, last = INCLUDABLE
            raise ValueError(
                f"include must be {', '.join(first)} or {last}, or some of them with commas, not "
                f"{word}."
            )
    return tuple(known for word in words for known in INCLUDABLE if known == word)


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
    return answer_plan(planned, anchor, planner, include=include, until=until, form=form)


def answer_plan(
    planned: Plan | NoPlan,
    anchor: Anchor,
    planner: Planner = plan,
    *,
    include: Collection[Include] = (),
    until: float = inf,
    form: Form = "json",
) -> dict[str, Any]:
    """As `answer`, of what has been planned; what is included ends by then, of `end_of` [s].

    A flight is planned by its planner, and has some milliseconds however late it is.
    """
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
            if "flown" in include:
                reply["flown"] = flown_to_wire(fly_plan(planned, planner, until), anchor)
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


def fly_plan(planned: Plan, planner: Planner, until: float) -> "FlownCard | NotFlownCard":
    """The flight that guidance would make of a plan, planned by then, of `end_of` [s]."""
    from relguide.flying.flown_plan import flown_card  # as above

    left = left_until(until)
    end = inf if left is None else end_of(max(left, TO_FLY))
    return flown_card(planned, planner, until=end)


def check_optimality(plan: Plan) -> "OptimalityCheck":
    """How a plan meets Pontryagin's conditions. Takes some milliseconds."""
    from relguide.planning.optimality import check

    return optimality_check(check(plan, plan.situation))

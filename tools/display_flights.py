"""The flights that the display is tested with, made anew: `python -m tools.display_flights`.

Each file of `web/test/nd/flights` holds three documents: the start, the leader's route, the plan.
"""

from dataclasses import replace
from math import radians
from pathlib import Path

import orjson

from relguide.contract.wire import to_wire
from relguide.flying.documents import Document
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.planning.wind import CALM, Wind, wind_from
from tests.openings import opening_of

FOLDER = Path(__file__).parents[1] / "web" / "test" / "nd" / "flights"
OWN, LEADER = "RG456", "AF123"


def main() -> None:
    """Write all of them."""
    for name in SITUATIONS:
        body = [to_wire(document) for document in display_flight(name)]
        (FOLDER / f"{name}.json").write_bytes(orjson.dumps(body, option=INDENTED))


def display_flight(name: str) -> tuple[Document, ...]:
    """The three documents of one of them."""
    title, situation = SITUATIONS[name]
    answer = plan(situation)
    assert isinstance(answer, Plan)
    started, expected, engaged = opening_of(
        answer,
        own=OWN,
        leader=LEADER,
        name=name,
        title=title,
        shown_for=answer.time_to_converge + 600.0,
    )
    return started, expected, replace(engaged, plan=replace(engaged.plan, compute=0.0))


def _situation(
    x: float,
    y: float,
    heading: float,
    *intent: IntentPiece,
    slot_distance: float = 10_000.0,
    wind: Wind = CALM,
) -> Situation:
    """Behind a leader that flies east from the origin."""
    return Situation(
        pursuer=Pursuer(x=x, y=y, heading=radians(heading), tas=240.0, max_bank=radians(25.0)),
        leader=Leader(x=0.0, y=0.0, heading=radians(90.0), tas=200.0, intent=intent),
        slot_distance=slot_distance,
        min_separation=9_260.0,
        wind=wind,
    )


def _turn(after: float, heading: float, turn: Turn) -> tuple[IntentPiece, ...]:
    return (
        FlyStraight(duration=after),
        TurnTo(heading=radians(heading), turn=turn, bank=radians(20.0)),
    )


INDENTED = orjson.OPT_INDENT_2 | orjson.OPT_APPEND_NEWLINE
NORTH_WEST = (-40_000.0, 40_000.0, 90.0)
SITUATIONS = {
    "crossing": (
        "Crossing",
        _situation(
            33_337.66631859229,
            -24_152.741416147368,
            48.9487896722408,
            *_turn(400.0, 135.0, RIGHT),
            slot_distance=12_000.0,
        ),
    ),
    "fig_6a": ("Fig. 6a", _situation(*NORTH_WEST)),
    "fig_6b": ("Fig. 6b", _situation(*NORTH_WEST, *_turn(240.0, 135.0, RIGHT))),
    "fig_6b_wind": (
        "Fig. 6b in wind",
        _situation(*NORTH_WEST, *_turn(240.0, 135.0, RIGHT), wind=wind_from(radians(320.0), 30.0)),
    ),
    "left": ("Mirrored", _situation(-30_000.0, -30_000.0, 60.0, *_turn(60.0, 45.0, LEFT))),
}
"""By file name: the title, and where they begin."""

if __name__ == "__main__":
    main()

"""Named flights to learn on: short ones, that a crew flies by hand and the autopilot has flown."""

from relguide.flying.flight import Scenario
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, IntentPiece, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT
from relguide.units import DEG, NM, Metre, Radian


def lesson_bar(title: str, description: str) -> Scenario:
    """A turn to the right, a straight and a turn to the left: both ways to follow the bar."""
    return _lesson("lesson_bar", title, description, x=-19_000.0, y=12_000.0, heading=90.0 * DEG)


def lesson_raw(title: str, description: str) -> Scenario:
    """From the other side: two turns to the right, and a long straight between them."""
    return _lesson("lesson_raw", title, description, x=-19_000.0, y=-12_000.0, heading=60.0 * DEG)


def lesson_turn(title: str, description: str) -> Scenario:
    """A leader that turns toward the pursuer, which does not know of it."""
    turn = FlyStraight(duration=80.0), TurnTo(heading=50.0 * DEG, turn=LEFT, bank=20.0 * DEG)
    return _lesson(
        "lesson_turn", title, description, x=-20_000.0, y=12_000.0, heading=90.0 * DEG, untold=turn
    )


def _lesson(
    name: str,
    title: str,
    description: str,
    *,
    x: Metre,
    y: Metre,
    heading: Radian,
    untold: tuple[IntentPiece, ...] = (),
) -> Scenario:
    """One lesson; all have the same leader, and the same to keep."""
    return Scenario(
        name=name,
        title=title,
        description=description,
        situation=Situation(
            pursuer=Pursuer(x=x, y=y, heading=heading, tas=240.0, max_bank=25.0 * DEG),
            leader=Leader(x=0.0, y=0.0, heading=90.0 * DEG, tas=195.0, intent=untold),
            slot_distance=10_000.0,
            min_separation=5.0 * NM,
        ),
        intent_known=not untold,
    )

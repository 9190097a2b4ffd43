"""Flights of several followers of one leader, each behind the one before."""

from relguide.flying.flight import Scenario
from relguide.flying.followers import Follower
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.situation import Situation
from relguide.planning.trajectory import RIGHT
from relguide.units import DEG, NM, Metre, MetrePerSecond, Radian, Second

SLOT: Metre = 12_000.0
"""D of all [m]."""
MINUTE: Second = 60.0
"""Time that the stream keeps: SLOT at its speed [s]."""


def stream_of_five(title: str, description: str) -> Scenario:
    """Five aircraft from both sides join a stream behind a leader that turns.

    Args:
        title: for people.
        description: what it shows.
    """
    return Scenario(
        name="stream_of_five",
        title=title,
        description=description,
        situation=Situation(
            pursuer=_pursuer(-20_000.0, -15_000.0, 70.0 * DEG),
            leader=Leader(
                x=0.0,
                y=0.0,
                heading=90.0 * DEG,
                tas=200.0,
                intent=(
                    FlyStraight(duration=120.0),
                    TurnTo(heading=120.0 * DEG, turn=RIGHT, bank=25.0 * DEG),
                ),
            ),
            slot_distance=SLOT,
            min_separation=5.0 * NM,
        ),
        spacing=MINUTE,
        followers=(
            Follower(ident="SECOND", pursuer=_pursuer(-25_000.0, 22_000.0, 120.0 * DEG)),
            Follower(ident="THIRD", pursuer=_pursuer(-45_000.0, -25_000.0, 70.0 * DEG)),
            Follower(ident="FOURTH", pursuer=_pursuer(-50_000.0, 30_000.0, 110.0 * DEG)),
            Follower(ident="FIFTH", pursuer=_pursuer(-75_000.0, -15_000.0, 80.0 * DEG)),
        ),
    )


def overtaking_queue(title: str, description: str) -> Scenario:
    """A faster aircraft joins the end of a queue of three, which are a little late themselves.

    Args:
        title: for people.
        description: what it shows.
    """
    east = 90.0 * DEG
    return Scenario(
        name="overtaking_queue",
        title=title,
        description=description,
        situation=Situation(
            pursuer=_pursuer(-75_000.0, 30_000.0, 95.0 * DEG, 245.0),
            leader=Leader(x=0.0, y=0.0, heading=east, tas=200.0),
            slot_distance=SLOT,
            min_separation=5.0 * NM,
        ),
        ahead=(
            Follower(ident="FIRST", pursuer=_pursuer(-13_000.0, 0.0, east, 212.0)),
            Follower(ident="SECOND", pursuer=_pursuer(-26_000.0, 0.0, east, 212.0)),
            Follower(ident="THIRD", pursuer=_pursuer(-39_000.0, 0.0, east, 212.0)),
        ),
    )


def _pursuer(x: Metre, y: Metre, heading: Radian, tas: MetrePerSecond = 235.0) -> Pursuer:
    return Pursuer(x=x, y=y, heading=heading, tas=tas, max_bank=25.0 * DEG)

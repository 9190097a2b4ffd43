"""Named flights amid others: a stream that crosses the way, and a line of thunderstorms in it."""

from math import cos, sin

from relguide.flying.flight import Scenario
from relguide.planning.aircraft import Leader, Pursuer, Traffic
from relguide.planning.cells import Cell, Disc, Polygon
from relguide.planning.situation import Other, Situation
from relguide.units import DEG, NM, Metre

IN_STREAM = 6
"""Aircraft of the crossing stream."""
TRAIL: Metre = 40_000.0
"""How far they fly behind each other [m]: enough for a gap, not for two."""


def crossing_stream(title: str, description: str) -> Scenario:
    """A pursuer that has to cross a row of six aircraft to join its leader."""
    heading, tas = 200.0 * DEG, 230.0
    stream = tuple(
        Traffic(
            ident=f"STREAM{k + 1}",
            x=30_000.0 - (k * TRAIL - 5_000.0) * sin(heading),
            y=45_000.0 - (k * TRAIL - 5_000.0) * cos(heading),
            heading=heading,
            tas=tas,
            min_separation=5.0 * NM,
        )
        for k in range(IN_STREAM)
    )
    return _scenario("crossing_stream", title, description, stream)


def thunderstorm_line(title: str, description: str) -> Scenario:
    """A pursuer that has to find a gap in a line of cells that moves and grows."""
    cells = (
        Cell(
            ident="CB1",
            shape=Disc(x=30_000.0, y=62_000.0, radius=14_000.0),
            east=8.0,
            north=4.0,
            growth=2.0,
        ),
        Cell(
            ident="CB2",
            shape=Polygon(
                corners=(
                    (24_000.0, 22_000.0),
                    (44_000.0, 18_000.0),
                    (50_000.0, 34_000.0),
                    (30_000.0, 40_000.0),
                )
            ),
            east=8.0,
            north=4.0,
            growth=1.0,
        ),
        Cell(
            ident="CB3",
            shape=Disc(x=95_000.0, y=24_000.0, radius=9_000.0),
            east=6.0,
            north=6.0,
            growth=3.0,
        ),
    )
    return _scenario("thunderstorm_line", title, description, cells)


def _scenario(name: str, title: str, description: str, others: tuple[Other, ...]) -> Scenario:
    return Scenario(
        name=name,
        title=title,
        description=description,
        situation=Situation(
            pursuer=Pursuer(
                x=-40_000.0, y=40_000.0, heading=90.0 * DEG, tas=240.0, max_bank=25.0 * DEG
            ),
            leader=Leader(x=0.0, y=0.0, heading=90.0 * DEG, tas=200.0),
            slot_distance=10_000.0,
            min_separation=5.0 * NM,
            others=others,
        ),
    )

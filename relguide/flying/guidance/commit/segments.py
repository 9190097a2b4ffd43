"""Pieces of constant curvature as the segments of a trajectory."""

from relguide.kernels.base.roots import FloatArray
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Segment, Straight
from relguide.units import Metre

NOTHING: Metre = 1e-3
"""A piece shorter than this is where two others meet [m]."""


def segments_of(pieces: FloatArray) -> tuple[Segment, ...]:
    """Pieces of constant curvature as segments; boundary arcs come as their arcs.

    A course is laid in parts: what goes on across their ends is one segment.

    Args:
        pieces: length [m] and curvature [rad/m] of each, to the right positive. shape (n, 2)
    """
    segments: tuple[Segment, ...] = ()
    for length, curvature in pieces.tolist():
        if length < NOTHING:
            continue
        piece: Segment = Straight(length=length)
        if curvature != 0.0:
            turn = RIGHT if curvature > 0.0 else LEFT
            angle = length * abs(curvature)
            piece = Arc(turn=turn, turn_angle=angle, radius=1.0 / abs(curvature))
        segments = join_segments(segments, (piece,))
    return segments


def join_segments(first: tuple[Segment, ...], then: tuple[Segment, ...]) -> tuple[Segment, ...]:
    """Two runs of segments as one, where they meet made one segment if they are alike."""
    if first and then:
        match first[-1], then[0]:
            case Straight(length=one), Straight(length=other):
                return (*first[:-1], Straight(length=one + other), *then[1:])
            case (
                Arc(turn=turn, turn_angle=one, radius=radius),
                Arc(turn=same, turn_angle=other, radius=like),
            ) if turn == same and abs(radius - like) < 1.0:
                arc = Arc(turn=turn, turn_angle=one + other, radius=radius)
                return (*first[:-1], arc, *then[1:])
            case _:
                pass
    return (*first, *then)

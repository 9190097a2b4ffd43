"""others_of(situation, frame): all that is to be kept clear of, as the kernels take it."""

from math import atan2, hypot, inf
from typing import NamedTuple, assert_never

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.others import Others, forbidden_arrivals
from relguide.kernels.separation.clearance import SLACK
from relguide.planning.aircraft import Traffic
from relguide.planning.cells import Cell
from relguide.planning.certificate import AROUND_CELLS, FOLLOWED, cell_shape
from relguide.planning.heights import Heights, counted, heights_of, off_level
from relguide.planning.situation import Other, Situation
from relguide.planning.slot import SlotFrame
from relguide.planning.tables import leader_table, pieces_table
from relguide.planning.words import HORIZON

_PROVED = 1.1
"""Cells are kept this many times farther off than their certificate may miss."""
_ROUNDING = 2.0 * SLACK  # the start may be so much nearer than the minimum [R]


class _Shape(NamedTuple):
    """One of them, in the slot frame."""

    pieces: FloatArray
    speed: float
    limit: float
    growth: float
    corners: FloatArray
    reach: float


_AT_LEVEL = 1e-3
"""It joins so long after its leader's level is reached, and before it is left [s]."""


def others_of(situation: Situation, frame: SlotFrame, *, until: float = inf) -> Others:
    """The leader, and all others of a situation.

    Args:
        situation: what is asked.
        frame: its slot frame.
        until: when a search must have ended, by `clock.now` [s].
    """
    scale = frame.radius / situation.pursuer.tas
    leader = _Shape(
        leader_table(situation, frame),
        frame.alpha,
        situation.min_separation / frame.radius,
        0.0,
        np.empty((0, 2)),
        0.0,
    )
    shapes = [leader, *(_shape(other, situation, frame) for other in situation.others)]
    corners = [shape.corners for shape in shapes]
    all_pieces = [shape.pieces for shape in shapes]
    limits = [(shape.speed, _eased(shape, frame), shape.growth, shape.reach) for shape in shapes]
    own, leading = heights_of(situation.pursuer), heights_of(situation.leader)
    whole = [leading, *map(_heights_of, situation.others)]
    times = [np.array(counted(own, one)).reshape(-1, 2) / scale for one in whole]
    others = Others(
        pieces=np.concatenate(all_pieces),
        first=_firsts(all_pieces),
        limits=np.array(limits),
        corners=np.concatenate(corners),
        corner=_firsts(corners),
        counted=np.concatenate(times),
        window=_firsts(times),
        forbidden=np.empty((0, 2)),
        alpha=frame.alpha,
        t_release=frame.t_release,
        until=until,
    )
    forbidden = forbidden_arrivals(others, FOLLOWED / scale, HORIZON / scale)
    if situation.pursuer.levels:  # it joins at the leader's level
        off = [(begin - _AT_LEVEL, end + _AT_LEVEL) for begin, end in off_level(own, leading)]
        forbidden = np.concatenate((np.array(off).reshape(-1, 2) / scale, forbidden))
    return others._replace(forbidden=forbidden)


def _firsts(parts: list[FloatArray]) -> np.ndarray:
    """Where each part begins once they are put together, and where the last one ends."""
    return np.cumsum([0, *(len(part) for part in parts)])


def _eased(shape: _Shape, frame: SlotFrame) -> float:
    """Its minimum, or what the start keeps where that is less by rounding [R]."""
    if len(shape.corners):
        return shape.limit
    _, x, y, *_ = shape.pieces[0].tolist()
    kept = hypot(frame.x - x, frame.y - y)
    return kept if shape.limit - _ROUNDING < kept < shape.limit else shape.limit


def _heights_of(other: Other) -> Heights:
    """Its heights; a cell is at all levels."""
    return heights_of(other) if isinstance(other, Traffic) else Heights(altitude=None)


def _shape(other: Other, situation: Situation, frame: SlotFrame) -> _Shape:
    tas, radius = situation.pursuer.tas, frame.radius
    match other:
        case Traffic():
            pieces = pieces_table(other.trajectory, situation, frame)
            limit = other.min_separation / radius
            return _Shape(pieces, other.tas / tas, limit, 0.0, np.empty((0, 2)), 0.0)
        case Cell():
            points, (size, growth, east, north) = cell_shape(other, situation.wind)
            corners = np.array([frame.to_slot(x, y) for x, y in points.tolist()])
            x, y = corners.mean(axis=0)
            reach = float(np.hypot(*(corners - (x, y)).T).max())
            limit = (size + _PROVED * AROUND_CELLS) / radius
            piece = np.array([(0.0, x, y, frame.heading - atan2(east, north), 0.0)])
            speed = hypot(east, north) / tas
            if len(corners) == 1:
                corners = np.empty((0, 2))
            return _Shape(piece, speed, limit, growth / tas, corners, reach)
        case _:
            assert_never(other)

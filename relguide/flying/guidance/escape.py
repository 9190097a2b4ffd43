"""Staying clear of all without a plan: a heading, and how much separation it keeps.

Plans assume that a leader that turns unannounced stops turning now, as nothing else is known. But
it may go on, or slow down, and what keeps d_min if it does not may leave no way out if it does. So
while it does such things an escape is kept in sight: a turn and a straight, begun a second later,
that keep d_min wherever the leader's turn ends.

Others have minima of their own. What is kept of one counts as d_min and what is left beside its
minimum, so that one figure says how clear a heading is of all.
"""

from collections.abc import Iterable, Iterator
from math import hypot, inf
from typing import NamedTuple

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.guidance.amid import nearings
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.forecast import NO_COURSE, forecast
from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.motion import Motion
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.guide import HOLD, Progress
from relguide.kernels.flight.program import roll_lead
from relguide.kernels.separation import least_bad_turn as kernel
from relguide.kernels.separation.approach import least_separation
from relguide.kernels.separation.cell import least_from_cell, signed_distance
from relguide.planning.certificate import cell_shape
from relguide.planning.tables import motion_of
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

ENDS_EVERY: Radian = 30.0 * DEG
"""A leader's turn that ends between two of these is little worse [rad]."""
TURNS_ON: Radian = 180.0 * DEG
"""A leader that turned farther would fly back to where it came from [rad]."""
TRIED_EVERY: Radian = 10.0 * DEG
"""Headings that are flown ahead are so far apart [rad]."""
HEADINGS = 36
"""So many are tried, to both sides by turns."""
FAINT: Radian = 2.0 * DEG
"""An escape's heading is found to 10°; smaller differences do not count [rad]."""


NO_CELL = np.zeros(0)
"""In place of the numbers of a cell."""
ENDS = np.arange(ENDS_EVERY, TURNS_ON + 0.5 * ENDS_EVERY, ENDS_EVERY).tolist()
"""Where a turn may end that is not announced [rad]."""
FOUND_TO: Metre = 1.0
"""Separations are found to this [m]."""
REGAINED_AFTER: Second = 30.0
"""What is already too near counts from so long on: until then no heading makes a difference [s]."""


class Kept(NamedTuple):
    """What is kept on a heading, and of whom."""

    least_separation: Metre
    """Least separation [m]."""
    ident: str
    """Of the other that comes nearest to its minimum; empty for the leader."""


class Escape(NamedTuple):
    """A heading to fly, and the separation it keeps."""

    heading: Radian
    """Clockwise from north [rad]."""
    least_separation: Metre
    """Least separation over all that the leader may do [m]."""
    tas: MetrePerSecond
    """The speed to go for [m/s]."""


def escape(
    belief: Belief,
    assignment: Assignment,
    min_separation: Metre,
    *,
    turns_on: bool = False,
    other_tas: MetrePerSecond | None = None,
    delay: Second = 0.0,
) -> Escape:
    """The heading nearest to the present one that keeps clear for `look_out` seconds.

    If no heading does, the one that stays farthest away.

    Args:
        belief: both aircraft, and the intent as far as it is known.
        assignment: the bank and how far to look.
        min_separation: to be kept [m].
        turns_on: whether the leader's present turn may go on for as much as 180° more.
        other_tas: a speed that the leader may come to [m/s]; as it flies now, if left out.
        delay: how long the pursuer goes on as it does before it turns [s].
    """
    own, bank = belief.own, assignment.planned_bank
    obstacles = _obstacles(belief, assignment)
    rate, full = turn_rate(own.tas, own.bank), turn_rate(own.tas, bank)
    before = np.array(
        [
            (delay + roll_lead(belief.limits, own.bank, side * bank), rate)
            for side in (-1.0, 0.0, 1.0)
        ]
    )
    if obstacles:
        d_min = assignment.min_separation
        leaders = _variants(belief, d_min, turns_on=turns_on, other_tas=other_tas)
        among = (*leaders, *obstacles)
        return _escape_among(belief, assignment, among, before, min_separation)
    best = Escape(own.heading, inf, own.tas)
    for leader in _leaders(belief, other_tas):
        side, angle, least = kernel.escape_path(
            _motion(belief), full, before, leader, _pieces(belief, leader, turns_on=turns_on),
            min_separation, assignment.settings.look_out,
        )  # fmt: skip
        turned = before[side + 1, 0] * rate + side * angle
        if least < best.least_separation:
            best = Escape(wrap(own.heading + turned), least, own.tas)
    return best


def flown_escape(
    belief: Belief, assignment: Assignment, min_separation: Metre, at_least: Metre
) -> Escape | None:
    """A heading and a speed that keep clear if flown as the aircraft flies, with all its bank.

    Rolling and braking are flown ahead, so it finds what a turn at constant speed does not keep. Of
    those that keep clear, the one nearest to the present heading that keeps its speed.

    Args:
        belief: both aircraft; the leader flies as is expected of it.
        assignment: what was asked.
        min_separation: to be kept [m].
        at_least: what another must keep to be better than nothing [m].

    Returns:
        `None` if none keeps `at_least`.
    """
    own, best = belief.own, None
    for tas in (own.tas, belief.limits.min_tas):
        for k in range(HEADINGS):
            turned = TRIED_EVERY * ((k + 1) // 2) * (1.0 if k % 2 else -1.0)
            heading = own.heading + turned
            least = separation_flown(belief, assignment, heading, tas)
            if least >= min_separation:
                return Escape(wrap(heading), least, tas)
            if least > (at_least if best is None else best.least_separation):
                best = Escape(wrap(heading), least, tas)
    return best


def separation_flown(
    belief: Belief, assignment: Assignment, heading: Radian, tas: MetrePerSecond
) -> Metre:
    """The least separation on a heading at a speed, flown ahead with its roll and braking [m]."""
    holding = Progress(HOLD, 0.0, heading, tas)
    until = belief.t + assignment.settings.look_out
    ahead = forecast(belief, assignment, holding, NO_COURSE, until=until)
    least, _ = ahead.least(belief.t)
    others = nearings(ahead, belief, assignment)
    if others:
        least = min(least, assignment.min_separation + others[0].spare)
    return least


def kept_on_heading(
    belief: Belief,
    assignment: Assignment,
    heading: Radian,
    *,
    turns_on: bool = False,
    other_tas: MetrePerSecond | None = None,
) -> Kept:
    """What is kept if the pursuer turns the shorter way to a heading and keeps it, and of whom."""
    own, bank = belief.own, assignment.planned_bank
    turn = wrap_signed(heading - own.heading)
    side = 1.0 if turn > 0.0 else -1.0
    full = turn_rate(own.tas, bank)
    roll = roll_lead(belief.limits, own.bank, side * bank) if abs(turn) > FAINT else 0.0
    pieces = np.array([(roll, turn_rate(own.tas, own.bank)), (abs(turn) / full, side * full)])
    ours = _motion(belief)._replace(pieces=pieces)
    all_of_them = (
        *_variants(belief, 0.0, turns_on=turns_on, other_tas=other_tas),
        *_obstacles(belief, assignment),
    )
    return _kept(ours, all_of_them, assignment)


class _Obstacle(NamedTuple):
    """What is to be kept clear of: one way that an aircraft may fly, or a cell."""

    ident: str
    """Empty for the leader."""
    motion: Motion | None
    """`None` for a cell."""
    corners: FloatArray
    """Of a cell. shape (n, 2)"""
    cell: FloatArray
    """Its radius, growth and velocity in the air mass, as `least_from_cell` takes them."""
    limit: Metre
    """What is to be kept of others [m]."""
    begin: Second
    """From when on it counts [s]: not at once where it is lost already."""


def _kept(
    ours: Motion, obstacles: Iterable[_Obstacle], assignment: Assignment, enough: Metre = -inf
) -> Kept:
    """The least that a path keeps of all; what comes after the first below `enough` is not tried.

    Args:
        ours: the path.
        obstacles: those to be kept clear of.
        assignment: gives d_min, and how far to look.
        enough: a path that keeps no more than this is not looked at further [m].
    """
    look_out, d_min = assignment.settings.look_out, assignment.min_separation
    kept = Kept(inf, "")
    for one in obstacles:
        if one.motion is not None:
            least = least_separation(ours, one.motion, one.begin, look_out, FOUND_TO)[0]
        else:
            path = np.array([ours.x, ours.y, ours.heading, ours.tas, *_lengths(ours)])
            least = least_from_cell(path, one.corners, one.cell, one.begin, look_out, FOUND_TO)[0]
        if one.ident:
            least += d_min - one.limit
        if least < kept.least_separation:
            kept = Kept(float(least), one.ident)
            if kept.least_separation <= enough:
                break
    return kept


def _lengths(motion: Motion) -> list[float]:
    """Length [m] and curvature [rad/m] of each piece in turn."""
    lengths = motion.pieces * np.array([motion.tas, 1.0 / motion.tas])
    return list(lengths.ravel().tolist())


def _escape_among(
    belief: Belief,
    assignment: Assignment,
    obstacles: tuple[_Obstacle, ...],
    before: FloatArray,
    min_separation: Metre,
) -> Escape:
    """As the kernel's `escape_path`, of all obstacles at once."""
    own = belief.own
    rate, full = turn_rate(own.tas, own.bank), turn_rate(own.tas, assignment.planned_bank)
    best = Escape(own.heading, -inf, own.tas)
    for k in range(HEADINGS - 1):
        side = 0 if k == 0 else 1 if k % 2 == 0 else -1
        angle = TRIED_EVERY * ((k + 1) // 2)
        pieces = np.array([before[side + 1], (angle / full, side * full)])
        ours = _motion(belief)._replace(pieces=pieces)
        kept = _kept(ours, obstacles, assignment, best.least_separation).least_separation
        if kept > best.least_separation:
            turned = before[side + 1, 0] * rate + side * angle
            best = Escape(wrap(own.heading + turned), kept, own.tas)
        if best.least_separation >= min_separation:
            break
    return best


def _variants(
    belief: Belief, d_min: Metre, *, turns_on: bool, other_tas: MetrePerSecond | None
) -> Iterator[_Obstacle]:
    """All that the leader may do."""
    begin = REGAINED_AFTER if belief.separation < d_min else 0.0
    for leader in _leaders(belief, other_tas):
        for rows in _pieces(belief, leader, turns_on=turns_on):
            yield _Obstacle("", leader._replace(pieces=rows), NO_CELL, NO_CELL, 0.0, begin)


def _obstacles(belief: Belief, assignment: Assignment) -> tuple[_Obstacle, ...]:
    """All others that may come near while an escape looks out, with all that they may do."""
    return (*_traffic(belief, assignment), *_cells(belief, assignment))


def _traffic(belief: Belief, assignment: Assignment) -> Iterator[_Obstacle]:
    settings, own = assignment.settings, belief.own
    for other in belief.others:
        body, limit = other.body, other.min_separation
        apart = hypot(body.x - own.x, body.y - own.y)
        near = apart <= limit + (own.tas + body.tas) * settings.look_out
        if not near or not other.may_count(settings.look_out):
            continue
        # what is nearer now than it should be cannot be kept farther off, but for what is lost
        begin = REGAINED_AFTER if apart < limit else 0.0
        limit = limit if apart < limit else min(limit, apart - settings.escape_tube)
        motions = [motion_of(other.traffic.trajectory)]
        if other.turns_unannounced:
            now = motions[0]._replace(heading=body.heading)
            rate = other.turn_rate
            motions += [now._replace(pieces=np.array([[end / abs(rate), rate]])) for end in ENDS]
        for motion in motions:
            yield _Obstacle(other.ident, motion, NO_CELL, NO_CELL, limit, begin)


def _cells(belief: Belief, assignment: Assignment) -> Iterator[_Obstacle]:
    settings, own = assignment.settings, belief.own
    for cell in belief.cells:
        corners, shape = cell_shape(cell, belief.wind)
        apart = float(signed_distance(own.x, own.y, corners, shape[0])[0])
        speed = hypot(cell.east, cell.north) + cell.growth
        wind = hypot(belief.wind.east, belief.wind.north)
        if apart > (own.tas + wind + speed) * settings.look_out:
            continue
        begin = REGAINED_AFTER if apart < 0.0 else 0.0
        limit = 0.0 if apart < 0.0 else min(0.0, apart - settings.escape_tube)
        yield _Obstacle(cell.ident, None, corners, shape, limit, begin)


def _motion(belief: Belief) -> Motion:
    own = belief.own
    return Motion(own.x, own.y, own.heading, own.tas, np.zeros((1, 2)))


def _leaders(belief: Belief, other_tas: MetrePerSecond | None) -> tuple[Motion, ...]:
    """The leader at its speed, and at the one that it may come to."""
    leader = motion_of(belief.leader_after(0.0).trajectory)
    if other_tas is not None:
        return leader, leader._replace(tas=max(other_tas, 1.0))
    return (leader,)


def _pieces(belief: Belief, leader: Motion, *, turns_on: bool) -> FloatArray:
    """Pieces of all that the leader may do: its declared intent, or a turn that goes on."""
    known, rate = leader.pieces, belief.leader_turn_rate
    ends = ENDS if turns_on else ()
    pieces = np.zeros((1 + len(ends), max(len(known), 1), 2))
    pieces[0, : len(known)] = known
    for i, end in enumerate(ends, start=1):
        pieces[i, 0] = end / max(abs(rate), 1e-6), rate
    return pieces

"""How an optimal path passes a contact that is its only one, or has others after it, or before it.

At a contact λ_ψ and the turn go on unbroken, and λ_p changes toward the leader only: see `costate`.
So a path that comes in a turn leaves in that turn, to the same side, unless λ_ψ vanishes just
there. A path that slides along the circle at bearing b and side s turns toward the leader at k
V_P/R,

    k = (q + s α sin b)² / (d_min q) − ω α sin b / q,    q = √(1 − α² cos² b),

ω being the leader's turn rate. A path that turns toward the leader at w V_P/R has d″ = (k − w) q
V_P²/R, which must not be negative there, neither before nor after. So where k < −1 there is no
contact, where k < 0 no path passes straight, and where k < 1 no path turns toward the leader. Where
k > 1 no path can slide: the separation grows, whatever the turn, and for a while there is no other
contact.

Where k < 1 and another contact follows, λ_ψ = 0, as on the boundary arc that may follow; only some
of the words from the start end so. Or the path turns away, also where k > 1, and goes on turning
until λ_ψ = 0 again: on a line along the new λ_p. Whatever the change of λ_p, that line passes
through one point, where the line of the word so far meets the one from the leader to the contact.
The line turns from the one to the other as the change grows. So the turn ends between where it
would end without the change, and where it would end if the change were all there is. It goes on for
the lesser of both: what is left of it by the word, and 2 arccos(α cos b). (A turn toward the leader
may end at once. A path that touches once more in that turn may end it from there on.)

Where the leader has yet to turn, the costate may also vanish up to a contact. The path then has
time to spare before the contact, comes to it by any way, and nothing depends on the way. There the
change of λ_p is all there is, so the path turns away, for 2 arccos(α cos b). H is 1 then, and 0 at
the end: it changes only while the leader turns.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, atan2, cos, inf, pi, sqrt

from numba import njit

from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.cells import Cell, fastest_turn, poses_of
from relguide.kernels.bounds.words.found_word import Junction
from relguide.kernels.bounds.words.sets import EDGE
from relguide.kernels.separation.clearance import leader_at, piece_at, piece_end
from relguide.kernels.words.extremals import fly_piece

_ANYTHING = 1e9  # beyond every turn rate [V_P/R]
_PART = 2.9  # of parts/jerk, for which the separation grows: 3 but for rounding
_STRIDE = 1e-5  # least step of the look for another contact [R/V_P]
_LOOKS = 1_000  # it ends after so many
_BESIDE = 0.1  # it ends before the leader is ahead: a path that flies on may come closer then [R]


@njit(cache=True, nogil=True)
def slide_turns(scene: Scene, cell: Cell) -> tuple[float, float]:
    """Least and greatest k in a cell [V_P/R]."""
    low, high = cell.bearing - cell.half, cell.bearing + cell.half
    alpha, d_min, rate = scene.alpha, scene.d_min, scene.leader[cell.piece, 4]
    # in one quadrant both are monotone
    low_s, low_c = sine_and_cosine(low)
    high_s, high_c = sine_and_cosine(high)
    ahead, far = abs(alpha * low_c), abs(alpha * high_c)
    beside = alpha * min(low_s, high_s), alpha * max(low_s, high_s)
    if max(ahead, far) > 1.0 - EDGE:
        return -_ANYTHING, _ANYTHING
    least_q = sqrt(1.0 - max(ahead, far) * max(ahead, far))
    most_q = sqrt(1.0 - min(ahead, far) * min(ahead, far))
    along = (
        least_q + (beside[0] if cell.side > 0.0 else -beside[1]),
        most_q + (beside[1] if cell.side > 0.0 else -beside[0]),
    )
    slow = max(along[0], 0.0)
    swing = min(rate * beside[0], rate * beside[1]), max(rate * beside[0], rate * beside[1])
    least = slow * slow / (d_min * most_q) - max(swing[1] / least_q, swing[1] / most_q)
    most = along[1] * along[1] / (d_min * least_q) - min(swing[0] / least_q, swing[0] / most_q)
    return least, most


@njit(cache=True, nogil=True)
def can_slide(scene: Scene, cell: Cell) -> bool:
    """Whether bank is enough to follow the circle in all of a cell."""
    least, most = slide_turns(scene, cell)
    return bool(-1.0 <= least and most <= 1.0)


@njit(cache=True, nogil=True)
def can_touch(scene: Scene, cell: Cell) -> bool:
    """Whether there can be a contact in a cell."""
    return slide_turns(scene, cell)[1] >= -1.0 - EDGE


@njit(cache=True, nogil=True)
def junction_of(scene: Scene, cell: Cell, pace: float, switch: bool) -> Junction:
    """What is asked of the turn with which a word comes to a contact in a cell, or leaves it.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        pace: +1 of words that come to it, which are read backward; −1 of words that leave it.
        switch: as in `Junction`.
    """
    _, most = slide_turns(scene, cell)
    outward = 0 if pace * cell.side > 0.0 else 1
    beyond, straight = beyond_outward(scene, cell, pace), switch and most >= 0.0
    return Junction(True, outward, beyond, straight, most >= 1.0, switch)


@njit(cache=True, nogil=True)
def beyond_outward(scene: Scene, cell: Cell, pace: float) -> float:
    """For how long a turn away goes on at least, if the change of λ_p is all there is [rad].

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        pace: +1 on after the contact, −1 back before it.
    """
    low, high = cos(cell.bearing - cell.half), cos(cell.bearing + cell.half)
    ahead = scene.alpha * max(pace * low, pace * high)
    return 2.0 * acos(min(max(ahead, -1.0), 1.0))


@njit(cache=True, nogil=True)
def apart_by(scene: Scene, cell: Cell, pace: float) -> float:
    """For how long no path that touches in a cell does so again, however it turns [R/V_P].

    Of all paths the one that turns toward the leader as fast as it can goes furthest in any
    direction to that side, as long as the direction is no more than π from its first heading and it
    has not turned so far itself. So it comes closest, as long as the leader lies in such a
    direction: until the leader is ahead, or so far behind.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        pace: +1 after the contact, −1 before it.

    Returns:
        0 if that is not known.
    """
    least, _ = slide_turns(scene, cell)
    if least <= 1.0 or cell.end == inf:
        return 0.0
    poses, alpha, d_min = poses_of(scene, cell), scene.alpha, scene.d_min
    rate = fastest_turn(scene, 0, len(scene.leader) - 1)
    left, fast = left_of_piece(scene, cell, pace), 1.0 + alpha
    took = min(growing_for(scene, cell, least - 1.0, rate), left)
    # how fast two paths of the cell part, seen from the leader
    parting = poses.differs + fast * (cell.half + rate * poses.span)
    for _ in range(_LOOKS):
        if not 0.0 < took < pi:
            break
        at = fly_piece(poses.middle, cell.side, pace * took)
        t = poses.t + pace * took
        there = leader_at(scene, piece_at(scene.leader, t), t)
        seen, far = _seen_along(at, there, pace), norm(at.x - there.x, at.y - there.y)
        toward, blur = cell.side * pace * seen[1], d_min * cell.half + parting * took
        beside = toward - blur - (_BESIDE if seen[0] > 0.0 else 0.0)
        behind = pi - atan2(toward, seen[0]) - took - poses.differs - blur / d_min
        if min(beside, behind) <= 0.0:
            break
        # any path that is outside stays so for this long, and one that turns toward the leader for
        # that, and others longer as long as the leader lies so
        step = (far - d_min - parting * took) / fast
        lies = min(beside / (3.0 + far + parting), behind / (2.0 + (fast + parting) / d_min), 0.5)
        if step < lies:
            closely = _outside_for(scene, cell, poses.span, rate, left, at, there, pace, took)
            step = max(step, min(closely, lies))
        if step < _STRIDE:
            break
        took += step
    return max(took, 0.0)


@njit(cache=True, nogil=True)
def away_for(scene: Scene, cell: Cell, pace: float, turn: float) -> float:
    """For how long no path that touches in a cell and turns away does so again in that turn [rad].

    The path from the middle of the cell is followed, by steps in which neither it nor any other may
    come back: d″ is no less than −(1 + α ω).

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        pace: +1 after the contact, −1 before it.
        turn: no more than this is asked for [rad].
    """
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return 0.0
    # contacts at any time from its start on are alike as long as the leader keeps straight
    rate, left = fastest_turn(scene, 0, len(scene.leader) - 1), left_of_piece(scene, cell, pace)
    turn = min(turn, left) if cell.end == inf else turn
    took = leaves_for(scene, cell, pace, turn)
    for _ in range(_LOOKS):
        if took <= 0.0 or took >= turn:
            break
        at = fly_piece(poses.middle, -cell.side, pace * took)
        t = poses.t + pace * took
        there = leader_at(scene, piece_at(scene.leader, t), t)
        step = _outside_for(scene, cell, poses.span, rate, left, at, there, pace, took)
        if step < _STRIDE:
            break
        took += step
    return min(took, turn)


@njit(cache=True, nogil=True)
def _outside_for(
    scene: Scene, cell: Cell, span: float, rate: float, left: float, at: Pose, there: Pose,
    pace: float, took: float,
) -> float:  # fmt: skip
    """For how much longer no path of a cell touches that turns as one in its middle does [R/V_P].

    By d and d′ of that path, and d″ being no less than −(1 + α ω); others differ by `parted_by`.

    Args:
        scene: as in `parted_by`.
        cell: likewise.
        span: likewise.
        rate: likewise.
        left: likewise.
        at: where the path from its middle is.
        there: and the leader.
        pace: as in `away_for`.
        took: since the contact [R/V_P].

    Returns:
        0 if less than `_STRIDE` is known.
    """
    falls = 1.0 + scene.alpha * rate
    dx, dy = at.x - there.x, at.y - there.y
    far = norm(dx, dy)
    s, c = sine_and_cosine(at.h)
    lead_s, lead_c = sine_and_cosine(there.h)
    closing = dx * (c - scene.alpha * lead_c) + dy * (s - scene.alpha * lead_s)
    gap, grows = far - scene.d_min, pace * closing / far
    step = (grows + sqrt(max(grows * grows + 2.0 * falls * max(gap, 0.0), 0.0))) / falls
    while step > _STRIDE:
        step *= 0.5
        astray, _ = parted_by(scene, cell, span, rate, left, pace, took + step)
        if min(gap, gap + step * (grows - 0.5 * falls * step)) > astray:
            return step
    return 0.0


@njit(cache=True, nogil=True)
def leaves_for(scene: Scene, cell: Cell, pace: float, turn: float) -> float:
    """For how long the separation surely grows after a contact of a cell, in a turn away [R/V_P].

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        pace: as in `away_for`.
        turn: no more than this is asked for [rad].
    """
    least, _ = slide_turns(scene, cell)
    if least <= -1.0:
        return 0.0
    rate = fastest_turn(scene, 0, len(scene.leader) - 1)
    growing = left_of_piece(scene, cell, pace)
    following = cell.piece + (1 if pace > 0.0 else -1)
    if growing < turn and 0 <= following < len(scene.leader):
        # the separation grows beyond the piece as well, if it does as the leader flies then
        then = Cell(following, cell.side, cell.bearing, cell.half, cell.start, cell.end)
        on = slide_turns(scene, then)[0]
        if on > -1.0:
            least = min(least, on)
            flown = piece_end(scene.leader, following) - scene.leader[following, 0]
            growing += flown if pace > 0.0 or following > 0 else inf
    return min(growing_for(scene, cell, least + 1.0, rate), growing)


@njit(cache=True, nogil=True)
def parted_by(
    scene: Scene, cell: Cell, span: float, rate: float, left: float, pace: float, took: float
) -> tuple[float, float]:
    """How much the separation may differ between contacts of a cell after a turn away so long.

    Seen from a leader that flies on as it does, neither d nor d′ differs at the contact, and d″ by
    no more than this for each bearing; and where it does not fly on so at the same time after each
    of them, its heading differs, by what it turns in the time between.

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        span: half of its window of time [R/V_P].
        rate: the leader's greatest turn rate [V_P/R].
        left: of `left_of_piece` [R/V_P].
        pace: as in `away_for`.
        took: how long [R/V_P].

    Returns:
        that [R], and how fast it grows [V_P].
    """
    fast, d_min = 1.0 + scene.alpha, scene.d_min
    # the heading at a contact changes by up to 2 with its bearing
    around = (d_min + 2.0 * took) / d_min
    bends = (8.0 * fast + 3.0 * fast * fast * around) / d_min
    bends += around * (1.0 + scene.alpha * rate) + 2.0
    grows = bends * cell.half * took
    parted = 0.5 * grows * took
    if took > left:
        t = 0.5 * (cell.start + cell.end) + pace * (span + took)
        pieces = abs(piece_at(scene.leader, max(t, 0.0)) - cell.piece)
        more = 2.0 * scene.alpha * rate * span * pieces
        parted += more * (took - left)
        grows += more
    return parted, grows


@njit(cache=True, nogil=True)
def growing_for(scene: Scene, cell: Cell, spare: float, rate: float) -> float:
    """For how long the separation surely grows, if k − 1 is no less than `spare` [R/V_P].

    Args:
        scene: the leader and d_min.
        cell: of contacts.
        spare: [V_P/R].
        rate: the leader's greatest turn rate [V_P/R].
    """
    alpha = scene.alpha
    ahead = max(abs(cos(cell.bearing - cell.half)), abs(cos(cell.bearing + cell.half)))
    parts = spare * sqrt(1.0 - alpha * ahead * alpha * ahead)
    return _PART * parts / jerk_of(scene, rate)


@njit(cache=True, nogil=True)
def jerk_of(scene: Scene, rate: float) -> float:
    """How fast d″ can change outside the disc, while neither aircraft changes how it turns.

    In V_P³/R². Arguments as `growing_for`.
    """
    alpha, d_min, fast = scene.alpha, scene.d_min, 1.0 + scene.alpha
    # it comes of the bearing's change, of the pursuer's turn and the leader's
    jerk = 1.0 + fast / d_min + alpha * rate * (rate + fast / d_min)
    return float(jerk + (2.0 * fast * (1.0 + alpha * rate) + 3.0 * fast**3 / d_min) / d_min)


@njit(cache=True, nogil=True)
def left_of_piece(scene: Scene, cell: Cell, pace: float) -> float:
    """How long the leader goes on as it does, from every contact of a cell on or back [R/V_P]."""
    if pace < 0.0:
        return cell.start - scene.leader[cell.piece, 0] if cell.piece > 0 else inf
    final = cell.piece + 1 == len(scene.leader)
    return inf if final else scene.leader[cell.piece + 1, 0] - cell.end


@njit(cache=True, nogil=True)
def _seen_along(at: Pose, there: Pose, pace: float) -> tuple[float, float]:
    """How far ahead and to the left something lies of a pose, or with pace −1 of its opposite."""
    dx, dy = pace * (there.x - at.x), pace * (there.y - at.y)
    s, c = sine_and_cosine(at.h)
    return dx * c + dy * s, dy * c - dx * s

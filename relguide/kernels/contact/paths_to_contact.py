"""Words to a contact with d = d_min, all of them, and times before which no path gets there.

A contact keeps its place relative to the leader, so while the leader keeps straight it is a slot
like any other; while it turns, see `paths_while_turning`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, sqrt

from numba import njit

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Contact, Pose, Scene, Velocity, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.contact.contact import contact_on, to_frame_of
from relguide.kernels.contact.moving_contact import earliest_while_turning, passage_to
from relguide.kernels.contact.paths_while_turning import paths_while_turning
from relguide.kernels.separation.clearance import piece_end
from relguide.kernels.words.extremals import ALL_WORDS, solve_words


@njit(cache=True, nogil=True)
def intercept(dx: float, dy: float, target: Velocity) -> float:
    """Least time to a moving point, now at (dx, dy), along a straight; 0 where unknown."""
    closing = dx * target.ahead + dy * target.left
    one_less = 1.0 - target.ahead * target.ahead - target.left * target.left
    if one_less <= 1e-9:
        return 0.0
    return float((closing + sqrt(closing * closing + one_less * (dx * dx + dy * dy))) / one_less)


@njit(cache=True, nogil=True)
def earliest_arrival(pose: Pose, t: float, scene: Scene, contact: Contact, beat: float) -> float:
    """No path from a pose at time t reaches the contact before this time.

    Infinite if none does while the leader is on the contact's piece and turns. Times from `beat` on
    do not matter, and any of them may come back [R/V_P].
    """
    start, rate = max(scene.leader[contact.piece, 0], t), scene.leader[contact.piece, 4]
    if rate != 0.0:
        return earliest_while_turning(passage_to(pose, t, scene, contact), beat)
    lh = scene.leader[contact.piece, 3]
    cx, cy, course = contact_on(scene, contact, t)
    s, c = sine_and_cosine(lh)
    toward = Velocity(scene.alpha * c, scene.alpha * s)
    straight = intercept(cx - pose.x, cy - pose.y, toward)
    return float(max(t + max(straight, abs(wrap_signed(course - pose.h))), start))


@njit(cache=True, nogil=True)
def not_before_slot(pose: Pose, t: float, scene: Scene) -> float:
    """No path from a pose at time t reaches the slot before this time."""
    straight = intercept(scene.alpha * t - pose.x, -pose.y, Velocity(scene.alpha, 0.0))
    return float(max(t + max(straight, abs(wrap_signed(pose.h))), scene.t_release))


@njit(cache=True, nogil=True)
def paths_to_contact(
    pose: Pose, t: float, scene: Scene, contact: Contact, beat: float, rows: FloatArray
) -> int:
    """All words from a pose at time t to a contact while the leader is on the contact's piece.

    Args:
        pose: where they begin.
        t: when [R/V_P].
        scene: what they have to reckon with, but for the limit.
        contact: where they lead.
        beat: those that arrive from this time on may be left out [R/V_P].
        rows: takes the words, with the time of arrival in place of how long they take; those of a
            straight piece come in order of time. shape (MAX_ROWS, 5)

    Returns:
        how many rows. Fewer if the time for the search is up.
    """
    return paths_by_words(pose, t, scene, contact, ALL_WORDS, 0.0, beat, rows)


@njit(cache=True, nogil=True)
def paths_by_words(
    pose: Pose, t: float, scene: Scene, contact: Contact, words: int, earliest: float, beat: float,
    rows: FloatArray,
) -> int:  # fmt: skip
    """As `paths_to_contact`, of a set of words as in `passing`.

    None of them may arrive before `earliest` [R/V_P]: 0, or what `earliest_arrival` says.
    """
    leader, i = scene.leader, contact.piece
    end = piece_end(leader, i)
    if end <= t or words == 0:
        return 0
    if leader[i, 4] != 0.0:
        passage = passage_to(pose, t, scene, contact)
        if earliest <= t:
            earliest = earliest_while_turning(passage, beat)
        return paths_while_turning(passage, words, earliest, beat, rows)
    lh = leader[i, 3]
    cx, cy, course = contact_on(scene, contact, t)
    left = end - t
    if left < inf:
        s, c = sine_and_cosine(lh)
        dx = cx + scene.alpha * left * c - pose.x
        if norm(dx, cy + scene.alpha * left * s - pose.y) > left:
            return 0  # not even straight there
    s, c = sine_and_cosine(lh - course)
    toward = Velocity(scene.alpha * c, scene.alpha * s)
    seen = to_frame_of(pose, Pose(cx, cy, course))
    seen, earliest = Pose(seen.x, seen.y, wrap(seen.h)), max(leader[i, 0] - t, 0.0)
    n = solve_words(seen, toward, words, Window(earliest, min(beat - t, left)), rows)
    while n > 0 and rows[n - 1, 0] > left:
        n -= 1
    rows[:n, 0] += t
    return n

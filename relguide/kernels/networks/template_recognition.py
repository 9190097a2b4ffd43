"""Which template a constrained path is of, and the guess that leads back to it.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import atan2, cos, hypot, inf, pi, sin

from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, WORD
from relguide.kernels.networks.near_guess import (
    LR,
    LS,
    ON_B,
    ON_B_TOUCH,
    ON_LR,
    ON_RL,
    ON_TOUCH_B,
    RL,
    from_leader,
    slot_of,
)
from relguide.kernels.networks.templates import FREE, NONE, SEVERAL, template_number
from relguide.kernels.words.branches import branch_of
from relguide.kernels.words.extremals import SIGNS, fly_piece

_NO_TURN = 1e-4  # pieces shorter than this end where two turns touch the disc by themselves
_ALMOST_NO_STRAIGHT = 3e-3  # the search ends here in such a contact: nothing is gained further on
_LOOKS = 64  # along a turn, for where it touches
_ALMOST = 0.02  # and before and behind a boundary arc, which is begun and ended a little aside


@njit(cache=True, nogil=True)
def template_of(start: Pose, scene: Scene, legs: FloatArray, guess: FloatArray) -> int:
    """The template of a path, and the guess that leads to it.

    Args:
        start: where the path begins.
        scene: a leader that keeps straight.
        legs: the path, as `chain.Chain`; no rows if there is none. shape (n, 6)
        guess: takes two numbers; 0 where the template needs none. shape (2,)

    Returns:
        its number in `templates.TEMPLATES`.
    """
    guess[:] = 0.0
    count = len(legs)
    if count == 0:
        return NONE
    if count == 1:
        return FREE
    if count == 2 and legs[1, 0] == WORD:
        return _through_contact(start, scene, legs, guess)
    if 3 <= count <= 4:
        if legs[1, 0] == BOUNDARY_ARC and (legs[0, 5] < _ALMOST or _is_of_two_turns(legs[0, 1:6])):
            return _from_boundary_arc(scene, legs, guess)
        if legs[count - 2, 0] == BOUNDARY_ARC:
            return _to_boundary_arc(start, scene, legs, guess)
    return SEVERAL


@njit(cache=True, nogil=True)
def _through_contact(start: Pose, scene: Scene, legs: FloatArray, guess: FloatArray) -> int:
    """Two words that meet in a contact."""
    bearing, side = _touch_in_last_turn(start, scene, legs[0, 1:6], False)
    entry, on = _entry_of_turns(legs[0, 1:6], guess), branch_of(legs[1, 1:6])
    if entry < LS:
        on = _onward_of_turns(legs[1, 1:6], guess)
        if on < ON_B:
            guess[0], guess[1] = cos(bearing), sin(bearing)
    return template_number(entry, side, on)


@njit(cache=True, nogil=True)
def _entry_of_turns(row: FloatArray, guess: FloatArray) -> int:
    """LR or RL if a first word is two turns that touch the disc by themselves; else its branch."""
    branch = branch_of(row)
    if _is_of_two_turns(row):
        _guess_turns(row[2], row[4], guess)
        return LR if branch == 2 else RL
    if branch >= 4 and row[4] < _NO_TURN:
        _guess_turns(row[2], row[3], guess)
        return LR if branch < 6 else RL
    if branch >= 4 and row[2] < _NO_TURN:
        _guess_turns(row[3], row[4], guess)
        return RL if branch < 6 else LR
    return branch


@njit(cache=True, nogil=True)
def _onward_of_turns(row: FloatArray, guess: FloatArray) -> int:
    """The same of a last word."""
    branch = branch_of(row)
    if branch >= 4 and row[2] < _NO_TURN:
        _guess_turns(row[3], row[4], guess)
        return ON_RL if branch < 6 else ON_LR
    if _is_of_two_turns(row):
        _guess_turns(row[2], row[4], guess)
        return ON_LR if branch == 2 else ON_RL
    return branch


@njit(cache=True, nogil=True)
def _is_of_two_turns(row: FloatArray) -> bool:
    """Whether a word is two turns, but for a straight between them that is hardly one."""
    return bool(2 <= branch_of(row) < 4 and row[3] < _ALMOST_NO_STRAIGHT)


@njit(cache=True, nogil=True)
def _guess_turns(first: float, second: float, guess: FloatArray) -> None:
    guess[0], guess[1] = first / pi - 1.0, second / pi - 1.0


@njit(cache=True, nogil=True)
def _from_boundary_arc(scene: Scene, legs: FloatArray, guess: FloatArray) -> int:
    """A path whose first word ends where it touches, and that slides on from there."""
    count = len(legs)
    row, last = legs[0, 1:6], legs[count - 1, 1:6]
    entry = branch_of(row)
    first_turn = 0 if SIGNS[int(row[1]), 0] > 0.0 else 1
    side = int(legs[1, 1])
    if _is_of_two_turns(row) and row[4] >= _ALMOST:
        if count == 3 and _straight_and_turn(last, side):
            _guess_turns(row[2], row[4], guess)
            return template_number(LR + first_turn, side, ON_B)
        return SEVERAL
    if count == 3 and _straight_and_turn(last, side):
        if entry < 4:
            return template_number(LS + first_turn, side, ON_B)
        _guess_turns(row[2], row[3], guess)
        return template_number(LR + first_turn, side, ON_B)
    same = 0.0 if side > 0 else 1.0  # the word of two turns to that side
    if count == 4 and entry < 4 and last[1] == same and legs[2, 0] == WORD:
        # bearing of the second contact: from where the last word begins
        bearing = _bearing_before(last, scene)
        guess[0], guess[1] = cos(bearing), sin(bearing)
        return template_number(LS + first_turn, side, ON_B_TOUCH)
    return SEVERAL


@njit(cache=True, nogil=True)
def _to_boundary_arc(start: Pose, scene: Scene, legs: FloatArray, guess: FloatArray) -> int:
    """A path that touches, and ends by a boundary arc, a straight and a turn.

    Its first word ends with the turn that touches, or the touch is a contact of its own.
    """
    count = len(legs)
    row, last = legs[0, 1:6], legs[count - 1, 1:6]
    side = int(legs[count - 2, 1])
    if not _straight_and_turn(last, side) or (count == 4 and legs[1, 0] == BOUNDARY_ARC):
        return SEVERAL
    bearing, _ = _touch_in_last_turn(start, scene, row, count == 3)
    guess[0], guess[1] = cos(bearing), sin(bearing)
    return template_number(branch_of(row), side, ON_TOUCH_B)


@njit(cache=True, nogil=True)
def _straight_and_turn(row: FloatArray, side: int) -> bool:
    """Whether a last word is a straight and a turn to the side of the boundary arc before it."""
    return bool(row[2] < _ALMOST and row[1] < 4.0 and SIGNS[int(row[1]), 2] == side)


@njit(cache=True, nogil=True)
def _bearing_before(row: FloatArray, scene: Scene) -> float:
    """The bearing of the contact where a last word begins: flown back from the slot."""
    pose = Pose(scene.alpha * row[0], 0.0, 0.0)
    for k in range(2, -1, -1):
        # backward a turn is one to the other side, of the opposite heading
        x, y, h = fly_piece(Pose(pose.x, pose.y, pose.h + pi), -SIGNS[int(row[1]), k], row[2 + k])
        pose = Pose(x, y, h - pi)
    return atan2(pose.y, pose.x - slot_of(scene))


@njit(cache=True, nogil=True)
def _touch_in_last_turn(
    start: Pose, scene: Scene, row: FloatArray, inside: bool
) -> tuple[float, int]:
    """Where a word touches the disc: at its end, or inside of its last turn. Bearing and side."""
    alpha, pose = scene.alpha, from_leader(start, scene)
    for k in range(2):
        pose = fly_piece(pose, SIGNS[int(row[1]), k], row[2 + k])
    pose = Pose(pose.x - alpha * (row[2] + row[3]), pose.y, pose.h)
    sign = SIGNS[int(row[1]), 2]
    best, bearing, side = inf, 0.0, 1
    # it ends there on a boundary arc: the last of the turn is left out of the search
    last = 0.9 * row[4] if inside else row[4]
    for k in range(_LOOKS + 1):
        turned = last * k / _LOOKS if inside else last
        x, y, h = fly_piece(pose, sign, turned)
        x -= alpha * turned
        if hypot(x, y) < best:
            best, bearing = hypot(x, y), atan2(y, x)
            side = 1 if x * sin(h) - y * (cos(h) - alpha) > 0.0 else -1
        if not inside:
            break
    return bearing, side

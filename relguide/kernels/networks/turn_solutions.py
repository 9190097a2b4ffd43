"""Constrained paths of a given template behind a leader who turns, solved next to a guess.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import atan2, inf, isnan

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import DELAY, WORD
from relguide.kernels.contact.clear_delay import delay_until_release
from relguide.kernels.contact.clear_words import best_word
from relguide.kernels.contact.contact import GRAZE, disc_on
from relguide.kernels.networks.near_guess import LS, ON_DELAY, ON_LR, ON_RL, Task, empty_room
from relguide.kernels.networks.paths_by_bearing import (
    begin_anew,
    delay_anew,
    delay_from,
    solve_next_to,
)
from relguide.kernels.networks.touch_before_slot import solve_before_touch
from relguide.kernels.networks.touch_from_start import solve_from_any_touch, solve_from_touch
from relguide.kernels.networks.turn_templates import (
    DELAYED,
    FREE,
    NONE,
    PARTS,
    QUARTER,
    SEVERAL,
    turn_template_of,
)
from relguide.kernels.networks.turning_leader import turning_scene
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import MAX_ROWS

_STRIDES = (0.01, 0.02, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.55, 0.7, 0.9, 1.2)
_BESIDE = np.array([0.0] + [sign * stride for stride in _STRIDES for sign in (1.0, -1.0)])
"""Where contacts are tried from which a path may arrive as the slot opens [rad]."""
_BESIDE_TOUCH = np.array((0.06, -0.06, 0.15, -0.15, 0.3, -0.3))
"""And guesses of two pieces from a contact to the slot [in their units]."""


@njit(cache=True, nogil=True)
def solve_turn_template(
    start: Pose, scene: Scene, template: int, guess: FloatArray, beat: float, anew: bool,
    legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The fastest path of a template next to a guess, if it keeps the limit.

    Args:
        start: slot frame, its heading in [0, 2π).
        scene: a leader that turns once, α below 1.
        template: number of `turn_templates.TEMPLATES`; neither `SEVERAL` nor `NONE`.
        guess: of its numbers. shape (GUESS,)
        beat: arrivals from here on do not matter [R/V_P].
        anew: whether it is looked farther away where there is none: in ten times the time.
        legs: takes the legs, as `chain.Chain`. shape (≥ 3, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; infinite and 0 if there is none.
    """
    eased = with_limit(scene, scene.d_min - GRAZE)
    if template == FREE:
        rows = np.empty((MAX_ROWS, 5))
        time, k = best_word(start, 0.0, eased, beat, rows)
        if k < 0:
            return inf, 0
        legs[0, 0] = WORD
        legs[0, 1:6] = rows[k]
        return time, 1
    if template == DELAYED:
        pieces = np.empty((DELAY_PIECES, 2))
        if scene.t_release >= beat or not delay_until_release(start, 0.0, eased, pieces):
            return inf, 0
        legs[0, 0] = DELAY
        return scene.t_release, 1
    entry, side, on = PARTS[template]
    disc = disc_on(scene, len(scene.leader) - 1, float(side))
    task = Task(start, eased, disc, int(entry), int(on))
    room = empty_room()
    room.about[0] = guess[2] / QUARTER
    if task.entry >= LS:
        time, count = solve_from_touch(task, guess, beat, room, legs)
        if count == 0 and anew:
            time, count = solve_from_any_touch(task, guess, beat, room, legs)
        return time, count
    if task.on == ON_LR or task.on == ON_RL:
        time, count = solve_before_touch(task, guess, beat, legs)
        if count == 0 and anew:
            trial = guess.copy()
            for beside in _BESIDE_TOUCH:
                for k in range(3):
                    trial[:] = guess
                    trial[k] += beside
                    found, n = solve_before_touch(task, trial, min(beat, time), legs)
                    if n > 0:
                        return found, n
        return time, count
    bearing = atan2(guess[1], guess[0])
    if task.on == ON_DELAY:
        if scene.t_release >= beat:
            return inf, 0
        for beside in _BESIDE:
            room.about[0] = guess[2] / QUARTER
            if delay_from(task, bearing + beside, room, legs):
                return scene.t_release, 2
        if anew and delay_anew(task, bearing, room, legs):
            return scene.t_release, 2
        return inf, 0
    time, count = solve_next_to(task, bearing, beat, room, legs)
    if count == 0 and anew:
        room.about[0] = guess[2] / QUARTER
        bearing = begin_anew(task, bearing, beat, room)
        if not isnan(bearing):
            time, count = solve_next_to(task, bearing, beat, room, legs)
    return time, count


@njit(cache=True, nogil=True)
def label_turn_templates(
    situations: FloatArray, times: FloatArray, counts: FloatArray, legs: FloatArray, within: float,
    templates: FloatArray, guesses: FloatArray,
) -> None:  # fmt: skip
    """What is to be learnt of exact answers: the template of each, if its guess leads back to it.

    Args:
        situations: as in `turning_leader`. shape (n, NUMBERS)
        times: of the answers [R/V_P]. shape (n,)
        counts: legs of each. shape (n,)
        legs: as `chain.Chain`, as many as there is room for. shape (n, ·, 6)
        within: a template whose path is this much later is not that of the answer [R/V_P].
        templates: takes their numbers. shape (n,)
        guesses: takes their guesses. shape (n, GUESS)
    """
    trial = np.zeros((3, 6))
    for n in range(len(situations)):
        start, scene = turning_scene(situations[n])
        count = int(counts[n])
        template = SEVERAL
        if count <= legs.shape[1]:
            template = turn_template_of(start, scene, legs[n, :count], guesses[n])
        if template != SEVERAL and template != NONE:
            time, _ = solve_turn_template(start, scene, template, guesses[n], inf, True, trial)
            if not time <= times[n] + within:
                template = SEVERAL
        templates[n] = template

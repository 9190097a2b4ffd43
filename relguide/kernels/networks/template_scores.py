"""A template network, evaluated for one situation, and decoded.

It gives a score for each template, by which templates are chosen, and its guess of a few numbers;
weights are float32, as they were trained. Guesses are worked out for the templates that are solved,
and no others. There are two networks: for a leader that keeps straight, where situations on the
right of the route are mirrored before, and the path after; and for one that turns to the left.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; a leader that keeps straight is
at (D/R, 0) at t = 0 and keeps heading 0.
"""

from math import exp, inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, straight_scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import MAX_CONTACTS
from relguide.kernels.contact.path_pieces import pieces_of
from relguide.kernels.networks.branch_scores import Layers, last_hidden_layer
from relguide.kernels.networks.network_view import Where, mirror_to_left
from relguide.kernels.networks.template_features import FEATURES, template_features
from relguide.kernels.networks.template_solutions import solve_template
from relguide.kernels.networks.templates import GUESS, NONE, SEVERAL, SIZE
from relguide.kernels.networks.turn_features import FEATURES as TURN_FEATURES
from relguide.kernels.networks.turn_features import turn_features
from relguide.kernels.networks.turn_solutions import solve_turn_template
from relguide.kernels.networks.turn_templates import GUESS as TURN_GUESS
from relguide.kernels.networks.turn_templates import SIZE as TURN_TEMPLATES
from relguide.kernels.networks.turning_leader import (
    BINDS,
    Bound,
    bound_without_limit,
    turning_scene,
)
from relguide.kernels.words.extremals import MAX_ROWS

Weights = tuple[FloatArray, ...]
"""The arrays of `Layers`, in that order."""
OUTPUTS = (1 + GUESS) * SIZE
"""Score of each template of leaders that keep straight, then its guess."""
LEGS = MAX_CONTACTS + 1
"""Room for the legs of a path, as the search has it."""
_BESIDE = 1e-9  # least heading that is looked at [rad]
_WORTH_ANEW = 0.02  # with this share, a template behind a leader that turns is solved from anywhere
_AS_FAST = 1e-9  # no path is sooner than without the limit: this one is the fastest [R/V_P]
_MOST_LATE = 9.5  # the limit costs more in 1 of 200 situations, and then the path is mostly wrong


class Decision(NamedTuple):
    """What of a network's answer is solved, and when nothing is."""

    least_share: float
    """Templates with a smaller share are left out."""
    most: int
    """With more templates than this, nothing is solved."""
    doubt: float
    """Nor is there an answer where the share of paths of other templates, of no path, and of
    templates likelier than the first that led to a path, is more."""


class Choice(NamedTuple):
    """Where a network's answer leads."""

    held: int
    """How many templates are held possible."""
    template: int
    """That of the path; `SEVERAL` or `NONE` if there is none."""
    time: float
    """Arrival [R/V_P]; infinite if there is none."""
    legs: int
    """How many legs the path has; 0 if there is none."""


@njit(cache=True, nogil=True)
def template_shares(
    pose: Pose, scene: Scene, free: FloatArray, layers: Layers, share: FloatArray
) -> FloatArray:
    """How likely the network takes each template to be that of the fastest path.

    Args:
        pose: the pursuer's, slot frame, not `needs_mirror`; its heading in [0, 2π).
        scene: a leader that keeps straight, α below 1.
        free: the fastest extremal without the limit, a row of `solve`. shape (5,)
        layers: the weights.
        share: takes the shares, which sum up to 1. shape (SIZE,)

    Returns:
        the layer before the outputs, for `guess_of`.
    """
    numbers = np.empty(FEATURES)
    # on the leader's own heading some features jump: labels lie on either side, and none there
    beside = Pose(pose.x, pose.y, max(pose.h, _BESIDE))
    template_features(beside, scene, free, numbers)
    return _shares_of(numbers, layers, share)


@njit(cache=True, nogil=True)
def turn_template_shares(
    pose: Pose, scene: Scene, numbers: FloatArray, bound: Bound, layers: Layers, share: FloatArray
) -> FloatArray:
    """As `template_shares`, behind a leader that turns.

    Args:
        pose: the pursuer's, its heading in [0, 2π).
        scene: of `turning_scene`.
        numbers: those of the situation, as in `turning_leader`. shape (NUMBERS,)
        bound: what is known without the limit.
        layers: the weights.
        share: takes the shares, which sum up to 1. shape (turn_templates.SIZE,)
    """
    given = np.zeros(TURN_FEATURES)
    if bound.found > 0:  # else it has learnt from zeros, and is not sure of anything
        turn_features(pose, scene, numbers, bound.rows, bound.found, bound.at_release, given)
    return _shares_of(given, layers, share)


@njit(cache=True, nogil=True)
def _shares_of(numbers: FloatArray, layers: Layers, share: FloatArray) -> FloatArray:
    """Shares of templates from the network's inputs; the layer before the outputs."""
    hidden, size = last_hidden_layer(numbers, layers), len(share)
    score = layers.last_bias[:size].copy()
    for i in range(len(hidden)):
        value = hidden[i]
        for template in range(size):
            score[template] += value * layers.last[i, template]
    most = score.max()
    for template in range(size):
        share[template] = exp(score[template] - most)
    share /= share.sum()
    return hidden


@njit(cache=True, nogil=True)
def guess_of(hidden: FloatArray, layers: Layers, template: int, guess: FloatArray) -> None:
    """The numbers of a template's guess, as in `templates` or in `turn_templates`."""
    count = len(guess)
    size = len(layers.last_bias) // (1 + count)
    for k in range(count):
        at = size + count * template + k
        value = layers.last_bias[at]
        for i in range(len(hidden)):
            value += hidden[i] * layers.last[i, at]
        guess[k] = value


@njit(cache=True, nogil=True)
def choose_template(
    pose: Pose, scene: Scene, free: FloatArray, layers: Layers, decision: Decision,
    legs: FloatArray,
) -> Choice:  # fmt: skip
    """Solve the templates that the network holds possible, next to its guesses, and no others.

    Args:
        pose: as in `template_shares`.
        scene: as there.
        free: as there; it breaks the limit: where that does not bind is not what was learnt.
        layers: the weights.
        decision: what is solved.
        legs: takes the legs of the fastest path, as `chain.Chain`. shape (LEGS, 6)
    """
    share = np.empty(SIZE)
    hidden = template_shares(pose, scene, free, layers, share)
    return _solve_possible(pose, scene, free[0], share, hidden, layers, decision, legs)


@njit(cache=True, nogil=True)
def choose_turn_template(
    pose: Pose, scene: Scene, numbers: FloatArray, bound: Bound, layers: Layers,
    decision: Decision, legs: FloatArray,
) -> Choice:  # fmt: skip
    """As `choose_template`, behind a leader that turns.

    Args:
        pose: as in `turn_template_shares`.
        scene: as there.
        numbers: as there.
        bound: as there; the limit binds.
        layers: the weights.
        decision: what is solved.
        legs: takes the legs of the fastest path, as `chain.Chain`. shape (LEGS, 6)
    """
    share = np.empty(TURN_TEMPLATES)
    hidden = turn_template_shares(pose, scene, numbers, bound, layers, share)
    return _solve_possible(pose, scene, bound.time, share, hidden, layers, decision, legs)


@njit(cache=True, nogil=True)
def _solve_possible(
    pose: Pose, scene: Scene, free: float, share: FloatArray, hidden: FloatArray, layers: Layers,
    decision: Decision, legs: FloatArray,
) -> Choice:  # fmt: skip
    """As `choose_template`, of templates with these shares; `free` is the time without the limit.

    No shares are left afterwards of what is solved.
    """
    turns, held = len(scene.leader) > 1, 0
    for template in range(len(share)):
        possible = share[template] >= decision.least_share
        held += possible and template != SEVERAL and template != NONE
    unknown = share[SEVERAL] + share[NONE]
    if held > decision.most or unknown > decision.doubt:
        return Choice(held, SEVERAL, inf, 0)
    guess = np.zeros(TURN_GUESS if turns else GUESS)
    trial = np.zeros((LEGS, 6))
    best, count, chosen = inf, 0, NONE
    for _ in range(held):
        # the likeliest first: once there is a path, the others are cheaper
        template = _likeliest(share)
        held_share = share[template]
        share[template] = 0.0
        guess_of(hidden, layers, template, guess)
        if turns:
            anew = held_share >= _WORTH_ANEW
            time, n = solve_turn_template(pose, scene, template, guess, best, anew, trial)
        else:
            time, n = solve_template(pose, scene, template, guess, best, trial)
        if n > 0:
            best, count, chosen = time, n, template
            legs[:n] = trial[:n]
        if best == inf:
            unknown += held_share
        if best <= free + _AS_FAST:
            return Choice(held, chosen, best, count)
    # templates without a path next to their guess were held possible in vain
    if unknown > decision.doubt or best > free + _MOST_LATE:
        return Choice(held, SEVERAL, inf, 0)
    return Choice(held, chosen, best, count)


@njit(cache=True, nogil=True)
def _likeliest(share: FloatArray) -> int:
    """The likeliest template that can be solved."""
    best = -1
    for template in range(len(share)):
        solvable = template != SEVERAL and template != NONE
        if solvable and (best < 0 or share[template] > share[best]):
            best = template
    return best


@njit(cache=True, nogil=True)
def constrained_pieces(
    where: Where, free: FloatArray, radius: float, longest: float, weights: Weights,
    decision: tuple[float, int, float],
) -> FloatArray:  # fmt: skip
    """The path of `choose_template` as pieces.

    Args:
        where: all are, as of `network_view`, on either side of the route.
        free: the fastest extremal without the limit, as of `network_view`. shape (5,)
        radius: R [m].
        longest: paths that take longer count as none [R/V_P].
        weights: those of `Layers`; a plain tuple is handed over in half the time.
        decision: the numbers of `Decision`.

    Returns:
        as `path_pieces.pieces_of`; no columns if there is no path. shape (3, pieces)
    """
    x, y, h, slot, alpha, d_min = where
    pose, mirrored = mirror_to_left(Pose(x, y, h))
    scene = straight_scene(alpha, slot, d_min)
    legs = np.zeros((LEGS, 6))
    chosen = choose_template(pose, scene, free, Layers(*weights), Decision(*decision), legs)
    if chosen.legs == 0 or chosen.time > longest:
        return np.empty((3, 0))
    sense = -1.0 if mirrored else 1.0
    return pieces_of(pose, scene, radius, sense, chosen.time, legs[: chosen.legs])


@njit(cache=True, nogil=True)
def constrained_turn_pieces(
    numbers: FloatArray, mirror: float, radius: float, longest: float, weights: Weights,
    decision: tuple[float, int, float],
) -> tuple[float, FloatArray]:  # fmt: skip
    """The path of `choose_turn_template` as pieces.

    Args:
        numbers: the situation, as in `turning_leader`. shape (NUMBERS,)
        mirror: +1, or −1 if the leader turns right, and they are those of the mirror image.
        radius: R [m].
        longest: paths that take longer count as none [R/V_P].
        weights: those of `Layers`.
        decision: the numbers of `Decision`.

    Returns:
        before when no path arrives, with or without the limit [R/V_P]; and the pieces as of
        `path_pieces.pieces_of`: no columns if there is no path, or where the limit does not bind.
    """
    pose, scene = turning_scene(numbers)
    none, rows = np.empty((3, 0)), np.empty((MAX_ROWS, 5))
    bound = bound_without_limit(pose, scene, rows)
    if bound.limit != BINDS:
        return bound.time, none
    legs = np.zeros((LEGS, 6))
    chosen = choose_turn_template(
        pose, scene, numbers, bound, Layers(*weights), Decision(*decision), legs
    )
    if chosen.legs == 0 or chosen.time > longest:
        return bound.time, none
    pieces = pieces_of(pose, scene, radius, mirror, chosen.time, legs[: chosen.legs])
    return bound.time, pieces

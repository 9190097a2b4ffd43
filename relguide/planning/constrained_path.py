"""constrained_path(candidates): the fastest path that touches d_min, or slides along it."""

import numpy as np

from relguide.kernels.contact.any_path import any_path
from relguide.kernels.contact.chain import MAX_LEGS
from relguide.kernels.contact.constrained_search import (
    best_constrained_path,
    ease_to_start,
)
from relguide.kernels.contact.path_pieces import pieces_of
from relguide.kernels.contact.tangent import tangents
from relguide.planning.candidate import (
    SIGN_ROWS,
    Candidate,
    assemble,
    candidate_of,
    segments_of_pieces,
)
from relguide.planning.tables import scene_of
from relguide.planning.words import HORIZON, Candidates
from relguide.units import Second

BEARINGS = 60
"""How finely the disc is scanned round a leader that keeps straight: every 6°."""
TURNING_BEARINGS = 72
"""Round one that turns: every 5°, since contacts must fall into the time of one piece."""
_HARDER = 5
"""So many times the bearings round a leader that keeps straight, where nothing is found at first:
one as fast as the pursuer is met in windows narrower than 6°."""


def constrained_path(found: Candidates, *, beat: Second) -> Candidate | None:
    """The fastest path through contacts with d = d_min, if it arrives before `beat` [s].

    Up to the first contact, between contacts and from the last one on, the path is an extremal
    without the limit, from the same complete enumeration of words, or it slides along d_min. The
    contacts' bearings are searched round the leader, for each piece of its intent and both sides.
    If there is none, and nothing to beat, any path that begins with a turn and a straight will do.
    """
    situation, frame = found.situation, found.frame
    if situation.min_separation <= 0.0:
        return None
    scale = frame.radius / situation.pursuer.tas
    start = frame.pose
    scene = ease_to_start(start, scene_of(situation, frame))
    keeps_straight = len(scene.leader) == 1
    bearings = BEARINGS if keeps_straight else TURNING_BEARINGS
    legs, row = np.zeros((MAX_LEGS, 6)), np.zeros(5)
    near = tangents(start, scene)
    time, count = best_constrained_path(start, scene, bearings, near, beat / scale, legs)
    if count == 0 and beat >= HORIZON and keeps_straight:
        bearings *= _HARDER
        time, count = best_constrained_path(start, scene, bearings, near, beat / scale, legs)
    if count > 0:
        pieces = pieces_of(start, scene, frame.radius, 1.0, time, legs[:count])
        if pieces.shape[1] > 0:
            return candidate_of(situation.pursuer, segments_of_pieces(frame.radius, pieces))
    if beat < HORIZON:
        return None
    time, sign, turned, straight = any_path(start, scene, beat / scale, row)
    if time >= beat / scale:
        return None
    signs = [sign, 0.0, *SIGN_ROWS[int(row[1])]]
    return assemble(situation, frame, signs, [turned, straight, *row[2:].tolist()], "")

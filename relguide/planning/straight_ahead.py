"""first_candidate(situation): the fastest path to the slot, where the leader keeps straight.

Without an intent the slot is open from the start, and the fastest extremal is the plan wherever it
keeps d_min, as it does in nine situations of ten. So it is tried alone; `candidates` lists all.
"""

from relguide.kernels.words import straight_leader as kernel
from relguide.kernels.words.extremals import WORDS
from relguide.planning.candidate import SIGN_ROWS, Candidate, candidate_of, segments_of
from relguide.planning.situation import Situation
from relguide.planning.words import HORIZON
from relguide.units import Metre


def first_candidate(situation: Situation, radius: Metre) -> tuple[Candidate, float] | None:
    """The first of `candidates(situation)`, and how soon it arrives [s].

    Args:
        situation: what is to be planned.
        radius: R, which callers have at hand [m].

    Returns:
        `None` where the leader has an intent, and where there is no path within the horizon.
    """
    pursuer, leader, wind = situation.pursuer, situation.leader, situation.wind
    if leader.intent:
        return None
    arrival, word, *amounts = kernel.fastest_to_slot(
        pursuer.x, pursuer.y, pursuer.heading, pursuer.tas, radius,
        leader.x, leader.y, leader.heading, leader.tas,
        situation.slot_distance, wind.east, wind.north,
    )  # fmt: skip
    time = arrival * radius / pursuer.tas
    if time > HORIZON:
        return None
    segments = segments_of(radius, SIGN_ROWS[word], amounts)
    return candidate_of(pursuer, segments, WORDS[word]), time

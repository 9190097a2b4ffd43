"""Behind leaders who turn, where the limit binds: paths that a search of the disc once missed."""

from math import hypot

import numpy as np
import pytest

from benchmarks import draws, proofs
from relguide import (
    LEFT,
    RIGHT,
    FlyStraight,
    Leader,
    Plan,
    Pursuer,
    Situation,
    TurnTo,
    Wind,
    candidates,
    plan,
)
from relguide.kernels.contact.boundary_arc import (
    MAX_NODES,
    boundary_arc_arrival,
    boundary_arc_pieces,
)
from relguide.kernels.contact.chain import BOUNDARY_ARC
from relguide.kernels.contact.contact import GRAZE, contact_at
from relguide.kernels.separation.clearance import fly_rate, piece_clears
from relguide.planning.tables import scene_of


def limit_case(seed: int, case: int, *, tight: bool, slot_at_limit: bool) -> Situation:
    """As `benchmarks.limit` draws it, once it is known what kind it is to be."""
    rng = np.random.default_rng([seed, case])
    rng.random(1 + slot_at_limit)  # which kind it is
    return draws.active(rng, tight=tight, intent=True, slot_at_limit=slot_at_limit)


def sound_plan(situation: Situation) -> Plan:
    """Its plan, which keeps d_min and arrives."""
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.certificate.holds
    assert answer.arrival.holds
    return answer


@pytest.mark.parametrize(("case", "slot_at_limit"), [(94, True), (212, False)])
def test_the_slot_is_waited_for_from_the_contact_that_the_wait_was_found_for(
    case: int, slot_at_limit: bool
) -> None:
    """While the leader turns, the wait may begin at a later path to the contact than the earliest.

    What was flown was the earliest, no wait was found from there, and the plan came 46 s and 22 s
    later.
    """
    rng = np.random.default_rng([777, case])
    situation = draws.active(rng, tight=True, intent=True, slot_at_limit=slot_at_limit)
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.optimality.proof == "relaxation"
    assert answer.certificate.holds
    assert answer.arrival.holds


@pytest.mark.parametrize(("case", "best"), [(86, 492.998), (34, 377.81)])
def test_round_a_leader_who_turns_with_a_slot_at_the_limit_narrow_windows_are_searched(
    case: int, best: float
) -> None:
    """With half the bearings they came 135 s and 10 s later."""
    rng = np.random.default_rng([777, case])
    situation = draws.active(rng, tight=True, intent=True, slot_at_limit=True)
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.time_to_converge < best + 0.01


BEHIND_TURNS = (
    (
        Situation(
            pursuer=Pursuer(
                x=0.0, y=0.0, heading=4.34571206841025, tas=241.04196093889954,
                max_bank=0.3674458466660752,
            ),
            leader=Leader(
                x=-41_872.08835332739, y=47_097.954555520584, heading=1.8023260507096657,
                tas=207.66135829002053,
                intent=(
                    FlyStraight(duration=32.94053620109171),
                    TurnTo(heading=3.4860417234537806, turn=RIGHT, bank=0.40897735006415353),
                    FlyStraight(duration=95.55064115785514),
                    TurnTo(heading=0.7759944676968817, turn=RIGHT, bank=0.3411091037205833),
                ),
            ),
            slot_distance=56_309.244026398825,
            min_separation=54_896.88342595833,
            wind=Wind(east=32.612681586135395, north=15.979047468656772),
        ),
        656.378,
    ),
    (
        Situation(
            pursuer=Pursuer(
                x=0.0, y=0.0, heading=0.4194349037400808, tas=200.10099243328776,
                max_bank=0.5105160761794332,
            ),
            leader=Leader(
                x=-23_317.956723638228, y=13_434.85317022307, heading=0.9287222656243013,
                tas=123.59661314118085,
                intent=(
                    FlyStraight(duration=29.939066971509764),
                    TurnTo(heading=5.12741017860453, turn=RIGHT, bank=0.3380396935639912),
                    FlyStraight(duration=11.952859804729336),
                    TurnTo(heading=1.1398331640294928, turn=RIGHT, bank=0.29130593377044267),
                ),
            ),
            slot_distance=33_447.0085481179,
            min_separation=26_183.183948430888,
        ),
        559.534,
    ),
)  # fmt: skip
"""With what the release leaves of the time: a few contacts followed to others were not enough."""


@pytest.mark.parametrize(("situation", "best"), BEHIND_TURNS)
def test_many_contacts_are_followed_to_others_before_a_late_plan_is_taken(
    situation: Situation, best: float
) -> None:
    answer = sound_plan(situation)
    assert answer.time_to_converge == pytest.approx(best, abs=0.1)


AS_THE_SLOT_OPENS = (
    (
        Situation(
            pursuer=Pursuer(
                x=0.0, y=0.0, heading=4.204439536490956, tas=211.78536385005845,
                max_bank=0.4352481114058087,
            ),
            leader=Leader(
                x=3152.6392099269146, y=43096.8040783129, heading=3.7132924216689145,
                tas=172.41728967968413,
                intent=(
                    FlyStraight(duration=1.160891037450682),
                    TurnTo(heading=3.2738549205789855, turn=RIGHT, bank=0.3643791402111452),
                ),
            ),
            slot_distance=57922.62964034335,
            min_separation=33307.36103917722,
            wind=Wind(east=3.6144773583900256, north=-48.876231970546044),
        ),
        533.084,
    ),
    (
        Situation(
            pursuer=Pursuer(
                x=0.0, y=0.0, heading=0.42722652353833934, tas=108.37244640926926,
                max_bank=0.5509770621610438,
            ),
            leader=Leader(
                x=6248.009320610083, y=6017.837684486654, heading=6.122723120675862,
                tas=87.97747145238611,
                intent=(
                    FlyStraight(duration=134.68706428918208),
                    TurnTo(heading=0.0263175545159503, turn=RIGHT, bank=0.33464164680217307),
                    FlyStraight(duration=78.26976271154098),
                    TurnTo(heading=3.2370965416224338, turn=LEFT, bank=0.39140312073513467),
                ),
            ),
            slot_distance=6528.745860717663,
            min_separation=6389.225004344375,
            wind=Wind(east=-13.328770311550683, north=-11.706019355386017),
        ),
        348.804,
    ),
)  # fmt: skip


@pytest.mark.parametrize(("situation", "release"), AS_THE_SLOT_OPENS)
def test_a_delay_is_looked_for_before_a_boundary_arc_and_after_one_that_turns_back(
    situation: Situation, release: float
) -> None:
    """The slot opens as a root arrives; the contact is at the end of a turn. 19 s and 2.5 s late.

    In the first a boundary arc came to the contact sooner, from where nothing delays clear of the
    leader. In the second the boundary arc turns back as the leader begins to turn, and was flown
    only to where it first had the bearing of its end.
    """
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.optimality.proof == "relaxation"
    assert answer.time_to_converge == pytest.approx(release, abs=1e-3)
    assert answer.certificate.holds
    assert answer.arrival.holds


@pytest.mark.parametrize(
    ("seed", "case", "slot_at_limit", "best"),
    [(1302, 28, True, 307.729), (1303, 58, False, 701.260)],
)
def test_a_boundary_arc_goes_on_through_the_turn_that_turns_it_back(
    seed: int, case: int, slot_at_limit: bool, best: float
) -> None:
    """They came 197 s and 392 s late."""
    situation = limit_case(seed, case, tight=True, slot_at_limit=slot_at_limit)
    answer = sound_plan(situation)
    assert answer.time_to_converge == pytest.approx(best, abs=1e-2)


@pytest.mark.parametrize(
    ("seed", "case", "slot_at_limit", "best"),
    [(1302, 3, True, 190.067), (1303, 173, False, 402.821), (1304, 203, True, 407.257)],
)
def test_where_few_contacts_may_still_matter_it_is_looked_closer(
    seed: int, case: int, slot_at_limit: bool, best: float
) -> None:
    """Between two bearings of the grid there was a window: 1.3 s, 2.9 s and 0.7 s late."""
    situation = limit_case(seed, case, tight=case % 2 == 0, slot_at_limit=slot_at_limit)
    answer = plan(situation)
    assert isinstance(answer, Plan)
    assert answer.certificate.holds
    assert answer.time_to_converge == pytest.approx(best, abs=1e-2)


def test_a_boundary_arc_that_ends_in_a_window_of_one_degree_is_found() -> None:
    """IPOPT found this path, 3.0 s faster than the plan."""
    rng = np.random.default_rng([2026, 15])
    _, calm = rng.random(2)  # as `benchmarks.duel` draws whether the leader turns, and the wind
    answer = plan(draws.active(rng, tight=False, intent=True, calm=calm < 0.5))
    assert isinstance(answer, Plan)
    assert answer.certificate.holds
    assert answer.time_to_converge == pytest.approx(278.804, abs=1e-2)


def test_a_word_that_exists_for_a_moment_is_found() -> None:
    """IPOPT found this path, 12.8 s faster: its circles were near enough between two looks only."""
    rng = np.random.default_rng([2041, 145])
    _, calm = rng.random(2)  # as `benchmarks.duel` draws whether the leader turns, and the wind
    answer = plan(draws.active(rng, tight=False, intent=True, calm=calm < 0.5))
    assert isinstance(answer, Plan)
    assert answer.certificate.holds
    assert answer.time_to_converge == pytest.approx(180.014, abs=1e-2)


@pytest.mark.parametrize(
    ("seed", "case", "slot_at_limit", "best"),
    [
        (1304, 6, True, 362.63),
        (1304, 108, True, 706.45),
        (1305, 360, False, 381.85),
        (1601, 54, True, 397.33),
    ],
)
def test_the_best_chain_slides_where_the_graph_of_contacts_hops(
    seed: int, case: int, slot_at_limit: bool, best: float
) -> None:
    """They came 3.2 s, 34.0 s, 4.4 s and 4.6 s later."""
    answer = sound_plan(limit_case(seed, case, tight=True, slot_at_limit=slot_at_limit))
    assert answer.time_to_converge < best


@pytest.mark.parametrize(
    ("seed", "case", "slot_at_limit", "best"),
    [
        (1402, 452, True, 706.6),
        (1403, 510, False, 391.1),
        (1304, 8, True, 186.85),
        (1305, 138, False, 369.33),
        (1402, 484, True, 596.37),
    ],
)
def test_the_best_chain_is_begun_again_from_nearby(
    seed: int, case: int, slot_at_limit: bool, best: float
) -> None:
    """They came 22.9 s, 9.3 s, 7.8 s, 1.1 s and 0.2 s later: stuck at cliffs of the arrival."""
    rng = np.random.default_rng([seed, case])
    rng.random(1 + slot_at_limit)  # as `benchmarks.limit` draws what kind it is
    tight = case % 2 == 0
    answer = sound_plan(draws.active(rng, tight=tight, intent=True, slot_at_limit=slot_at_limit))
    assert answer.time_to_converge < best


def test_a_basin_that_ends_in_a_jump_is_descended() -> None:
    """The word that led to it ended between two bearings, both with an arrival: 0.67 s later."""
    answer = plan(limit_case(1601, 39, tight=False, slot_at_limit=True))
    assert isinstance(answer, Plan)
    assert answer.time_to_converge == pytest.approx(254.862, abs=1e-2)


@pytest.mark.parametrize("case", [346, 626])
def test_a_delay_may_begin_at_the_last_path_to_a_contact(case: int) -> None:
    """They came 181 s and 6.9 s late; the first was found, and not flown: early by rounding."""
    answer = sound_plan(limit_case(1304, case, tight=True, slot_at_limit=True))
    assert answer.optimality.proof == "relaxation"


@pytest.mark.parametrize(
    ("seed", "case", "tight", "best"),
    [
        (1304, 257, False, 314.43),
        (1304, 188, True, 698.51),
        (1402, 192, True, 283.86),
        (1302, 282, True, 301.23),
    ],
)
def test_round_a_leader_who_turns_the_earliest_at_a_contact_need_not_be_the_best(
    seed: int, case: int, tight: bool, best: float
) -> None:
    """With one label a contact they came 73 s, 32 s, 5.3 s and 4.9 s late."""
    answer = sound_plan(limit_case(seed, case, tight=tight, slot_at_limit=True))
    assert answer.time_to_converge < best + 0.01


@pytest.mark.parametrize(
    ("kind", "case", "best"), [("turning, calm", 58, 508.63), ("turning, in wind", 56, 259.32)]
)
def test_where_the_leader_turns_faster_than_one_slides_a_later_word_may_be_ahead(
    kind: str, case: int, best: float
) -> None:
    """By the soonest word to each contact they came 6.0 s and 0.8 s later."""
    rng = np.random.default_rng([105, proofs.KINDS.index(kind), case])
    answer = sound_plan(proofs.draw(kind, rng, case))
    assert answer.time_to_converge < best


@pytest.mark.parametrize(
    ("slot_at_limit", "case", "best"), [(True, 452, 706.57), (False, 510, 385.96)]
)
def test_a_late_word_leads_to_a_boundary_arc(slot_at_limit: bool, case: int, best: float) -> None:
    """The search with twenty times the effort and by the soonest words: 20 s and 5.2 s later."""
    situation = limit_case(
        1402 if slot_at_limit else 1403, case, tight=True, slot_at_limit=slot_at_limit
    )
    answer = sound_plan(situation)
    assert answer.time_to_converge < best


def test_a_long_boundary_arc_is_flown_along_the_limit_and_in_the_time_it_should_take() -> None:
    """In equal steps of bearing, of which some take far longer than others, it strayed by 4 cm."""
    situation = limit_case(1402, 421, tight=False, slot_at_limit=True)
    frame = candidates(situation).frame
    scene = scene_of(situation, frame)
    leg = np.array([BOUNDARY_ARC, -1.0, 1.28092936, 3.46482569, 1.0, 0.0])
    begun = 2.24164322
    pieces = np.empty((2 * MAX_NODES, 2))
    pose = contact_at(scene, begun, leg[2], leg[1])
    n, end, ended = boundary_arc_pieces(pose, begun, begun, scene, leg, pieces)
    assert ended == pytest.approx(
        boundary_arc_arrival(scene, begun, leg[2], leg[3], leg[1], 1), abs=3e-7
    )
    there = contact_at(scene, ended, leg[3], leg[1])
    assert hypot(end.x - there.x, end.y - there.y) < 1e-6
    t, eased = begun, scene._replace(d_min=scene.d_min - GRAZE)
    for duration, rate in pieces[:n]:
        assert piece_clears(pose, rate, t, duration, eased)
        pose = fly_rate(pose, rate, duration)
        t += duration

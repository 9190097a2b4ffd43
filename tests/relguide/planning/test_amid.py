"""Plans amid others: clear of all, alike however seen, no slower than a plain search."""

import heapq
from dataclasses import replace
from itertools import count
from math import cos, inf, pi, sin

import numpy as np
import pytest

from relguide import (
    Cell,
    Disc,
    NoPlan,
    Plan,
    Situation,
    Traffic,
    certify,
    plan,
)
from relguide.kernels.base.records import Pose
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve
from relguide.planning.optimality import check
from relguide.planning.outcome import Reason
from relguide.planning.plan import _remedies, plan_at_once
from relguide.planning.prove import prove
from relguide.planning.slot import slot_frame
from tests.skies import LIMIT, any_sky, blocked, crossing, margins, mirrored, moved

ROUNDING = 0.02
"""A certified path may come so much nearer than it should [m]: 1e-6 R."""


def planned(situation: Situation) -> Plan:
    answer = plan(situation)
    assert isinstance(answer, Plan), answer
    return answer


def test_what_is_far_away_changes_nothing() -> None:
    alone = planned(blocked())
    far = planned(blocked(crossing(x=-400e3)))
    assert far.trajectory == alone.trajectory
    assert far.optimality == alone.optimality
    assert far.situation.others != ()
    assert [other.ident for other in far.certificate.others] == ["CROSSING"]


@pytest.mark.parametrize("seed", range(8))
def test_the_leader_given_as_traffic_too_changes_nothing(seed: int) -> None:
    situation = any_sky(np.random.default_rng(seed), 0)
    leader = situation.leader
    again = Traffic(
        ident="AGAIN", x=leader.x, y=leader.y, heading=leader.heading, tas=leader.tas,
        min_separation=situation.min_separation, intent=leader.intent,
    )  # fmt: skip
    twice = replace(situation, others=(again,))
    assert planned(twice).trajectory == planned(situation).trajectory


def test_a_path_round_traffic_touches_it_and_is_told_with_its_bound() -> None:
    alone, round_it = planned(blocked()), planned(blocked(crossing()))
    assert not certify(alone.trajectory, round_it.situation).holds
    assert 1.0 < round_it.time_to_converge - alone.time_to_converge < 60.0
    assert round_it.optimality.proof == "bound"
    assert round_it.optimality.lower_bound == pytest.approx(alone.time_to_converge)
    (other,) = round_it.certificate.others
    assert other.least_separation == pytest.approx(LIMIT, abs=1.0)
    assert plan_at_once(round_it.situation) is None


@pytest.mark.parametrize("seed", range(25))
def test_no_plan_comes_too_close_to_any_at_10_hz(seed: int) -> None:
    rng = np.random.default_rng(seed)
    answer = plan(any_sky(rng, int(rng.integers(2, 12))))
    if isinstance(answer, NoPlan):
        assert answer.reason in (Reason.TRAFFIC, Reason.SEPARATION_UNAVOIDABLE)
        return
    assert answer.certificate.holds
    assert answer.arrival.holds
    found = margins(answer.trajectory, answer.situation)
    told = {other.ident: other for other in answer.certificate.others}
    for ident, margin in found.items():
        assert margin >= -ROUNDING, (ident, answer.situation)
        if ident:
            assert margin >= told[ident].lower_bound - told[ident].min_separation - 1e-6


@pytest.mark.parametrize("seed", range(12))
def test_mirrored_moved_and_turned_skies_are_planned_alike(seed: int) -> None:
    situation = any_sky(np.random.default_rng(seed), 8, cells=False, turns=False)
    situation = replace(situation, wind=type(situation.wind)(east=0.0, north=0.0))
    answer = plan(situation)
    for seen in (mirrored(situation), moved(situation, 30e3, -20e3, 1.0)):
        other = plan(seen)
        assert type(other) is type(answer)
        if isinstance(answer, Plan) and isinstance(other, Plan):
            # descents end within a few hundredths of a second of where they lead
            assert other.time_to_converge == pytest.approx(answer.time_to_converge, abs=0.3)


def test_height_that_is_certain_takes_traffic_out_of_the_way() -> None:
    situation = blocked(crossing(altitude=9_000.0))
    above = replace(
        situation,
        pursuer=replace(situation.pursuer, altitude=9_400.0),
        leader=replace(situation.leader, altitude=9_400.0),
    )
    assert planned(above).trajectory == planned(blocked()).trajectory
    assert planned(situation).time_to_converge > planned(above).time_to_converge + 1.0


def test_the_slot_must_stay_clear_after_joining() -> None:
    """A path that arrives clear, and two minutes before traffic crosses the slot, is none."""
    alone = planned(blocked())
    time = alone.time_to_converge
    # it crosses the slot's place a minute after the pursuer would have joined
    later = crossing(x=-200.0 * (time + 60.0), y=200.0 * (time + 60.0) - 12e3)
    round_it = planned(blocked(later))
    assert margins(alone.trajectory, round_it.situation, step=1.0)["CROSSING"] < 0.0
    assert round_it.time_to_converge > time + 10.0


def test_too_close_already_names_whom() -> None:
    answer = plan(blocked(crossing("BAW12", x=3e3, y=-60e3)))
    assert isinstance(answer, NoPlan)
    assert answer.reason == Reason.SEPARATION_ALREADY_LOST
    assert "1.62 NM from BAW12" in answer.message
    assert answer.conflict is not None
    assert (answer.conflict.ident, answer.conflict.at_time) == ("BAW12", 0.0)
    inside = plan(blocked(Cell(ident="STORM", shape=Disc(x=0.0, y=-60e3, radius=2e3))))
    assert isinstance(inside, NoPlan)
    assert "inside STORM" in inside.message


def test_where_none_is_found_the_answer_names_whom_and_what_helps() -> None:
    in_slot = crossing("BAW12", x=0.0, y=-12e3, heading=0.0, min_separation=3e3)
    situation = blocked(in_slot)
    answer = plan(situation)
    assert isinstance(answer, NoPlan)
    assert answer.reason == Reason.TRAFFIC
    assert answer.conflict is not None
    assert answer.conflict.ident == "BAW12"
    assert answer.conflict.min_separation == 3e3
    assert answer.conflict.least_separation < 1.0
    assert answer.lower_bound == pytest.approx(planned(blocked()).time_to_converge)
    assert answer.message.startswith(
        "No path to the slot was found that keeps clear of all: the best one comes within 0"
    )
    assert "of BAW12 at " in answer.message
    assert "1.62 NM is to be kept. 8.48 NM behind the leader there is a plan" in answer.message
    (remedy,) = answer.remedies
    assert remedy.kind == "slot_distance"
    helped = planned(replace(situation, slot_distance=remedy.value))
    assert helped.time_to_converge == remedy.time_to_converge


def test_a_level_that_helps_is_flown_until_just_before_joining() -> None:
    situation = blocked(crossing(altitude=9_000.0))
    situation = replace(
        situation,
        pursuer=replace(situation.pursuer, altitude=9_000.0),
        leader=replace(situation.leader, altitude=9_000.0),
    )
    bound = planned(blocked()).time_to_converge
    unable = NoPlan(reason=Reason.TRAFFIC, message="", lower_bound=bound)
    remedy = {one.kind: one for one in _remedies(unable, situation, inf)}["level"]
    assert remedy.value == pytest.approx(9_304.8)
    assert remedy.time_to_converge == pytest.approx(bound)
    assert remedy.message == f"At 30,528 ft until it joins there is a plan of {bound:.0f} s."


def test_with_no_time_at_all_the_reason_is_the_deadline() -> None:
    plan(blocked(crossing()), deadline=1.0)
    answer = plan(blocked(crossing()), deadline=0.0)
    assert isinstance(answer, NoPlan)
    assert answer.reason == Reason.DEADLINE
    assert plan(blocked(crossing()), deadline=60.0) == plan(blocked(crossing()))


def test_a_proof_amid_others_rests_on_the_leader_alone() -> None:
    round_it = planned(blocked(crossing()))
    proved = prove(round_it, seconds=0.2)
    assert proved.trajectory == round_it.trajectory
    assert proved.optimality.proof == "bound"
    assert proved.optimality.lower_bound == pytest.approx(round_it.optimality.lower_bound)


def test_contacts_with_traffic_are_told_with_whom() -> None:
    round_it = planned(blocked(crossing()))
    contacts = check(round_it, round_it.situation).contacts
    assert [contact.ident for contact in contacts] == ["CROSSING"]
    assert contacts[0].jump > 0.0


# -------------------------------------------------------------------------------------------------


def lattice_search(situation: Situation, step: float, most: int) -> float:
    """Soonest arrival by turns and straights of one length, and then any word: best first.

    Others at rest, calm. Clearance is sampled. Each place, heading and time is looked at once, in
    cells half a step wide.
    """
    frame = slot_frame(situation, situation.leader.trajectory)
    scale = frame.radius / situation.pursuer.tas
    discs = []
    for other in situation.others:
        assert isinstance(other, Cell)
        assert isinstance(other.shape, Disc)
        discs.append((*frame.to_slot(other.shape.x, other.shape.y), other.shape.radius))
    centres = np.array([(x, y) for x, y, _ in discs])
    radii = np.array([size for _, _, size in discs]) / frame.radius
    ahead = situation.slot_distance / frame.radius
    limit = situation.min_separation / frame.radius

    def clear(pose: Pose, sign: float, amount: float, t: float) -> bool:
        flown = np.linspace(0.0, amount, max(int(amount / 0.02), 2))
        if sign == 0.0:
            x, y = pose.x + flown * cos(pose.h), pose.y + flown * sin(pose.h)
        else:
            x = pose.x + sign * (np.sin(pose.h + sign * flown) - sin(pose.h))
            y = pose.y - sign * (np.cos(pose.h + sign * flown) - cos(pose.h))
        far = np.hypot(x[:, None] - centres[:, 0], y[:, None] - centres[:, 1]) - radii
        led = np.hypot(x - ahead - frame.alpha * (t + flown), y)
        return bool(far.min() >= 0.0 and led.min() >= limit)

    rows, number, best = np.empty((MAX_ROWS, 5)), count(), inf
    open_list: list[tuple[float, int, Pose, float]] = [(0.0, 0, frame.pose, 0.0)]
    seen: set[tuple[int, ...]] = set()
    looked = 0
    while open_list and looked < most:
        bound, _, pose, t = heapq.heappop(open_list)
        if bound >= best:
            break
        looked += 1
        n = solve(Pose(pose.x - frame.alpha * t, pose.y, pose.h % (2 * pi)), frame.alpha, 0.0, rows)
        for row in rows[:n].copy():
            if t + row[0] >= best:
                break
            here, now, holds = pose, t, True
            for sign, amount in zip(SIGNS[int(row[1])].tolist(), row[2:].tolist(), strict=True):
                holds = holds and (amount <= 0.0 or clear(here, sign, amount, now))
                here, now = fly_piece(here, sign, amount), now + amount
            if holds:
                best = t + row[0]
                break
        for sign in (0.0, 1.0, -1.0):
            then = fly_piece(pose, sign, step)
            key = tuple(
                round(v / (0.5 * step)) for v in (then.x, then.y, then.h % (2 * pi), t + step)
            )
            if key in seen or not clear(pose, sign, step, t):
                continue
            seen.add(key)
            toward = Pose(then.x - frame.alpha * (t + step), then.y, then.h % (2 * pi))
            if solve(toward, frame.alpha, 0.0, rows):
                bound = t + step + rows[0, 0]
                heapq.heappush(open_list, (bound, next(number), Pose(*then), t + step))
    return best * scale


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_discs_at_rest_are_passed_no_later_than_by_a_search_over_a_lattice(seed: int) -> None:
    rng = np.random.default_rng(seed)
    situation = blocked(
        *(
            Cell(
                ident=f"D{k}",
                shape=Disc(
                    x=rng.uniform(-15e3, 15e3), y=rng.uniform(-40e3, 40e3),
                    radius=rng.uniform(3e3, 8e3),
                ),
            )
            for k in range(6)
        )
    )  # fmt: skip
    by_lattice, ours = lattice_search(situation, 0.25, 4_000), planned(situation)
    alone = planned(replace(situation, others=()))
    assert alone.time_to_converge + 0.5 < ours.time_to_converge <= by_lattice + 0.1
    # whose headings are 14° apart, and who flies straight by 3 km
    assert by_lattice <= ours.time_to_converge + 40.0

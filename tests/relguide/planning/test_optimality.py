"""Pontryagin's conditions: where they must hold, where they may not, and what is refused."""

from dataclasses import replace
from math import atan2, hypot, pi

import numpy as np
import pytest
from hypothesis import given

from relguide import (
    LEFT,
    RIGHT,
    Arc,
    FlyStraight,
    Leader,
    Pursuer,
    Situation,
    Straight,
    TurnTo,
    candidates,
)
from relguide.kernels.base.records import Contact
from relguide.kernels.contact.one_contact import through_contact, workspace
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.planning.candidate import SIGN_ROWS, assemble
from relguide.planning.optimality import check
from relguide.planning.tables import scene_of
from relguide.units import DEG
from tests.plans import (
    assert_exact,
    find_plan,
    fly_planned,
    golden_plan,
    plan_unlimited,
    straight_behind,
)
from tests.situations import golden, situations


def test_every_proven_optimum_meets_the_conditions() -> None:
    free = 0
    for situation, expected in (*golden("reference"), *golden("wind")):
        if expected["status"] != "optimal":
            continue
        answer = find_plan(situation)
        report = check(answer, situation, samples=1)
        assert_exact(report, situation)
        free += report.arrival == "free"
    assert free >= 200  # the others wait for the slot to open, or are there


@given(situation=situations())
def test_an_optimum_without_the_limit_meets_the_conditions(situation: Situation) -> None:
    answer = plan_unlimited(situation)
    assert_exact(check(answer, situation, samples=1), situation)


@given(situation=situations(speed_ratio=(1.0, 1.3), reach=60_000.0))
def test_so_does_one_that_joins_a_faster_leader(situation: Situation) -> None:
    answer = plan_unlimited(situation)
    assert_exact(check(answer, situation, samples=1), situation)


def test_constrained_paths_meet_the_conditions_with_a_jump_that_is_not_negative() -> None:
    """λ_d after the contact − before, by (10) and (11): 27 golden plans touch d_min once."""
    held = touching = 0
    for situation, expected in golden("reference"):
        if expected["status"] != "best_known":
            continue
        answer = find_plan(situation)
        report = check(answer, situation, samples=1)
        held += report.holds
        touching += len(report.contacts) > 0
        assert report.holds, expected["id"]
        for contact in report.contacts:
            ours = answer.trajectory.pose_at(contact.time)
            theirs = situation.leader.trajectory.pose_at(contact.time)
            dx, dy = theirs.x - ours.x, theirs.y - ours.y
            assert hypot(dx, dy) == pytest.approx(situation.min_separation, abs=0.2)
            assert contact.bearing == pytest.approx(atan2(dx, dy), abs=1e-9)
            assert contact.jump > 0.0
        # what was left out is shorter than a pilot's glance
        assert report.neglected < 0.1
    assert touching == 27
    assert held == 39


def test_a_contact_that_lies_elsewhere_fails_by_as_much_as_it_lies_off() -> None:
    """The path through a neighbouring contact reaches the slot too, but is no extremal."""
    situation = golden_plan("R061").situation
    found = candidates(situation)
    frame, scene = found.frame, scene_of(situation, found.frame)
    contact = check(golden_plan("R061"), situation, samples=1).contacts[0]
    ours = contact.bearing + pi  # of the pursuer from the leader, clockwise from north
    residuals = []
    for off in (0.01, 0.02):
        arrivals = []
        for side in (1.0, -1.0):
            room = workspace()
            there = Contact(0, situation.leader.heading - ours + off, side)
            time = through_contact(frame.pose, scene, there, 50.0, room)
            arrivals.append((time, room.path))
        time, path = min(arrivals, key=lambda arrival: arrival[0])
        signs = [sign for row in path for sign in SIGN_ROWS[int(row[1])]]
        beside = assemble(situation, frame, signs, path[:, 2:].ravel().tolist(), "").trajectory
        report = check(beside, situation, samples=1)
        assert not report.holds
        residuals.append(report.switching_residual)
    assert residuals[1] == pytest.approx(2.0 * residuals[0], rel=0.2)


def test_contacts_close_together_share_their_jumps() -> None:
    """The last turn before this boundary arc touches d_min 0.5 s before it, a millimetre further
    in.

    Each of the two jumps hangs on rounding, and may be negative.
    """
    situation = Situation(
        pursuer=Pursuer(
            x=5126.6374828192065,
            y=7507.112993100745,
            heading=0.7295063247489008,
            tas=130.92534999033458,
            max_bank=0.4714984028318385,
        ),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=117.90654827785168),
        slot_distance=8715.0,
        min_separation=8500.767075644066,
    )
    report = check(find_plan(situation), situation, samples=1)
    before, entry, *_ = report.contacts
    assert entry.time == report.boundary_arcs[0].start
    assert entry.time - before.time < 1.0
    assert before.jump + entry.jump > 0.0
    assert report.holds


def test_a_full_circle_meets_every_condition_and_is_not_optimal() -> None:
    """They are necessary, not sufficient: no small change of it is faster."""
    situation = straight_behind()
    radius = situation.pursuer.turn_radius
    circle = Arc(turn=LEFT, turn_angle=2.0 * pi, radius=radius)
    time = (31_000.0 + circle.length) / 40.0
    onward = Straight(length=time * 220.0 - circle.length)
    assert_exact(check(fly_planned(situation, circle, onward), situation), situation)


def test_a_weave_fails() -> None:
    situation = straight_behind()
    radius = situation.pursuer.turn_radius
    weave = [Arc(turn=t, turn_angle=0.3, radius=radius) for t in (LEFT, RIGHT, RIGHT, LEFT)]
    woven = fly_planned(situation, *weave)
    ahead = woven.pose_at(woven.duration).y - situation.pursuer.y
    time = (31_000.0 + woven.length - ahead) / 40.0
    onward = Straight(length=time * 220.0 - woven.length)
    report = check(fly_planned(situation, *weave, onward), situation)
    assert not report.holds
    assert report.switching_residual > 1.0


def test_less_bank_than_there_is_fails_eq_16() -> None:
    situation = golden_plan("R001").situation
    pursuer = situation.pursuer
    gentle = replace(situation, pursuer=replace(pursuer, max_bank=0.8 * pursuer.max_bank))
    answer = find_plan(gentle)
    assert check(answer, gentle).switching_ok
    report = check(answer, situation)
    assert not report.switching_ok
    assert report.switching_residual < 1e-6  # nothing else is wrong with it


@pytest.mark.parametrize("ident", ["R001", "R050", "R061"])
def test_the_panel_is_smooth_between_its_times_and_jumps_only_at_contacts(ident: str) -> None:
    """A segment's end and a contact are there on both sides: no jump is drawn as a ramp."""
    answer = golden_plan(ident)
    report = check(answer, answer.situation, samples=400)
    history = report.history
    times = np.array(history.times)
    ends = np.cumsum(answer.trajectory.durations())[:-1].tolist()
    touched = [contact.time for contact in report.contacts]
    assert len(touched) == (0 if ident == "R001" else 1)
    for end in (*ends, *touched):
        if history.times[-1] - end > 1e-3:
            assert (np.abs(times - end) < 1e-6).sum() >= 2, end
    columns = (history.hamiltonian, history.switching, history.separation, history.bearing)
    for k, column in enumerate(map(np.array, columns)):
        steps, gaps = np.abs(np.diff(column)), np.diff(times)
        together = gaps < 1e-9
        span = float(np.ptp(column)) + 1e-12
        at_contact = np.array(
            [any(abs(t - at) < 1e-6 for at in touched) for t in times[:-1][together]], bool
        )
        unbroken = steps[together][~at_contact]
        # H is of size 1, and met as well as the contact is placed
        assert unbroken.max(initial=0.0) <= 1e-6 * (span if k > 0 else 1.0)
        # 400 times along it: a jump drawn as a ramp would be a step of half the range or more
        if k > 0:
            assert steps[~together].max() < 0.3 * span
    rise = [contact.jump for contact in report.contacts]
    for t, jump in zip(touched, rise, strict=True):
        before, after = np.flatnonzero(np.abs(times - t) < 1e-6)[[0, -1]]
        found = history.separation[after] - history.separation[before]
        assert found == pytest.approx(jump, rel=1e-6)
        assert history.switching[after] == pytest.approx(history.switching[before], abs=1e-6)


def test_a_plan_that_waits_for_the_opening_is_said_to_be_one() -> None:
    answer = golden_plan("R104")
    report = check(answer, answer.situation)
    assert report.arrival == "release"
    assert report.holds
    assert set(report.history.hamiltonian) == {1.0}
    assert set(report.history.switching) == {0.0}


def test_of_a_pursuer_in_the_slot_nothing_is_asked() -> None:
    situation = straight_behind()
    there = replace(situation, pursuer=replace(situation.pursuer, y=-9_000.0))
    report = check(find_plan(there), there)
    assert (report.arrival, report.holds, report.history.times) == ("at_once", True, ())


def test_aircraft_in_one_place_do_not_disturb() -> None:
    situation = straight_behind(d_min=0.0)
    there = replace(situation, pursuer=replace(situation.pursuer, y=0.0))
    report = check(find_plan(there), there)
    assert report.holds
    assert max(map(abs, report.history.hamiltonian)) <= 1e-7


def test_what_does_not_reach_the_slot_is_refused() -> None:
    situation = straight_behind()
    with pytest.raises(ValueError, match=r"ends \d+\.\d m from the slot"):
        check(fly_planned(situation, Straight(length=1_000.0)), situation)


def test_so_is_what_comes_before_the_slot_opens() -> None:
    leader = Leader(
        x=0.0,
        y=0.0,
        heading=0.0,
        tas=180.0,
        intent=(FlyStraight(duration=1_000.0), TurnTo(heading=0.5, turn=RIGHT, bank=20.0 * DEG)),
    )
    situation = replace(straight_behind(), leader=leader)
    frame, rows = candidates(situation).frame, np.empty((MAX_ROWS, 5))
    assert solve(frame.pose, frame.alpha, 0.0, rows) > 0
    assert rows[0, 0] < frame.t_release
    amounts = rows[0, 2:].tolist()
    early = assemble(situation, frame, SIGN_ROWS[int(rows[0, 1])], amounts, "").trajectory
    with pytest.raises(ValueError, match="before the slot opens"):
        check(early, situation)

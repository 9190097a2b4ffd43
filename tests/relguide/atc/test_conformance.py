"""The monitor: its thresholds and hysteresis kind by kind, and that what it allows is bounded."""

from collections.abc import Callable
from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide.atc.bounds import cleared_stray
from relguide.atc.conformance import Memory, gone, shown, still_covers, watch
from relguide.atc.documents import Deviation
from relguide.atc.picture import Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import CLEARS, AtcSettings, Threshold
from relguide.atc.track import Track
from relguide.units import FT, NM
from tests.relguide.atc.tracks import seen_on, track_of_legs, tracks, turning_legs

SETTINGS = AtcSettings()
STRAIGHT = track_of_legs([(1_000.0, 0.5, 220.0), (1_000.0, 0.5, 220.0)])
AHEAD = track_of_legs(
    [(1_000.0, 0.5, 220.0), (1_000.0, 0.5, 220.0)],
    x=10_000.0 * np.sin(0.5),
    y=10_000.0 * np.cos(0.5),
)
BEHIND = Manoeuvre(
    ident="RG 06",
    leader="LDR 01",
    spacing_type="distance",
    spacing=10_000.0,
    min_separation=4.0 * NM,
    path=STRAIGHT,
    joins=500.0,
    leader_path=AHEAD,
)
BY_TIME = replace(BEHIND, spacing_type="time", spacing=10_000.0 / 220.0)


def leader_at(t: float) -> Seen:
    return replace(seen_on(AHEAD, t), ident="LDR 01")


Put = Callable[[float, float], Seen]
KINDS: dict[str, tuple[Manoeuvre, str, Threshold, Put]] = {
    "right": (BEHIND, "across", SETTINGS.across, lambda t, off: seen_on(STRAIGHT, t, right=off)),
    "left": (BEHIND, "across", SETTINGS.across, lambda t, off: seen_on(STRAIGHT, t, right=-off)),
    "early": (BEHIND, "along", SETTINGS.along, lambda t, off: seen_on(STRAIGHT, t, early=off)),
    "late": (BEHIND, "along", SETTINGS.along, lambda t, off: seen_on(STRAIGHT, t, early=-off)),
    "above": (BEHIND, "level", SETTINGS.level, lambda t, off: seen_on(STRAIGHT, t, above=off)),
    "below": (BEHIND, "level", SETTINGS.level, lambda t, off: seen_on(STRAIGHT, t, above=-off)),
    "behind": (
        BEHIND,
        "spacing",
        SETTINGS.spacing,
        lambda t, off: seen_on(STRAIGHT, t, early=-off / 220.0),
    ),
    "close": (
        BEHIND,
        "spacing",
        SETTINGS.spacing,
        lambda t, off: seen_on(STRAIGHT, t, early=off / 220.0),
    ),
    "after": (
        BY_TIME,
        "spacing",
        SETTINGS.spacing_time,
        lambda t, off: seen_on(STRAIGHT, t, early=-off),
    ),
}


def follow(
    manoeuvre: Manoeuvre, own: list[Seen], *, leader: bool = True
) -> list[tuple[Deviation, ...]]:
    """What is said of an aircraft each time that it is seen."""
    memory, said = Memory(), []
    for seen in own:
        behind = leader_at(seen.t) if leader else None
        memory, deviations = watch(memory, seen, manoeuvre, behind, seen.t)
        said.append(deviations)
    return said


def levels(said: list[tuple[Deviation, ...]], subject: str) -> list[str]:
    return [
        next((one.level for one in deviations if one.subject == subject), "none")
        for deviations in said
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_each_threshold_and_its_hysteresis(kind: str) -> None:
    manoeuvre, subject, threshold, put = KINDS[kind]
    caution, alert = threshold.caution, threshold.alert
    steps = [
        (0.0, "none"),
        (0.99 * caution, "none"),
        (1.01 * caution, "caution"),
        ((CLEARS + 0.01) * caution, "caution"),
        ((CLEARS - 0.01) * caution, "none"),
        (0.99 * caution, "none"),
        (1.01 * alert, "alert"),
        ((CLEARS + 0.01) * alert, "alert"),
        (max((CLEARS - 0.01) * alert, (CLEARS + 0.01) * caution), "caution"),
        (0.99 * alert, "caution"),
        (0.0, "none"),
    ]
    own = [put(600.0 + k, off) for k, (off, _) in enumerate(steps)]
    said = follow(manoeuvre, own)
    assert levels(said, subject) == [level for _, level in steps]
    for (off, _), deviations in zip(steps, said, strict=True):
        for one in deviations:
            if one.subject == subject:
                assert one.amount == pytest.approx(off, rel=1e-6)
                assert one.unit == ("s" if threshold.caution < 20.0 else "m")
                assert one.message.endswith(".")


def test_messages_say_how_far_and_to_which_side() -> None:
    aside = seen_on(STRAIGHT, 600.0, right=-1_000.0, early=-7.0, above=-250.0 * FT)
    (said,) = follow(BEHIND, [aside])
    assert [one.message for one in said] == [
        "0.54 NM to the left of its cleared path.",
        "7 s late on its cleared path.",
        "0.83 NM too far behind LDR 01.",
        "250 ft below its cleared level.",
    ]


def test_a_deviation_is_told_by_when_it_began() -> None:
    off = [0.0, 500.0, 500.0, 2_000.0, 2_000.0, 500.0, 500.0, 0.0, 500.0]
    own = [seen_on(STRAIGHT, 600.0 + k, right=right) for k, right in enumerate(off)]
    said = [[one.since for one in deviations] for deviations in follow(BEHIND, own)]
    assert said == [[], [601.0], [601.0], [603.0], [603.0], [601.0], [601.0], [], [608.0]]


def test_a_caution_is_shown_once_it_lasts_and_an_alert_at_once() -> None:
    own = [seen_on(STRAIGHT, 600.0 + k, right=500.0) for k in range(12)]
    said = follow(BEHIND, own)
    assert [bool(shown(one, 600.0 + k)) for k, one in enumerate(said)] == [False] * 10 + [True] * 2
    (alert,) = follow(BEHIND, [seen_on(STRAIGHT, 600.0, right=2_000.0)])
    assert shown(alert, 600.0) == alert


def test_who_stays_away_is_cleared_no_more() -> None:
    own = [seen_on(STRAIGHT, 600.0 + k, right=2_000.0) for k in range(32)]
    said = follow(BEHIND, own)
    assert [gone(one, 600.0 + k) for k, one in enumerate(said)] == [False] * 30 + [True] * 2
    caution = follow(BEHIND, [seen_on(STRAIGHT, 600.0 + k, right=500.0) for k in range(60)])
    assert not any(gone(one, 700.0) for one in caution)


def test_what_is_not_seen_anew_is_as_it_was() -> None:
    aside = seen_on(STRAIGHT, 600.0, right=500.0)
    memory, said = watch(Memory(), aside, BEHIND, leader_at(600.0), 600.0)
    assert watch(memory, aside, BEHIND, leader_at(605.0), 605.0) == (memory, said)


def test_before_it_has_joined_and_without_its_leader_the_spacing_is_not_measured() -> None:
    late = [seen_on(STRAIGHT, 400.0 + k, early=-4.5) for k in range(120)]
    assert "spacing" not in {one.subject for said in follow(BEHIND, late)[:100] for one in said}
    assert "spacing" in {one.subject for one in follow(BEHIND, late)[-1]}
    assert not any(follow(BEHIND, late, leader=False))


def test_a_leader_that_was_seen_long_ago_says_nothing_of_the_spacing() -> None:
    near = replace(BEHIND, min_separation=9_990.0)
    seen = seen_on(STRAIGHT, 600.0, early=0.1)
    fresh = watch(Memory(), seen, near, leader_at(595.0), 600.0)[1]
    assert [one.subject for one in fresh] == ["spacing"]
    assert watch(Memory(), seen, near, leader_at(585.0), 600.0)[1] == ()


def test_less_than_the_minimum_is_an_alert_at_once_unless_height_keeps_them_apart() -> None:
    near = replace(BEHIND, min_separation=10_010.0)
    for t in (100.0, 600.0):  # on the way as well as joined
        (said,) = follow(near, [seen_on(STRAIGHT, t)])
        assert [(one.subject, one.level) for one in said] == [("spacing", "alert")]
        assert said[0].message == "5.40 NM from LDR 01: 5.40 NM are to be kept."
        assert said[0].amount == pytest.approx(10.0)
    above = replace(seen_on(STRAIGHT, 100.0), altitude=9_000.0 + 1_001.0 * FT)
    free = replace(near, path=_between(STRAIGHT, 8_000.0, 10_000.0))
    assert watch(Memory(), above, free, leader_at(100.0), 100.0)[1] == ()
    unknown = replace(seen_on(STRAIGHT, 100.0), altitude=None)
    assert watch(Memory(), unknown, near, leader_at(100.0), 100.0)[1] != ()


def _between(track: Track, low: float, high: float) -> Track:
    return replace(track, low=np.full(len(track.t), low), high=np.full(len(track.t), high))


def test_where_no_level_is_cleared_none_is_left() -> None:
    free = replace(BEHIND, path=_between(STRAIGHT, -np.inf, np.inf))
    assert follow(free, [seen_on(STRAIGHT, 100.0, above=3_000.0)]) == [()]
    low = _between(STRAIGHT, 8_000.0, 9_500.0)
    climbing = replace(BEHIND, path=low)
    assert follow(climbing, [seen_on(STRAIGHT, 100.0, above=400.0)]) == [()]


def test_beyond_its_ends_only_the_spacing_and_the_level_count() -> None:
    short = replace(BEHIND, path=replace(STRAIGHT, t=STRAIGHT.t[:2], x=STRAIGHT.x[:2],
                                         y=STRAIGHT.y[:2], low=STRAIGHT.low[:2],
                                         high=STRAIGHT.high[:2]))  # fmt: skip
    off = seen_on(STRAIGHT, 1_100.0, right=5_000.0, above=100.0)
    assert {one.subject for one in follow(short, [off])[0]} == {"level"}


TURNING = replace(BEHIND, path=track_of_legs(turning_legs()), joins=1_000.0)


def turn_said(own: list[Seen]) -> list[tuple[str, float, str]]:
    """Of the turn alone, each second."""
    said = follow(TURNING, own, leader=False)
    turns = [[one for one in deviations if one.subject == "turn"] for deviations in said]
    return [(one[0].level, one[0].amount, one[0].message) if one else ("none", 0.0, "")
            for one in turns]  # fmt: skip


def test_a_turn_that_does_not_begin() -> None:
    straight = track_of_legs([(600.0, 0.0, 200.0), (600.0, 0.0, 200.0)])
    said = turn_said([seen_on(straight, float(t)) for t in range(100, 200)])
    seen_at = 124.5  # 5° at 1°/s, its pieces of 2 s taken at their middles
    first = {level: 100 + [one[0] for one in said].index(level) for level in ("caution", "alert")}
    assert first["caution"] == pytest.approx(seen_at + 5.0, abs=1.5)
    assert first["alert"] == pytest.approx(seen_at + 15.0, abs=1.5)
    assert said[-1][0] == "alert"
    assert said[-1][2] == f"Its turn to the right is {199.0 - seen_at:.0f} s late."


@pytest.mark.parametrize("late", [0.0, 1.7, 4.0])
def test_a_turn_that_begins_in_time_is_not_said(late: float) -> None:
    own = [seen_on(TURNING.path, float(t), early=-late) for t in range(100, 300)]
    assert {level for level, _, _ in turn_said(own)} == {"none"}


def test_a_turn_that_begins_late_is_over_once_it_has_begun() -> None:
    said = turn_said([seen_on(TURNING.path, float(t), early=-9.0) for t in range(100, 300)])
    assert {one[0] for one in said} == {"none", "caution"}
    assert said[-1][0] == "none"


@pytest.mark.parametrize("side", [-1, 1])
def test_a_turn_to_the_wrong_side_is_an_alert_at_once(side: int) -> None:
    cleared = replace(TURNING, path=track_of_legs(turning_legs(side=side)))
    other = track_of_legs(turning_legs(side=-side))
    own = [seen_on(other, float(t)) for t in range(100, 180)]
    said = follow(cleared, own, leader=False)
    first = levels(said, "turn").index("alert")
    assert 100 + first == pytest.approx(126.0, abs=1.0)
    words = ("right", "left") if side < 0 else ("left", "right")
    (turn,) = [one for one in said[first] if one.subject == "turn"]
    assert turn.message == f"It turns to the {words[0]}, and is cleared to turn to the {words[1]}."


@given(
    tracks(),
    st.floats(0.0, 1.0),
    st.floats(-800.0, 800.0),
    st.floats(-8.0, 8.0),
    st.floats(-100.0, 100.0),
)
def test_while_it_is_silent_what_validation_adds_holds(
    track: Track, share: float, right: float, early: float, above: float
) -> None:
    manoeuvre = replace(BEHIND, path=track)
    t = track.begin + share * (track.end - track.begin)
    seen = seen_on(track, t, right=right, early=early, above=above)
    _, said = watch(Memory(), seen, manoeuvre, None, t)
    if said:
        return
    x, y = track.place(t)
    allowed = hypot(SETTINGS.across.caution, SETTINGS.along.caution * track.fastest)
    assert hypot(seen.x - x, seen.y - y) <= allowed * (1.0 + 1e-9)
    assert allowed <= cleared_stray(track, SETTINGS) * (1.0 + 1e-9)
    assert abs(above) <= SETTINGS.level.caution


@given(st.floats(100.0, 1_900.0), st.floats(-460.0, 460.0), st.floats(-4.9, 4.9))
def test_who_is_within_all_cautions_is_told_nothing(t: float, right: float, early: float) -> None:
    own = [seen_on(STRAIGHT, t, right=right, early=early)]
    assert follow(BEHIND, own, leader=False) == [()]


def test_a_new_path_is_covered_while_it_stays_within_all_cautions() -> None:
    path = track_of_legs(turning_legs(turned=90.0))
    cleared = replace(BEHIND, path=path)
    assert still_covers(cleared, path)
    assert still_covers(cleared, replace(path, x=path.x + 250.0, y=path.y + 250.0))
    assert not still_covers(cleared, replace(path, x=path.x + 470.0))
    assert still_covers(cleared, replace(path, t=path.t + 4.0))
    assert not still_covers(cleared, replace(path, t=path.t + 6.0))
    assert not still_covers(cleared, replace(path, t=path.t - 6.0))
    assert not still_covers(cleared, track_of_legs(turning_legs(turned=92.0, speed=210.0)))
    assert not still_covers(cleared, track_of_legs(turning_legs(turned=90.0, side=-1)))
    aside = replace(path, x=path.x + 250.0, y=path.y + 250.0)
    assert not still_covers(cleared, replace(aside, error=220.0))
    assert not still_covers(cleared, replace(path, t=path.t + 4.5, error=150.0))
    higher = _between(path, 9_000.0 + 199.0 * FT, 9_000.0 + 199.0 * FT)
    assert still_covers(cleared, higher)
    assert not still_covers(cleared, _between(path, 9_000.0, 9_000.0 + 201.0 * FT))
    assert not still_covers(cleared, _between(path, 9_000.0 - 201.0 * FT, 9_000.0))
    assert not still_covers(cleared, _between(path, -np.inf, np.inf))
    assert still_covers(replace(cleared, path=_between(path, -np.inf, np.inf)), path)


def test_past_the_cleared_paths_end_any_path_is_covered() -> None:
    path = track_of_legs([(100.0, 0.0, 200.0)] * 2)
    later = track_of_legs([(100.0, 2.0, 200.0)] * 2, begin=201.0)
    assert still_covers(replace(BEHIND, path=path), later)
    assert not still_covers(replace(BEHIND, path=path), replace(later, t=later.t - 10.0))


@settings(max_examples=60)
@given(tracks(), st.integers(0, 2**32 - 1))
def test_who_flies_a_covered_path_to_within_its_error_is_told_nothing(
    track: Track, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    shifts = np.cumsum(rng.normal(0.0, 40.0, (2, len(track.t))), axis=1)
    new = replace(
        track,
        t=track.t + rng.uniform(-3.0, 3.0),
        x=track.x + shifts[0],
        y=track.y + shifts[1],
        error=float(rng.uniform(0.0, 200.0)),
    )
    cleared = replace(BEHIND, path=track)
    if not still_covers(cleared, new):
        return
    angle = rng.uniform(0.0, 2.0 * np.pi)
    for t in np.linspace(max(new.begin, track.begin), track.end, 20).tolist():
        x, y = new.place(t)
        seen = replace(
            seen_on(track, t), x=x + new.error * np.cos(angle), y=y + new.error * np.sin(angle)
        )
        _, said = watch(Memory(), seen, cleared, None, t)
        assert {one.subject for one in said} <= {"turn"}

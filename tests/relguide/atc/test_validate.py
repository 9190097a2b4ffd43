"""What validation says, and that nothing it accepts is lost while all stay in the thresholds."""

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest

from benchmarks.validation import Tally, judge
from relguide.atc.picture import Airspace, Picture, Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.atc.validate import validate
from relguide.planning.aircraft import Traffic
from relguide.units import DEG, FT, KT, NM
from tests.relguide.atc.pictures import (
    LEVEL,
    NOW,
    drawn_path,
    drawn_traffic,
    manoeuvre_on,
    picture_of,
    seen_of,
)

SETTINGS = AtcSettings()
RNG = np.random.default_rng(7)
PATH = drawn_path(RNG)
ASKED, LEADER = manoeuvre_on(PATH)
UNTIL = ASKED.joins + 120.0


def crossing(aside: float, *, ident="BAW12", tas=200.0, t=200.0, **more) -> Traffic:
    """One that passes the path's place at t at right angles, so far ahead of it."""
    there = PATH.pose_at(t)
    heading = (there.heading + 0.5 * pi) % (2.0 * pi)
    x = there.x + aside * np.sin(there.heading) - tas * t * np.sin(heading)
    y = there.y + aside * np.cos(there.heading) - tas * t * np.cos(heading)
    return Traffic(ident=ident, x=x, y=y, heading=heading, tas=tas, min_separation=0.0, **more)


def reasons(card) -> list[str]:
    return [finding.reason for finding in card.findings]


def test_alone_with_its_leader_it_is_acceptable():
    card = validate(ASKED, picture_of(LEADER), NOW)
    assert card.verdict == "acceptable"
    assert card.findings == ()
    assert card.valid_until == NOW + SETTINGS.valid_for
    assert card.aircraft == 1
    assert [pair.ident for pair in card.pairs] == ["LEAD"]


def test_itself_in_the_picture_is_no_traffic():
    own = seen_of(crossing(0.0, ident="OWN"), UNTIL)
    assert validate(ASKED, picture_of(LEADER, own), NOW).verdict == "acceptable"


def test_traffic_in_the_way_is_a_certain_conflict_said_in_words_of_data_link():
    card = validate(ASKED, picture_of(LEADER, seen_of(crossing(2_000.0), UNTIL)), NOW)
    assert card.verdict == "unable"
    (finding,) = card.findings
    assert finding.reason == "separation"
    assert finding.text == "UNABLE DUE TO TRAFFIC BAW12"
    assert finding.idents == ("BAW12",)
    assert "5.00 NM is to be kept" in finding.message
    pair = card.pairs[0]
    assert (pair.ident, pair.certainty) == ("BAW12", "certain")
    assert pair.since < pair.at < pair.until
    assert np.hypot(pair.own.x - pair.other.x, pair.own.y - pair.other.y) == pytest.approx(
        pair.least, abs=1e-3
    )


def test_from_clear_by_possible_to_certain_as_traffic_comes_nearer():
    order = []
    for aside in np.linspace(40_000.0, 0.0, 200):
        card = validate(ASKED, picture_of(LEADER, seen_of(crossing(aside), UNTIL)), NOW)
        kinds = [pair.certainty for pair in card.pairs if pair.ident == "BAW12"]
        kind = kinds[0] if kinds else "clear"
        if not order or order[-1] != kind:
            order.append(kind)
    assert order[:2] == ["clear", "possible"]
    assert "certain" in order


def test_traffic_at_another_level_is_clear_and_at_one_not_known_is_not():
    own = replace(ASKED, path=at_level(ASKED.path, LEVEL))
    for altitude, verdict in ((LEVEL + 1_000.0 * FT, "acceptable"), (LEVEL, "unable"),
                              (LEVEL + 900.0 * FT, "unable"), (None, "unable")):  # fmt: skip
        seen = seen_of(crossing(0.0, altitude=altitude), UNTIL)
        assert validate(own, picture_of(LEADER, seen), NOW).verdict == verdict


def at_level(track: Track, altitude: float) -> Track:
    level = np.full(len(track.t), altitude)
    return replace(track, low=level, high=level)


def test_without_intent_a_fan_makes_it_possible_and_the_intent_would_help():
    traffic = crossing(20_000.0)
    with_intent = seen_of(traffic, UNTIL)
    assert validate(ASKED, picture_of(LEADER, with_intent), NOW).verdict == "acceptable"
    card = validate(ASKED, picture_of(LEADER, replace(with_intent, path=None)), NOW)
    (finding,) = card.findings
    assert finding.reason == "traffic_without_intent"
    assert finding.text == "UNABLE DUE TO TRAFFIC BAW12"
    assert "The intent of BAW12 would help" in finding.message
    straight_in = replace(seen_of(crossing(0.0), UNTIL), path=None)
    assert reasons(validate(ASKED, picture_of(LEADER, straight_in), NOW)) == ["separation"]


def test_a_cleared_path_is_trusted_as_conformance_allows():
    """Its bound does not grow, and grows with its speed."""
    seen = seen_of(crossing(14_000.0), UNTIL)
    filed = validate(ASKED, picture_of(LEADER, seen), NOW).pairs
    cleared = validate(ASKED, picture_of(LEADER, replace(seen, cleared=True)), NOW).pairs
    assert {pair.ident for pair in filed} == {pair.ident for pair in cleared}
    (a,), (b,) = ([p for p in pairs if p.ident == "BAW12"] for pairs in (filed, cleared))
    assert a.bound != b.bound


def test_the_leader_counts_by_the_distance_of_the_clearance():
    near = replace(ASKED, min_separation=5.2 * NM)
    card = validate(near, picture_of(LEADER), NOW)
    assert reasons(card) == ["separation"]
    assert card.findings[0].idents == ("LEAD",)
    assert card.pairs[0].bound == 0.0


def test_closed_airspace():
    there = PATH.pose_at(150.0)
    x = tuple(there.x + step for step in (-2_000.0, 2_000.0, 2_000.0, -2_000.0))
    y = tuple(there.y + step for step in (-2_000.0, -2_000.0, 2_000.0, 2_000.0))
    space = Airspace(ident="R123", x=x, y=y, low=-inf, high=inf, since=-inf, until=inf)
    picture = replace(picture_of(LEADER), airspaces=(space,))
    (finding,) = validate(ASKED, picture, NOW).findings
    assert finding.reason == "airspace"
    assert finding.text == "UNABLE DUE TO AIRSPACE RESTRICTION R123"
    over = replace(picture, airspaces=(replace(space, until=NOW + 30.0),))
    assert validate(ASKED, over, NOW).verdict == "acceptable"


def test_more_bank_than_it_has():
    steep = replace(ASKED, bank=30.0 * DEG, max_bank=25.0 * DEG)
    (finding,) = validate(steep, picture_of(LEADER), NOW).findings
    assert finding.reason == "bank"
    assert "30° of bank, and OWN has 25°" in finding.message
    assert validate(replace(steep, max_bank=0.0), picture_of(LEADER), NOW).findings == ()


def test_a_leader_that_it_cannot_stay_behind():
    faster = seen_of(Traffic(ident="LEAD", x=LEADER.x, y=LEADER.y, heading=LEADER.track,
                             tas=LEADER.ground_speed * 1.1, min_separation=0.0), UNTIL)  # fmt: skip
    moved = replace(ASKED, leader_path=faster.path)
    card = validate(moved, picture_of(faster), NOW)
    assert "speed" in reasons(card)
    assert "UNABLE DUE TO AIRCRAFT PERFORMANCE" in [finding.text for finding in card.findings]


@pytest.mark.parametrize(
    ("change", "agrees"),
    [
        ({"x": LEADER.x + 20.0}, True),
        ({"x": LEADER.x + 60.0}, False),
        ({"heading": LEADER.track + 1.5 * DEG}, False),
        ({"tas": LEADER.ground_speed + 3.0 * KT}, False),
    ],
)
@pytest.mark.parametrize("files", [True, False])
def test_a_leader_that_does_not_fly_what_was_planned_on(change, agrees, files):
    plain = {"x": LEADER.x, "y": LEADER.y, "heading": LEADER.track, "tas": LEADER.ground_speed}
    traffic = Traffic(ident="LEAD", min_separation=0.0, **(plain | change))
    seen = seen_of(traffic, UNTIL)
    seen = seen if files else replace(seen, path=None)
    found = [one for one in reasons(validate(ASKED, picture_of(seen), NOW)) if one != "speed"]
    assert found == ([] if agrees else ["leader_disagrees"])


def test_a_leader_that_has_not_filed_the_turn_that_was_planned_on():
    rng = np.random.default_rng(3)
    turning = seen_of(drawn_traffic(rng, "LEAD"), UNTIL)
    planned = replace(ASKED, leader_path=turning.path, min_separation=0.0)
    agreed = validate(planned, picture_of(turning), NOW)
    assert "leader_disagrees" not in reasons(agreed)
    card = validate(planned, picture_of(replace(turning, path=None)), NOW)
    assert "leader_disagrees" in reasons(card)
    assert any("has not filed the change" in finding.message for finding in card.findings)


def test_a_leader_that_is_not_seen():
    assert reasons(validate(ASKED, picture_of(), NOW)) == ["leader_disagrees"]


def test_an_old_picture_is_standby_with_all_that_is_found():
    picture = picture_of(LEADER, seen_of(crossing(0.0), UNTIL))
    card = validate(ASKED, picture, NOW + 10.5)
    assert card.verdict == "standby"
    assert reasons(card) == ["stale_picture", "separation"]
    assert card.findings[0].text == "STANDBY"
    assert card.valid_until == NOW + 10.5
    assert validate(ASKED, picture_of(LEADER), NOW + 9.5).verdict == "acceptable"


def test_what_is_over_is_expired():
    late = ASKED.joins + 121.0
    picture = Picture(as_of=late, aircraft=(replace(LEADER, t=late),))
    assert "expired" in reasons(validate(ASKED, picture, late))


def test_once_joined_it_is_looked_at_ever_further_on():
    late = ASKED.joins + 60.0
    then = LEADER.path.place(late)
    leader = replace(LEADER, t=late, x=then[0], y=then[1])
    traffic = replace(seen_of(crossing(0.0, t=ASKED.joins - NOW + 110.0), late + 120.0), t=late)
    picture = Picture(as_of=late, aircraft=(leader, traffic))
    assert reasons(validate(ASKED, picture, late)) == ["separation"]
    alone = Picture(as_of=late, aircraft=(leader,))
    assert validate(ASKED, alone, late).verdict == "acceptable"


def test_a_join_beyond_the_horizon_is_said():
    path = drawn_path(np.random.default_rng(2), joins_after=1_500.0)
    far, leader = manoeuvre_on(path, d_min=0.0)
    (finding,) = validate(far, picture_of(leader), NOW).findings
    assert finding.reason == "horizon"
    assert "traffic is predicted for 20 min" in finding.message


def test_all_findings_are_given_at_once():
    steep = replace(ASKED, bank=30.0 * DEG, max_bank=25.0 * DEG)
    picture = picture_of(
        seen_of(crossing(0.0), UNTIL), seen_of(crossing(500.0, ident="AFR1"), UNTIL)
    )
    assert sorted(reasons(validate(steep, picture, NOW))) == [
        "bank", "leader_disagrees", "separation", "separation",
    ]  # fmt: skip


@pytest.mark.parametrize("seed", range(3))
def test_turned_mirrored_shifted_and_delayed_alike(seed):
    rng = np.random.default_rng(50 + seed)
    path = drawn_path(rng)
    asked, leader = manoeuvre_on(path)
    others = [seen_of(drawn_traffic(rng, f"T{i}"), asked.joins + 120.0) for i in range(6)]
    others.append(replace(seen_of(drawn_traffic(rng, "T9"), UNTIL), path=None))
    picture = picture_of(leader, *others)
    plain = validate(asked, picture, NOW)
    c, s = np.cos(0.8), np.sin(0.8)
    for matrix, shift, delay in (
        (((c, s), (-s, c)), (0.0, 0.0), 0.0),
        (((-1.0, 0.0), (0.0, 1.0)), (0.0, 0.0), 0.0),
        (((1.0, 0.0), (0.0, 1.0)), (30_000.0, -12_000.0), 0.0),
        (((1.0, 0.0), (0.0, 1.0)), (0.0, 0.0), 5_000.0),
    ):
        moved = Moved(np.array(matrix), np.array(shift), delay)
        card = validate(moved.manoeuvre(asked), moved.picture(picture), NOW + delay)
        assert card.verdict == plain.verdict
        assert sorted(reasons(card)) == sorted(reasons(plain))
        assert [p.ident for p in card.pairs] == [p.ident for p in plain.pairs]
        for a, b in zip(card.pairs, plain.pairs, strict=True):
            assert a.least == pytest.approx(b.least, abs=1e-2)
            assert a.at - delay == pytest.approx(b.at, abs=1e-2)
            assert a.certainty == b.certainty


class Moved:
    """A plane turned or mirrored and shifted, and a clock put on."""

    def __init__(self, matrix, shift, delay):
        self.matrix, self.shift, self.delay = matrix, shift, delay

    def track(self, track: Track) -> Track:
        x, y = self.matrix @ np.vstack((track.x, track.y)) + self.shift[:, None]
        return replace(track, t=track.t + self.delay, x=x, y=y)

    def seen(self, seen: Seen) -> Seen:
        x, y = self.matrix @ (seen.x, seen.y) + self.shift
        east, north = self.matrix @ (np.sin(seen.track), np.cos(seen.track))
        path = seen.path and self.track(seen.path)
        return replace(seen, t=seen.t + self.delay, x=x, y=y, path=path,
                       track=float(np.arctan2(east, north)))  # fmt: skip

    def picture(self, picture: Picture) -> Picture:
        aircraft = tuple(map(self.seen, picture.aircraft))
        return replace(picture, as_of=picture.as_of + self.delay, aircraft=aircraft)

    def manoeuvre(self, asked: Manoeuvre) -> Manoeuvre:
        return replace(asked, path=self.track(asked.path), joins=asked.joins + self.delay,
                       leader_path=self.track(asked.leader_path))  # fmt: skip


def test_nothing_accepted_is_lost_while_all_stay_within_the_thresholds():
    """A hundred drawn pictures; `python -m benchmarks.validation` draws as many as one likes."""
    tally = Tally()
    for seed in range(100):
        judge(seed, tally)
    assert tally.lost == 0
    assert tally.accepted > 20
    assert tally.attacked > 5

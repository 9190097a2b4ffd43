"""Named scenarios: the paper's figures differ in what is known, and missing data is said."""

from dataclasses import replace

import pytest

from relguide.flying import scenarios
from relguide.flying.flight import DeclaredLeader
from relguide.flying.scenarios import SCENARIOS, fig_6, own_scenario, scenario
from relguide.planning.intent import FlyStraight
from relguide.units import DEG, NM


def test_figures_differ_in_what_is_known_and_in_nothing_else() -> None:
    a, b = scenario("fig_6a"), scenario("fig_6b")
    named = {"name": "", "title": "", "description": ""}
    assert (a.intent_known, b.intent_known) == (False, True)
    assert replace(a, **named, intent_known=True) == replace(b, **named)


def test_figure_6_is_the_papers() -> None:
    situation = scenario("fig_6b").situation
    pursuer, leader = situation.pursuer, situation.leader
    assert (pursuer.x - leader.x, pursuer.y - leader.y) == (-40_000.0, 40_000.0)
    assert pursuer.heading == leader.heading == 90.0 * DEG
    assert leader.final_heading == 135.0 * DEG
    assert situation.min_separation == 5.0 * NM
    assert situation.slot_distance >= situation.min_separation


def test_turn_time_is_a_parameter() -> None:
    first = fig_6(intent_known=True, leader_turns_at=100.0).situation.leader.intent[0]
    assert first == FlyStraight(duration=100.0)


def test_every_listed_scenario_can_be_built_or_says_what_is_missing() -> None:
    for name, named in SCENARIOS.items():
        assert named.name == name
        assert named.title
        assert named.description
        if named.missing():
            with pytest.raises(ValueError, match="pip install"):
                named.build()
        else:
            assert named.build().name == name


def test_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(ValueError, match=r"no scenario 'fig_7'.*fig_6a, fig_6b, recorded_leader"):
        scenario("fig_7")


def test_without_the_samples_the_sentence_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(scenarios, "find_spec", lambda name: None)
    missing = SCENARIOS["recorded_leader"].missing()
    assert "pip install --no-deps traffic==2.13" in missing


def test_recorded_leader_can_be_joined() -> None:
    named = SCENARIOS["recorded_leader"]
    assert not named.missing(), named.missing()
    found = named.build()
    assert not isinstance(found.leader_source, DeclaredLeader)
    assert not found.intent_known
    assert found.situation.pursuer.tas > found.situation.leader.tas


def test_own_situation_is_flown_as_it_is() -> None:
    situation = scenario("fig_6a").situation
    own = own_scenario(situation, intent_known=False)
    assert own.situation == situation
    assert not own.intent_known

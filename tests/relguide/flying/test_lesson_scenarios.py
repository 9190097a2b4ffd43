"""Lessons: short flights that the autopilot joins, and so does a pilot who follows the bars."""

from dataclasses import replace

import pytest

from relguide.flying.documents import FlightEnded
from relguide.flying.flight import Scenario, fly
from relguide.flying.pilot_model import PilotModel
from relguide.flying.scenarios import SCENARIOS, scenario
from relguide.planning.plan import plan
from relguide.units import Second

LESSONS = ("lesson_bar", "lesson_raw", "lesson_turn")
SHORTEST, LONGEST = 180.0, 360.0
"""A lesson takes three to six minutes [s]."""
MOST_LATE: Second = 5.0
"""A pilot who follows the bars is late by no more [s]: under 3 % of the flight."""


def join_time(flown: Scenario) -> Second:
    ended = list(fly(flown, plan, seed=1))[-1]
    assert isinstance(ended, FlightEnded)
    (result,) = ended.results
    assert result.joined
    assert not result.losses
    return result.join_time


@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_is_short_and_a_pilot_on_the_bars_joins_with_the_autopilot(name: str) -> None:
    lesson = scenario(name)
    by_autopilot = join_time(lesson)
    assert SHORTEST <= by_autopilot <= LONGEST
    assert join_time(replace(lesson, by_hand=PilotModel())) <= by_autopilot + MOST_LATE


@pytest.mark.parametrize("name", LESSONS)
def test_only_the_leader_that_turns_untold_turns(name: str) -> None:
    lesson = scenario(name)
    is_told = name != "lesson_turn"
    assert lesson.intent_known is is_told
    assert (not lesson.situation.leader.intent) is is_told
    assert SCENARIOS[name].title == lesson.title

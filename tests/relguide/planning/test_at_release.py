"""The plan that arrives just as the slot opens, chosen at once, is the one of the whole list."""

from itertools import takewhile

from hypothesis import given, settings

from relguide.planning.at_release import first_at_release
from relguide.planning.certificate import certify
from relguide.planning.situation import Situation
from relguide.planning.tables import leader_path
from relguide.planning.words import candidates
from tests.situations import situations


@settings(max_examples=150)
@given(situation=situations(reach=80_000.0, with_intent=True))
def test_the_clearest_of_those_with_the_fewest_turns_is_chosen(situation: Situation) -> None:
    radius, leading = situation.pursuer.turn_radius, leader_path(situation)
    first = first_at_release(situation, radius, leading)
    kept = [
        (candidate.trajectory.turns, certify(candidate.trajectory, situation))
        for candidate in takewhile(
            lambda one: one.trajectory.turns <= 2, candidates(situation).at_release
        )
    ]
    holding = [(turns, one.least_separation) for turns, one in kept if one.holds]
    if first is None:
        assert not holding
        return
    candidate, opens = first
    chosen = certify(candidate.trajectory, situation)
    assert chosen.holds
    assert abs(candidate.time_to_converge - opens) < 1e-6
    fewest = min(turns for turns, _ in holding)
    assert candidate.trajectory.turns == fewest
    # within a metre of the clearest; each that took its place was more than that clearer
    assert chosen.least_separation >= max(least for t, least in holding if t == fewest) - 1.001

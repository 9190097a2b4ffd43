"""Paths that arrive just as the slot opens: exactly then, and clear of all."""

from itertools import islice
from math import inf

import numpy as np
import pytest

from relguide import Situation, certify
from relguide.kernels.contact.detour_delays import RELEASE_PIECES, clear_until_release
from relguide.planning.amid import WAITING, just_as_it_opens
from relguide.planning.others_table import others_of
from relguide.planning.words import candidates
from tests.skies import any_sky, margins


def arrives_as_it_opens(situation: Situation) -> None:
    found = candidates(situation)
    pieces = np.empty((RELEASE_PIECES, 2))
    assert clear_until_release(found.frame.pose, others_of(situation, found.frame), pieces)
    assert pieces[:, 1].sum() == pytest.approx(found.frame.t_release, abs=1e-6)
    made = just_as_it_opens(situation, inf)
    assert made is not None
    assert made[0].time_to_converge == pytest.approx(found.bound, abs=1e-4)
    assert min(margins(made[0].trajectory, situation).values()) > -0.02


def test_a_delay_is_clear_of_all() -> None:
    assert candidates(WAITING).reachable_at_release
    arrives_as_it_opens(WAITING)


@pytest.mark.parametrize("seed", [116, 132])
def test_where_no_delay_is_clear_a_turn_and_a_straight_before_one_help(seed: int) -> None:
    situation = any_sky(np.random.default_rng(seed), 8)
    delays = islice(candidates(situation).at_release, 100)
    assert not any(certify(delay.trajectory, situation).holds for delay in delays)
    arrives_as_it_opens(situation)

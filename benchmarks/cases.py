"""The situations that contenders are set; where all are, a straight leader, calm, V_L < V_P."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from benchmarks import draws
from benchmarks.leader_course import Course, course_of
from relguide import Situation
from relguide.planning.slot import SlotFrame, slot_frame
from tests.situations import golden

SEED = 2003
"""Of all that is drawn here: the same every time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A situation, and what is known of it."""

    name: str
    situation: Situation
    frame: SlotFrame
    optimum: float | None = None
    """The best time by an independent program [s], if there is one."""

    @property
    def unit(self) -> float:
        """R/V_P [s]."""
        return self.frame.radius / self.situation.pursuer.tas

    @property
    def ahead(self) -> float:
        """D: the leader ahead of the slot [R]."""
        return self.situation.slot_distance / self.frame.radius

    @property
    def course(self) -> Course:
        """What the leader flies."""
        return course_of(self.situation, self.frame)

    @property
    def from_slot(self) -> tuple[float, float]:
        """Where the leader is on its final leg: ahead of the slot and to its left [R]."""
        path = self.situation.leader.trajectory
        x, y = self.frame.to_slot(path.breakpoints()[-1].x, path.breakpoints()[-1].y)
        return x - self.frame.alpha * path.duration / self.unit, y

    @property
    def limit(self) -> float:
        """d_min [R]."""
        return self.situation.min_separation / self.frame.radius


def unlimited_cases(fresh: int) -> list[Case]:
    """The golden situations, and as many drawn ones; optima are those without the limit."""
    cases = [
        case_of(name, situation, answer["unlimited_time_s"])
        for name, situation, answer in _golden_cases()
        if "unlimited_time_s" in answer
    ]
    rng = np.random.default_rng(SEED)
    return cases + [case_of(f"fresh {i}", draws.anywhere(rng)) for i in range(fresh)]


def limited_cases(drawn: int, *, tight: bool) -> list[Case]:
    """Situations whose fastest way without the limit breaks it, R < d_min or R > d_min.

    Args:
        drawn: how many are drawn beside the golden ones of this kind.
        tight: whether R < d_min.
    """
    cases = [
        case_of(name, situation, answer["time_to_converge_s"])
        for name, situation, answer in _golden_cases()
        if answer["status"] in ("best_known", "optimal")
        and (situation.pursuer.turn_radius < situation.min_separation) == tight
        and draws.is_active(situation)
    ]
    rng = np.random.default_rng([SEED, tight])
    active = [draws.active(rng, tight=tight) for _ in range(drawn)]
    return cases + [case_of(f"drawn {i}", situation) for i, situation in enumerate(active)]


def equal_cases(drawn: int) -> list[Case]:
    """So many situations with D = d_min whose fastest way without the limit breaks it."""
    rng = np.random.default_rng([SEED, 2])
    active = [draws.active(rng, tight=i % 2 == 0, slot_at_limit=True) for i in range(drawn)]
    return [case_of(f"equal {i}", situation) for i, situation in enumerate(active)]


def turning_cases(drawn: int) -> list[Case]:
    """So many situations behind a leader that turns, half of them calm, where the limit binds."""
    rng = np.random.default_rng([SEED, 3])
    active = [
        draws.active(rng, tight=i % 2 == 0, intent=True, calm=i % 4 < 2) for i in range(drawn)
    ]
    return [case_of(f"turning {i}", situation) for i, situation in enumerate(active)]


def _golden_cases() -> list[tuple[str, Situation, dict[str, Any]]]:
    """Name, situation and answer of the golden cases that all contenders can be set."""
    return [
        (answer["id"], situation, answer)
        for situation, answer in golden("reference")
        if not situation.leader.intent and situation.leader.tas < situation.pursuer.tas
    ]


def case_of(name: str, situation: Situation, optimum: float | None = None) -> Case:
    """A situation as a case."""
    frame = slot_frame(situation, situation.leader.trajectory)
    return Case(name=name, situation=situation, frame=frame, optimum=optimum)

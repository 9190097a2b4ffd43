"""A flight of the campaign: drawn from its family and number alone, and printable as code."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from relguide.flying.flight import Scenario
from relguide.flying.orders import Command
from relguide.units import Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """What is flown."""

    family: str
    number: int
    scenario: Scenario
    orders: tuple[tuple[Second, Command], ...] = ()
    """Commands to the leader, each at its time, in order."""
    factors: Mapping[str, float] = field(default_factory=dict)
    """What the pursuer's constants really are, as multiples of what guidance believes."""

    def as_code(self) -> str:
        """The scenario and what comes with it, to paste; a recorded leader by its name."""
        scenario = self.scenario
        lines = [
            f"# {self.family} {self.number}: {scenario.description}",
            f"situation = {scenario.situation!r}",
            f"intent_known = {scenario.intent_known}",
            f"after_joining, duration_limit = {scenario.after_joining}, {scenario.duration_limit}",
            f"leader = {scenario.leader_ident!r}",
            *(f"at {t:.0f} s: {command!r}" for t, command in self.orders),
        ]
        if self.factors:
            lines.append(f"factors = {dict(self.factors)!r}")
        return "\n".join(lines)

"""What comes of asking for a path: one that may be flown, none and why, or that the present stays.

Each says what the planner did: whether the exact plan took its place, and why.
"""

from dataclasses import dataclass

from relguide.flying.guidance.commit.committed import Committed
from relguide.planning.acceptance import Refusal
from relguide.planning.outcome import NoPlan, Plan


@dataclass(frozen=True, slots=True, kw_only=True)
class Proposal:
    """A path that may be flown."""

    committed: Committed
    shown: Plan
    """As a crew sees it, from now on."""
    fell_back: bool
    """Whether an exact plan took the place of the planner's: its own may not be flown, or the
    branch before is kept."""
    refusal: Refusal | None
    """Why the planner's own plan is not flown; `None` if it was not asked, or may be flown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NoProposal:
    """Nothing to fly, and why."""

    answer: NoPlan
    fell_back: bool
    refusal: Refusal | None


@dataclass(frozen=True, slots=True, kw_only=True)
class NotBetter:
    """What was committed to stays."""

    fell_back: bool
    refusal: Refusal | None

"""Faults that once went unnoticed. Each keeps its name and must be noticed for good."""

from dataclasses import dataclass
from pathlib import Path

from tools.mutation.operators import Edit
from tools.mutation.sampling import Mutant, mutant


@dataclass(frozen=True, slots=True, kw_only=True)
class Named:
    """A fault given as text."""

    name: str
    file: str
    before: str
    """Occurs in the file exactly once."""
    after: str

    def mutant(self, root: Path) -> Mutant:
        """The fault, put in."""
        source = (root / self.file).read_bytes()
        before = self.before.encode()
        if source.count(before) != 1:
            raise ValueError(f"{self.name}: {self.file} must hold once: {self.before}")
        at = source.index(before)
        edit = Edit("named", at, at + len(before), self.after)
        return mutant(root, Path(self.file), edit)


NAMED = (
    Named(
        name="the contact of a turning leader strays",
        file="relguide/kernels/bounds/words/cells.py",
        before="return swing, swing + 0.5",
        after="return swing, 0.0 * swing + 0.0",
    ),
    Named(
        name="a root where the function only touches zero",
        file="relguide/kernels/base/roots.py",
        before="if abs(f_turn) <= TOUCH:",
        after="if abs(f_turn) < 0.0:",
    ),
    Named(
        name="of paths equally fast the one that keeps farther off",
        file="relguide/planning/leader_alone.py",
        before="certificate.least_separation > best[1].least_separation + 1.0",
        after="certificate.least_separation > best[1].least_separation + 1e9",
    ),
    Named(
        name="a second path of a word, faster than the plan",
        file="relguide/planning/alternatives.py",
        before="if twice or (branch in seen and not faster):",
        after="if twice or branch in seen:",
    ),
    Named(
        name="how much faster another plan must be",
        file="relguide/flying/guidance/settings.py",
        before="better_share: float = 0.005",
        after="better_share: float = 0.05",
    ),
    Named(
        name="from what bank on a turn is one",
        file="relguide/kernels/flight/second.py",
        before="BANKED = 0.05236",
        after="BANKED = 0.10472",
    ),
    Named(
        name="how fast the leader slows down",
        file="relguide/flying/abilities.py",
        before="slower = airframe.idle_deceleration(",
        after="slower = 2.0 * airframe.idle_deceleration(",
    ),
    Named(
        name="how far apart the points of a boundary arc are sent",
        file="relguide/flying/cards.py",
        before="VIA: Second = 5.0",
        after="VIA: Second = 10.0",
    ),
)

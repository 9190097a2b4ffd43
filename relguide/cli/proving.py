"""prove_after(planner): a planner that then looks for a better lower bound of the plan's time."""

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from relguide.planning.outcome import NoPlan, Plan, Planner
    from relguide.planning.prove import Bound
    from relguide.planning.situation import Situation

NEEDED = ("flying", "limited", "proofs")
"""The steps of `relguide.warm_up` that a proof needs."""
FIRST = "The first proof of an installation compiles what proofs need, once: a minute or two.\n"


def compile_proofs() -> None:
    """Compile what proofs need, if that is still to be done, with a bar."""
    from relguide.warm_up import missing, usual_jobs, warm_up

    left = missing(NEEDED)
    if left:
        sys.stderr.write(FIRST)
        warm_up(left, jobs=usual_jobs())


def prove_after(planner: "Planner", longest: float, *, shown: bool = True) -> "Planner":
    """A planner which then looks this long for a better lower bound.

    Args:
        planner: who plans.
        longest: how long to look [s]; 0 for not at all.
        shown: whether a bar shows how far it is.
    """
    if longest == 0.0:
        return planner
    from relguide.planning.acceptance import with_deadline
    from relguide.planning.deadline import end_of, left_until
    from relguide.planning.outcome import NoPlan
    from relguide.planning.progress import show_progress
    from relguide.planning.prove import prove

    def progress(bounds: "Iterator[Bound]") -> "Iterator[Bound]":
        return show_progress(
            bounds,
            title="proving",
            total=longest,
            done=lambda bound: bound.elapsed,
            state=lambda bound: f"gap {bound.gap:.3f} s",
        )

    def plan_and_prove(situation: "Situation", *, deadline: float | None = None) -> "Plan | NoPlan":
        until = end_of(deadline)
        planned = with_deadline(planner, left_until(until))(situation)
        if isinstance(planned, NoPlan):
            return planned
        left = left_until(until)
        seconds = longest if left is None else min(longest, left)
        return prove(planned, seconds=seconds, progress=progress if shown else iter)

    return plan_and_prove

"""Where the limit binds: plan() beside IPOPT from three to five starts, on the same situations."""

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from benchmarks.cases import Case
from benchmarks.starts import guesses
from benchmarks.timing import time_call
from benchmarks.transcription import Answer, Transcription, fly_path
from relguide import Plan, plan
from relguide.planning.progress import show_progress

REPEATS = 3
"""plan() is timed this often, IPOPT once."""
CUT = 0.01
"""IPOPT's paths may cut into d_min by this much between two nodes, in its favour [R]."""
BETTER = 0.1
"""IPOPT wins where it is faster by this much [s], the limit kept all the way."""
KEPT = 1e-4
"""What keeps the limit all the way may still be short of it by this much [R]: a metre or so."""
HEADINGS = (
    "", "cases", "median ms", "99 % ms", "best known to 0.5 s", "to 1 s", "later", "none",
)  # fmt: skip
"""Of the table."""
TIGHTENINGS = 4
"""How often an answer that cuts in is solved again with a wider limit."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Contest:
    """One situation."""

    case: Case
    ours: float
    """Arrival of plan() [s]; infinite where it gives none."""
    theirs: float
    """IPOPT's best [s]; infinite where none arrives and keeps clear."""
    honest: float
    """IPOPT's best that keeps the limit all the way, looked for only where `theirs` would win."""
    our_cpu: float
    """CPU time of plan() [s]."""
    their_cpu: float
    """CPU time of all its starts [s]."""

    @property
    def best(self) -> float:
        """The best arrival known [s]."""
        known = inf if self.case.optimum is None else self.case.optimum
        return min(self.ours, self.honest, known)


def measure(cases: list[Case], title: str) -> list[Contest]:
    """Set plan() and IPOPT all cases."""
    programme = Transcription(turns=max(len(case.course.turns) for case in cases))
    plan(cases[0].situation)  # compiles
    contests: list[Contest] = []
    for contest in show_progress(
        (contest_of(programme, case) for case in cases), title=title, total=len(cases),
        done=lambda _: len(contests),
    ):  # fmt: skip
        contests.append(contest)
    return contests


def contest_of(programme: Transcription, case: Case) -> Contest:
    """Set plan() and IPOPT one case."""
    our_cpu, answer = time_call(lambda: plan(case.situation), REPEATS)
    ours = answer.time_to_converge if isinstance(answer, Plan) else inf
    starts = guesses(case, programme.intervals)
    their_cpu, paths = time_call(lambda: [programme.solve(case, start) for start in starts], 1)
    answers = sorted((fly_path(case, path) for path in paths), key=lambda answer: answer.time)
    counted = [answer for answer in answers if answer.arrives and answer.short < CUT]
    return Contest(
        case=case,
        ours=ours,
        theirs=min((answer.time for answer in counted), default=inf),
        honest=min((_honest(programme, case, a, ours - BETTER) for a in counted), default=inf),
        our_cpu=our_cpu,
        their_cpu=their_cpu,
    )


def _honest(programme: Transcription, case: Case, answer: Answer, beat: float) -> float:
    """Its arrival with the limit kept between the nodes too; infinite if that is not below `beat`.

    The limit is widened by what the path cuts into it, and solved again from there.
    """
    margin = 0.0
    for _ in range(TIGHTENINGS):
        if answer.time >= beat or not answer.arrives:
            return inf
        if answer.short < KEPT:
            return answer.time
        margin += 1.1 * answer.short
        answer = fly_path(case, programme.solve(case, answer.path, margin=margin))
    return inf


def won_by_ipopt(contests: list[Contest]) -> list[Contest]:
    """Where IPOPT is faster than plan(), by a path that stands up to the certificate."""
    return sorted(
        (c for c in contests if c.honest < c.ours - BETTER), key=lambda c: c.honest - c.ours
    )


def table(groups: dict[str, list[Contest]]) -> Table:
    """What was measured, for people."""
    drawn = Table(title="Where the limit binds; CPU time")
    for heading in HEADINGS:
        drawn.add_column(heading, justify="right" if heading else "left")
    for cells in table_cells(groups):
        drawn.add_row(*cells)
    return drawn


def table_cells(groups: dict[str, list[Contest]]) -> list[list[str]]:
    """Name, cases, median and 99 % [ms], how many are within 0.5 s and 1 s, later, without any.

    Counted are the situations in which somebody found a way.
    """
    cells = []
    for group, all_of_it in groups.items():
        contests = [contest for contest in all_of_it if contest.best < inf]
        starts = "five" if any(contest.case.course.turns for contest in contests) else "three"
        ours = [contest.ours - contest.best for contest in contests]
        theirs = [contest.theirs - contest.best for contest in contests]
        for name, cpu, late in (
            (f"plan(), {group}", [c.our_cpu for c in all_of_it], ours),
            (f"IPOPT from {starts} starts, {group}", [c.their_cpu for c in all_of_it], theirs),
        ):
            lateness = np.array(late)
            cells.append(
                [
                    name,
                    f"{len(contests)}",
                    f"{np.median(cpu) * 1e3:,.1f}",
                    f"{np.percentile(cpu, 99) * 1e3:,.1f}",
                    _part(lateness <= 0.5),
                    _part(lateness <= 1.0),
                    f"{np.sum((lateness > 1.0) & (lateness < inf))}",
                    f"{np.sum(lateness == inf)}",
                ]
            )
    return cells


def _part(holds: NDArray[np.bool_]) -> str:
    return f"{np.mean(holds):.0%}" if len(holds) else "–"

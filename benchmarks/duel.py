"""Does direct transcription find a way round the leader that the search misses?

    python -m benchmarks.duel --count 300 --intent 0.7 --seed 5

draws situations in which the separation limit is active, half of them with R < d_min, a share of
them with a leader that turns, half of these in wind. Each is planned, and set to IPOPT from three
starts, five where the leader turns. What IPOPT finds sooner counts if it keeps d_min all along, as
`detours` judges it; such a plan is then to be proved for a second, and what is claimed of it is
said. Where plan() finds none another situation is drawn. Each is told as it ends, and in the end
the ten in which the plan does worst, as code to paste. Seconds for each situation.
"""

import argparse
import sys
from collections.abc import Iterator
from math import inf

import numpy as np
from rich.console import Console

from benchmarks import detours, draws
from benchmarks.cases import case_of
from benchmarks.detours import BETTER, Contest, contest_of
from benchmarks.options import positive, share
from benchmarks.transcription import Transcription
from relguide import Plan, plan, prove
from relguide.planning.progress import show_progress

MOST_TURNS = 2
"""Of a leader that `draws` draws."""
PROVED = 1.0
"""How long a plan that came late is to be proved [s]."""
LISTED = 10


def main(arguments: list[str] | None = None) -> int:
    """Draw, set both, report; 1 if a plan came late and was then called optimal."""
    wanted = _parser().parse_args(arguments)
    contests: list[Contest] = []
    for contest in show_progress(
        contests_of(wanted.count, seed=wanted.seed, intent=wanted.intent),
        title="Setting plan() and IPOPT",
        total=wanted.count,
        done=lambda _: len(contests),
    ):
        contests.append(contest)
        sys.stdout.write(f"{_told(contest)}\n")
        sys.stdout.flush()
    return report(contests)


def contests_of(count: int, *, seed: int, intent: float) -> Iterator[Contest]:
    """So many in which plan() finds a path."""
    programme, case, found = Transcription(turns=MOST_TURNS), 0, 0
    while found < count:
        rng = np.random.default_rng([seed, case])
        turns, calm = bool(rng.random() < intent), bool(rng.random() < 0.5)
        situation = draws.active(rng, tight=case % 2 == 0, intent=turns, calm=calm)
        name, case = f"{seed}/{case}", case + 1
        if isinstance(plan(situation), Plan):
            found += 1
            yield contest_of(programme, case_of(name, situation))


def report(contests: list[Contest]) -> int:
    """Print a table, the worst ten and what is proved of what came late."""
    console = Console(width=118)
    turning = [c for c in contests if c.case.situation.leader.intent]
    straight = [c for c in contests if not c.case.situation.leader.intent]
    groups = {"straight leader": straight, "turning leader": turning}
    console.print(detours.table({name: group for name, group in groups.items() if group}))
    worst = sorted(contests, key=lambda c: (min(c.honest, c.theirs) - c.ours, c.case.name))
    status = 0
    for contest in worst[:LISTED]:
        late = contest.ours - contest.honest if contest.honest < inf else 0.0
        told = f"{late:.2f} s late" if late > BETTER else "not late"
        if late > BETTER:
            claim, wrong = _claim(contest)
            told += f", {claim}"
            status |= wrong
        console.print(
            f"{_told(contest)}: {told}  {contest.case.situation!r}",
            soft_wrap=True,
            highlight=False,
        )
    return status


def _told(contest: Contest) -> str:
    kept = "" if contest.honest == inf else f", {contest.honest:.2f} s with d_min kept"
    return f"{contest.case.name}: plan() {contest.ours:.2f} s, IPOPT {contest.theirs:.2f} s{kept}"


def _claim(contest: Contest) -> tuple[str, int]:
    """What is said of a late plan after a second of proof; 1 if that is wrong."""
    planned = plan(contest.case.situation)
    assert isinstance(planned, Plan)
    proved = prove(planned, seconds=PROVED)
    time, bound = proved.time_to_converge, proved.optimality.lower_bound
    wrong = bound > contest.honest + BETTER
    return (
        f"after {PROVED:g} s of proof {time:.2f} s, none faster than {bound:.2f} s, "
        f"proof: {proved.optimality.proof}",
        int(wrong),
    )


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.duel",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", type=positive, default=100, help="how many situations")
    parser.add_argument("--seed", type=positive, default=1)
    parser.add_argument("--intent", type=share, default=0.7, help="share of turning leaders, 0…1")
    return parser


if __name__ == "__main__":
    sys.exit(main())

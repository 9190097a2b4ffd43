"""How much better is the search with the limit when it looks a hundred times harder?

    python -m benchmarks.limit --count 2000 --effort 100 --intent 0.25 --resume limit.jsonl

draws situations in which the separation limit is active, half of them with R < d_min, a share of
them with a leader that turns, in wind, and a share with D = d_min. Each is planned as the library
does and again with the disc scanned that many times as finely. What is worse by more than 0.1 s is
listed, the worst first, as code to paste. With --resume what is finished is kept in a file, and not
done again.
"""

import argparse
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from functools import partial
from hashlib import sha256
from json import JSONDecodeError, dumps, loads
from math import inf
from os import cpu_count
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal
from time import thread_time

import numpy as np
from rich.console import Console
from rich.table import Table

import relguide.planning.constrained_path as search
from benchmarks import draws
from benchmarks.options import positive, share
from relguide import NoPlan, Plan, Situation, plan
from relguide.planning.progress import show_progress

WORSE = 0.1
"""A plan this much slower than one found with more effort is listed [s]."""
NOISE = 1e-6
"""Closer than this, two answers are the same [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """What a file of finished cases belongs to."""

    seed: int
    effort: int
    intent: float
    """Share of the leaders that turn, in wind."""
    equal: float
    """Share with D = d_min."""
    planner: str
    """A digest of the planner's sources: cases of two versions are not mixed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """One situation, planned twice."""

    case: int
    tight: bool
    """Whether R < d_min."""
    intent: bool
    """Whether the leader turns, in wind."""
    situation: str
    """As code to paste."""
    ours_s: float | None
    """Arrival; None without a plan."""
    harder_s: float | None
    """Arrival with more effort."""
    ours_cpu_s: float
    harder_cpu_s: float

    @property
    def loss(self) -> float:
        """How much later the plan arrives than one found with more effort [s]."""
        ours = inf if self.ours_s is None else self.ours_s
        harder = inf if self.harder_s is None else self.harder_s
        return 0.0 if ours == harder else ours - harder

    @property
    def stratum(self) -> str:
        """Which kind of situation it is."""
        corner = "R < d_min" if self.tight else "R > d_min"
        return f"{corner}, {'intent and wind' if self.intent else 'straight, calm'}"


def main(arguments: list[str] | None = None) -> int:
    """Run the comparison and print it; 1 if something is listed."""
    wanted = _parser().parse_args(arguments)
    run = Run(
        seed=wanted.seed, effort=wanted.effort, intent=wanted.intent, equal=wanted.equal,
        planner=_planner_digest(),
    )  # fmt: skip
    try:
        done = _read_outcomes(wanted.resume, run) if wanted.resume else []
    except ValueError as refusal:
        print(refusal, file=sys.stderr)
        return 2
    known = {outcome.case for outcome in done}
    missing = [case for case in range(wanted.count) if case not in known]
    outcomes = [outcome for outcome in done if outcome.case < wanted.count]
    try:
        for outcome in _outcomes(missing, run, wanted.processes):
            outcomes.append(outcome)
            if wanted.resume:
                with wanted.resume.open("a") as file:
                    file.write(dumps(asdict(outcome)) + "\n")
    except KeyboardInterrupt:
        print(f"Stopped after {len(outcomes)} of {wanted.count}.", file=sys.stderr)
    return report(outcomes, wanted.effort)


def _outcomes(cases: list[int], run: Run, processes: int) -> Iterator[Outcome]:
    """Finished cases, as they come."""
    compare = partial(
        plan_twice, seed=run.seed, effort=run.effort, intent=run.intent, equal=run.equal
    )
    # Ctrl-C is ours to handle: the workers are told when they have finished a case
    pool = ProcessPoolExecutor(processes, initializer=signal, initargs=(SIGINT, SIG_IGN))
    try:
        finished = enumerate(as_completed([pool.submit(compare, case) for case in cases]), 1)
        for _, future in show_progress(
            finished, title="Looking harder", total=len(cases), done=lambda pair: pair[0]
        ):
            yield future.result()
    finally:
        pool.shutdown(cancel_futures=True)


def plan_twice(case: int, *, seed: int, effort: int, intent: float, equal: float = 0.0) -> Outcome:
    """Draw a situation, which its number alone decides, and plan it twice."""
    rng = np.random.default_rng([seed, case])
    tight, turns = case % 2 == 0, bool(rng.random() < intent)
    slot_at_limit = bool(rng.random() < equal) if equal > 0.0 else False
    situation = draws.active(rng, tight=tight, intent=turns, slot_at_limit=slot_at_limit)
    usual = search.BEARINGS, search.TURNING_BEARINGS
    ours, ours_cpu = _plan_timed(situation)
    try:
        search.BEARINGS, search.TURNING_BEARINGS = (effort * bearings for bearings in usual)
        harder, harder_cpu = _plan_timed(situation)
    finally:
        search.BEARINGS, search.TURNING_BEARINGS = usual
    return Outcome(
        case=case, tight=tight, intent=turns, situation=repr(situation),
        ours_s=ours, harder_s=harder, ours_cpu_s=ours_cpu, harder_cpu_s=harder_cpu,
    )  # fmt: skip


def _plan_timed(situation: Situation) -> tuple[float | None, float]:
    started = thread_time()
    match plan(situation):
        case Plan(time_to_converge=time):
            return time, thread_time() - started
        case NoPlan():
            return None, thread_time() - started


def _read_outcomes(file: Path, run: Run) -> list[Outcome]:
    """What a file holds; begins one if there is none.

    Raises:
        ValueError: if it belongs to another run.
    """
    if not file.exists():
        file.write_text(dumps(asdict(run)) + "\n")
        return []
    text = file.read_text()
    whole = text[: text.rfind("\n") + 1]
    first, *lines = whole.splitlines() or [""]
    try:
        begun = Run(**loads(first))
        outcomes = [Outcome(**loads(line)) for line in lines]
    except (JSONDecodeError, TypeError) as broken:
        raise ValueError(f"{file} is not a file of this command: name another.") from broken
    if begun != run:
        raise ValueError(
            f"{file} was begun with seed {begun.seed}, effort {begun.effort}, intent "
            f"{begun.intent:g} and equal {begun.equal:g}, by "
            f"{'this' if begun.planner == run.planner else 'another'} version of the planner: "
            "name another file, or ask for the same."
        )
    if whole != text:  # a line cut short when the run was stopped: its case is done again
        file.write_text(whole)
    return outcomes


def _planner_digest() -> str:
    digest = sha256()
    for folder in ("kernels", "planning"):
        for source in sorted((Path(search.__file__).parents[1] / folder).rglob("*.py")):
            digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def report(outcomes: list[Outcome], effort: int) -> int:
    """Print a table by kind and the list of the worst; 1 if there is one."""
    worse = sorted((o for o in outcomes if o.loss > WORSE), key=lambda o: -o.loss)
    strata = sorted({outcome.stratum for outcome in outcomes})
    table = Table(title=f"{len(outcomes)} active situations, {effort} times the effort beside")
    for heading in (
        "", "cases", f"worse by > {WORSE:g} s", "found nothing", "worst s", "median ms", "99 % ms",
    ):  # fmt: skip
        table.add_column(heading, justify="right" if heading else "left")
    for name in [*strata, "all"]:
        kind = [o for o in outcomes if name in ("all", o.stratum)]
        if not kind:
            continue
        late = [o.loss for o in kind if o.loss < inf]
        cpu = np.array([o.ours_cpu_s for o in kind]) * 1e3
        table.add_row(
            name,
            str(len(kind)),
            str(sum(o.loss > WORSE for o in kind)),
            str(sum(o.loss == inf for o in kind)),
            f"{max([0.0, *late]):.3f}",
            f"{np.median(cpu):.1f}",
            f"{np.percentile(cpu, 99):.1f}",
        )
    Console(width=110).print(table)
    behind = sum(o.loss < -NOISE for o in outcomes)
    if behind:
        print(
            f"more effort found less in {behind}, by up to {-min(o.loss for o in outcomes):.3g} s"
        )
    for outcome in worse:
        print(f"{outcome.loss:8.2f} s  {outcome.situation}")
    return 1 if worse else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.limit",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--count", type=positive, default=200, help="how many situations")
    parser.add_argument("--effort", type=positive, default=100, help="how many times the bearings")
    parser.add_argument("--seed", type=positive, default=1)
    parser.add_argument("--intent", type=share, default=0.0, help="share of turning leaders, 0…1")
    parser.add_argument("--equal", type=share, default=0.0, help="share with D = d_min, 0…1")
    parser.add_argument("--processes", type=positive, default=cpu_count() or 1)
    parser.add_argument("--resume", type=Path, metavar="FILE", help="keeps finished cases here")
    return parser


if __name__ == "__main__":
    sys.exit(main())

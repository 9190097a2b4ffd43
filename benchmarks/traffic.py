"""How good are plans amid traffic, beside ten thousand detours tried one by one?

    python -m benchmarks.traffic --count 300 --seed 2 --keep

draws situations with 1 to 20 others anywhere in 140 km, all straight, in calm air, 5 NM to be kept.
What `plan` answers is compared with the best of 10,000 detours: a first turn of up to 360° to
either side, a straight of up to 15 minutes, and then any word to the slot. Those are sampled, not
proved, by code that shares nothing with the search but the words, and certified in order of their
arrival. Every plan is sampled at 10 Hz.
"""

import argparse
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from math import cos, hypot, inf, pi, radians, sin
from os import cpu_count
from time import process_time

import numpy as np
from numba import njit
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from benchmarks.options import positive
from benchmarks.tables import write_table
from relguide import Leader, NoPlan, Plan, Pursuer, Situation, plan
from relguide.kernels.base.records import Pose
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, solve
from relguide.planning.aircraft import Traffic
from relguide.planning.candidate import assemble
from relguide.planning.certificate import FOLLOWED, certify
from relguide.planning.progress import show_progress
from relguide.planning.slot import slot_frame
from relguide.units import NM, Second

COUNTS = (1, 3, 5, 10, 20)
"""Others in a situation."""
LIMIT = 5.0 * NM
"""To be kept from each [m]."""
HALF = 70_000.0
"""They are drawn in a square with so long a half side [m]."""
LATE: Second = 1.0
"""A plan that arrives this much later than the best detour is late."""
TURNS, STRAIGHTS, STEP = 50, 100, 9.0
"""First turns to a side, lengths of the straight, and how much longer each is [s]."""
_SAMPLE = 0.03  # of a detour, about every second and a half [R/V_P]
_KEPT = 200  # detours that are certified at most
HEADINGS = (
    "others", "situations", "in the way", "% no later than the detours + 1 s", "none, detours too",
    "none, but a detour", "a plan, no detour", "CPU p50 ms", "CPU p99 ms", "broken at 10 Hz",
)  # fmt: skip
"""Of the table."""
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One situation, planned and searched."""

    number: int
    blocked: bool
    """Whether the plan for the leader alone comes too close to one of the others."""
    ours: Second
    """Arrival; infinite without a plan."""
    detour: Second
    """The same of the best detour; not searched where the plan for the leader alone is clear."""
    cpu: Second
    margin: float
    """Least distance beyond what is to be kept, at 10 Hz [m]."""

    @property
    def late(self) -> Second:
        """How much later than the best detour."""
        return 0.0 if self.ours == self.detour else self.ours - self.detour


def draw(rng: np.random.Generator, count: int) -> Situation:
    """One situation that starts clear of all."""
    tas = rng.uniform(200.0, 250.0)
    leader = Leader(x=0.0, y=0.0, heading=0.0, tas=tas * rng.uniform(0.6, 0.95))
    while True:
        x, y = rng.uniform(-HALF, HALF, 2).tolist()
        if hypot(x, y) > LIMIT:
            break
    others: list[Traffic] = []
    while len(others) < count:
        there = rng.uniform(-HALF, HALF, 2).tolist()
        if hypot(there[0] - x, there[1] - y) > LIMIT:
            others.append(
                Traffic(
                    ident=f"T{len(others) + 1}", x=there[0], y=there[1],
                    heading=rng.uniform(0.0, 2.0 * pi), tas=rng.uniform(150.0, 260.0),
                    min_separation=LIMIT,
                )
            )  # fmt: skip
    return Situation(
        pursuer=Pursuer(
            x=x, y=y, heading=rng.uniform(0.0, 2.0 * pi), tas=tas, max_bank=radians(25.0)
        ),
        leader=leader,
        slot_distance=rng.uniform(10_000.0, 20_000.0),
        min_separation=LIMIT,
        others=tuple(others),
    )


def best_detour(situation: Situation) -> Second:
    """Arrival of the best of 10,000 detours that certifies; infinite if none does."""
    frame = slot_frame(situation, situation.leader.trajectory)
    scale = frame.radius / situation.pursuer.tas
    moving = [
        (*frame.to_slot(one.x, one.y), one.tas / situation.pursuer.tas, frame.heading - one.heading)
        for one in (situation.leader, *situation.others)
    ]
    table = np.array([(x, y, v * cos(h), v * sin(h)) for x, y, v, h in moving])
    found = np.full((_KEPT, 8), inf)
    _detours(
        Pose(frame.x, frame.y, frame.h), frame.alpha, table, LIMIT / frame.radius, STEP / scale,
        FOLLOWED / scale, found,
    )  # fmt: skip
    for arrival, side, turned, straight, word, *lasts in found.tolist():
        if arrival == inf:
            break
        signs = [side, 0.0, *SIGNS[int(word)].tolist()]
        path = assemble(situation, frame, signs, [turned, straight, *lasts], "").trajectory
        if certify(path, situation).holds:
            return path.duration
    return inf


@njit(cache=True, nogil=True)
def _detours(
    start: Pose, alpha: float, table: Floats, limit: float, step: float, follow: float,
    found: Floats,
) -> None:  # fmt: skip
    """The first detours that samples say are clear: arrival, side, turn, straight and the word.

    Slot frame: lengths in R, times in R/V_P. `table` has place and velocity of each aircraft, the
    leader as the first. `found` takes them in order of arrival, from rows that are infinite.
    """
    rows = np.empty((MAX_ROWS, 5))
    turn = 2.0 * pi / TURNS
    for side in (1.0, -1.0):
        here, then = start, 0.0
        for j in range(TURNS + 1):
            if j > 0:
                if not _is_clear(here, side, turn, then, table, limit):
                    break
                here, then = _flown(here, side, turn), then + turn
            place, now = here, then
            for k in range(STRAIGHTS):
                if k > 0:
                    if not _is_clear(place, 0.0, step, now, table, limit):
                        break
                    place, now = _flown(place, 0.0, step), now + step
                seen = Pose(place.x - alpha * now, place.y, place.h % (2.0 * pi))
                for row in rows[: solve(seen, alpha, 0.0, rows)]:
                    arrival = now + row[0]
                    if arrival >= found[-1, 0]:
                        break
                    if _arrives_clear(place, now, row, alpha, table, limit, follow):
                        at = len(found) - 1
                        while at > 0 and found[at - 1, 0] > arrival:
                            found[at] = found[at - 1]
                            at -= 1
                        found[at, 0], found[at, 1] = arrival, side
                        found[at, 2], found[at, 3] = turn * j, step * k
                        found[at, 4:] = row[1:]


@njit(cache=True, nogil=True)
def _flown(pose: Pose, sign: float, amount: float) -> Pose:
    """The end of a turn or of a straight."""
    if sign == 0.0:
        return Pose(pose.x + amount * cos(pose.h), pose.y + amount * sin(pose.h), pose.h)
    end = pose.h + sign * amount
    x = pose.x + sign * (sin(end) - sin(pose.h))
    return Pose(x, pose.y - sign * (cos(end) - cos(pose.h)), end)


@njit(cache=True, nogil=True)
def _is_clear(
    pose: Pose, sign: float, amount: float, t: float, table: Floats, limit: float
) -> bool:
    """Whether samples of a piece keep the limit from all."""
    steps = int(amount / _SAMPLE) + 1
    for k in range(1, steps + 1):
        flown = amount * k / steps
        there = _flown(pose, sign, flown)
        for one in table:
            dx = there.x - one[0] - one[2] * (t + flown)
            dy = there.y - one[1] - one[3] * (t + flown)
            if dx * dx + dy * dy < limit * limit:
                return False
    return True


@njit(cache=True, nogil=True)
def _arrives_clear(
    pose: Pose, t: float, row: Floats, alpha: float, table: Floats, limit: float, follow: float
) -> bool:
    """Whether samples of a word, and of the slot after it, keep the limit from all."""
    for k in range(3):
        sign, amount = SIGNS[int(row[1]), k], row[2 + k]
        if not _is_clear(pose, sign, amount, t, table, limit):
            return False
        pose, t = _flown(pose, sign, amount), t + amount
    steps = int(follow / _SAMPLE) + 1
    for k in range(steps + 1):
        time = t + follow * k / steps
        for one in table[1:]:
            dx, dy = alpha * time - one[0] - one[2] * time, one[1] + one[3] * time
            if dx * dx + dy * dy < limit * limit:
                return False
    return True


def least_margin(planned: Plan) -> float:
    """Least distance beyond what is to be kept, at 10 Hz on the way and in the slot [m]."""
    situation, time = planned.situation, planned.time_to_converge
    t = np.append(np.arange(0.0, time, 0.1), time)
    way = planned.trajectory.sample(t)
    last = planned.trajectory.pose_at(time)
    leader = situation.leader
    after = np.arange(0.1, FOLLOWED, 0.1)
    east, north = leader.tas * sin(leader.heading), leader.tas * cos(leader.heading)
    x = np.append(way.x, last.x + east * after)
    y = np.append(way.y, last.y + north * after)
    t = np.append(t, time + after)
    least = inf
    for one in (leader, *situation.others):
        dx = x - one.x - one.tas * sin(one.heading) * t
        dy = y - one.y - one.tas * cos(one.heading) * t
        least = min(least, float(np.hypot(dx, dy).min()))
    return least - LIMIT


def judge(number: int, count: int, seed: int) -> Case:
    """One situation, by its number."""
    situation = draw(np.random.default_rng((seed, count, number)), count)
    plan(situation)
    started = process_time()
    ours = plan(situation)
    cpu = process_time() - started
    alone = plan(replace(situation, others=()))
    clear = isinstance(alone, NoPlan) or certify(alone.trajectory, situation).holds
    time = ours.time_to_converge if isinstance(ours, Plan) else inf
    return Case(
        number=number,
        blocked=not clear,
        ours=time,
        detour=time if clear else best_detour(situation),
        cpu=cpu,
        margin=least_margin(ours) if isinstance(ours, Plan) else inf,
    )


def measure(count: int, seed: int, processes: int) -> Iterator[tuple[int, list[Case]]]:
    """So many situations for each of `COUNTS`."""
    with ProcessPoolExecutor(processes) as pool:
        for others in COUNTS:
            cases = pool.map(partial(judge, count=others, seed=seed), range(count), chunksize=4)
            yield (
                others,
                list(show_progress(cases, title=f"{others} others", total=count, done=_one)),
            )


def _one(_: Case) -> float:
    """Each counts the same."""
    return 1.0


def cells(others: int, cases: list[Case]) -> list[str]:
    """A row of the table."""
    blocked = [case for case in cases if case.blocked]
    found = [case for case in blocked if case.detour < inf]
    in_time = sum(case.late <= LATE for case in found)
    cpu = np.percentile([case.cpu for case in cases], (50.0, 99.0)) * 1e3
    none = [case for case in blocked if case.ours == inf]
    return [
        str(others),
        f"{len(cases):,}",
        f"{len(blocked):,}",
        f"{100.0 * in_time / max(len(found), 1):.1f}",
        str(sum(case.detour == inf for case in none)),
        str(sum(case.detour < inf for case in none)),
        str(sum(case.ours < inf == case.detour for case in blocked)),
        f"{cpu[0]:.1f}",
        f"{cpu[1]:.1f}",
        str(sum(case.margin < -0.02 for case in cases)),
    ]


def main(arguments: list[str] | None = None) -> int:
    """Measure, print the table and the ten that are latest; 1 if a plan is broken."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.traffic", description=__doc__)
    parser.add_argument("--count", metavar="N", type=positive, default=100)
    parser.add_argument("--seed", metavar="N", type=positive, default=1)
    parser.add_argument("--processes", metavar="N", type=positive, default=cpu_count() or 1)
    parser.add_argument("--keep", action="store_true", help="write benchmarks/results/traffic.csv")
    given = parser.parse_args(arguments)
    lines, latest = [], []
    for others, cases in measure(given.count, given.seed, given.processes):
        lines.append(cells(others, cases))
        latest += [(case.late, others, case) for case in cases if case.late > LATE]
    table = Table(title="Amid traffic")
    for heading in HEADINGS:
        table.add_column(heading, justify="right")
    for line in lines:
        table.add_row(*line)
    console = Console(width=140)
    console.print(table)
    for _, others, case in sorted(latest, key=lambda late: -late[0])[:10]:
        console.print(
            f"{others} others, situation {case.number}: {case.ours:.1f} s, a detour "
            f"{case.detour:.1f} s"
        )
    if given.keep:
        write_table("traffic.csv", HEADINGS, lines)
    return int(any(line[-1] != "0" for line in lines))


if __name__ == "__main__":
    sys.exit(main())

"""Plans amid traffic beside what peers do: plan(), BlueSky's MVP, and a search over fixes.

    python -m benchmarks.amid_others --amid 20

- MVP [Hoekstra02] keeps one aircraft clear, second by second: BlueSky flies it as it comes, in a
  closed loop with the plan to the slot that knows of no others, asked anew each second.
- The search over fixes follows what ICAROUS publishes of its path planner: fixes at five bearings
  and four ranges about the start and the goal, paths of Dubins between them, traffic on straight
  plans, minima enlarged by a tenth. Here the last leg, to the moving slot, is an exact plan.

They were made for other tasks: neither has a goal that moves, nor a time to be least.
"""

import argparse
import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from math import cos, degrees, hypot, inf, radians, sin
from pathlib import Path
from subprocess import PIPE, CalledProcessError, Popen
from time import process_time

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.draws import amid_traffic
from benchmarks.options import positive
from benchmarks.simulators import FOLDER, PEERS, absence, install
from relguide import (
    Air,
    Arc,
    Leader,
    NoPlan,
    Plan,
    Pursuer,
    Situation,
    Straight,
    Traffic,
    certify,
    plan,
)
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.amid import load_kernels
from relguide.planning.progress import show_progress
from relguide.planning.trajectory import LEFT, RIGHT, Segment, Trajectory
from relguide.units import DEG, KT, NM, Second

COUNTS = (1, 5, 10, 20)
"""How many others there are."""
SCRIPT = Path(__file__).with_name("mvp.py")
ALTITUDE = 9449.0
"""Where BlueSky flies; its speeds are given as calibrated ones [m]."""
AT_SLOT = 2000.0
"""BlueSky's pursuer has joined when it is so near the slot [m] …"""
ON_HEADING = 20.0 * DEG
"""… and so near the leader's heading [rad]: from there the leader's route is captured."""
GIVEN = 900.0
"""So much longer than a plan without others it may take [s]."""
INSIDE = 0.99
"""A separation below so much of the minimum is lost."""
BEARINGS = tuple(radians(bearing) for bearing in (-60.0, -30.0, 0.0, 30.0, 60.0))
"""Of fixes, from the heading at the start and from the leader's heading at the goal [rad]."""
RANGES = (10e3, 20e3, 40e3, 60e3)
"""Of fixes, from the start and from the goal [m]."""
ENLARGED = 1.1
"""What the search over fixes multiplies minima by."""
HEADINGS = ("others", "", "joined, clear", "lost", "later, median s", "95 % s", "CPU ms a case")


@dataclass(frozen=True, slots=True, kw_only=True)
class Flown:
    """What became of one situation."""

    joined: Second
    """When; infinite if it is not."""
    kept: bool
    """Whether all minima were kept."""
    cpu: Second
    """CPU time it took."""


def by_plan(situation: Situation) -> Flown:
    """plan()."""
    since = process_time()
    answer = plan(situation)
    cpu = process_time() - since
    joined = answer.time_to_converge if isinstance(answer, Plan) else inf
    kept = not isinstance(answer, Plan) or certify(answer.trajectory, situation).holds
    return Flown(joined=joined, kept=kept, cpu=cpu)


# ---- a search over fixes ---------------------------------------------------------------------


def by_fixes(situation: Situation) -> Flown:
    """The fastest path by way of no fix, of one, or of one at each end."""
    since = process_time()
    wider = replace(
        situation,
        others=tuple(
            replace(other, min_separation=ENLARGED * other.min_separation)
            for other in situation.others
            if isinstance(other, Traffic)
        ),
    )
    alone = replace(situation, others=())
    best = inf
    for prefix in prefixes(alone):
        flown = alone.pursuer.flying(prefix)
        if flown.duration >= best:
            continue
        onward = plan(moved(alone, flown))
        if isinstance(onward, NoPlan):
            continue
        whole = alone.pursuer.flying((*prefix, *onward.trajectory.segments))
        if whole.duration < best and certify(whole, wider).holds:
            best = whole.duration
    return Flown(joined=best, kept=True, cpu=process_time() - since)


def prefixes(alone: Situation) -> Iterator[tuple[Segment, ...]]:
    """What is flown before the last leg: nothing, to a fix near the start, one near the goal."""
    yield ()
    own, free = alone.pursuer, plan(alone)
    if isinstance(free, NoPlan):
        return
    goal = free.trajectory.breakpoints()[-1]
    firsts = [
        to_point(own, *beside(own.x, own.y, own.heading + b, r)) for b in BEARINGS for r in RANGES
    ]
    lasts = [
        beside(goal.x, goal.y, goal.heading + radians(180.0) + b, r)
        for b in BEARINGS
        for r in RANGES
    ]
    for first in ((), *(segments for segments in firsts if segments)):
        if first:
            yield first
        there = at_end(own, first)
        for last in lasts:
            second = to_point(there, *last)
            if second:
                yield (*first, *second)


def fixes(x: float, y: float, heading: float) -> list[tuple[float, float]]:
    """The fixes about a point [m], on either side of a heading [rad]."""
    return [beside(x, y, heading + bearing, away) for bearing in BEARINGS for away in RANGES]


def beside(x: float, y: float, bearing: float, away: float) -> tuple[float, float]:
    """A point at a bearing [rad] and a distance [m] from another."""
    return x + away * sin(bearing), y + away * cos(bearing)


def at_end(own: Pursuer, segments: tuple[Segment, ...]) -> Pursuer:
    """The pursuer where segments lead it."""
    end = own.flying(segments).breakpoints()[-1]
    return replace(own, x=end.x, y=end.y, heading=end.heading)


def to_point(own: Pursuer, x: float, y: float) -> tuple[Segment, ...]:
    """A turn and a straight to a point; nothing if that lies within the turn."""
    found: list[tuple[Segment, ...]] = []
    radius = own.turn_radius
    for turn, side in ((LEFT, -1.0), (RIGHT, 1.0)):
        cx = own.x + side * radius * cos(own.heading)
        cy = own.y - side * radius * sin(own.heading)
        away = hypot(x - cx, y - cy)
        if away <= radius:
            continue
        # the tangent from the circle to the point, flown the circle's way round
        course = np.arctan2(x - cx, y - cy) + side * np.arcsin(radius / away)
        angle = float((side * (course - own.heading)) % (2.0 * np.pi))
        length = float(np.sqrt(away * away - radius * radius))
        arc = Arc(turn=turn, turn_angle=angle, radius=radius)
        found.append((arc, Straight(length=length)))
    return min(found, key=lambda path: sum(piece.length for piece in path), default=())


def moved(alone: Situation, flown: Trajectory) -> Situation:
    """The situation once a path is flown: the leader keeps straight."""
    end, leader, t = flown.breakpoints()[-1], alone.leader, flown.duration
    x, y = beside(leader.x, leader.y, leader.heading, leader.tas * t)
    own = replace(alone.pursuer, x=end.x, y=end.y, heading=end.heading)
    return replace(alone, pursuer=own, leader=replace(leader, x=x, y=y))


# ---- BlueSky ---------------------------------------------------------------------------------


@contextmanager
def bluesky(python: str) -> Iterator[Popen[str]]:
    """BlueSky, ready for flights."""
    with Popen([python, "-P", str(SCRIPT)], stdin=PIPE, stdout=PIPE, text=True) as process:
        yield process
        process.kill()


def by_mvp(peer: "Popen[str]", situation: Situation) -> Flown:
    """BlueSky's MVP, and the plan without others in between."""
    alone, since = replace(situation, others=()), process_time()
    free = plan(alone)
    if isinstance(free, NoPlan):
        return Flown(joined=inf, kept=True, cpu=0.0)
    send(peer, json.dumps(question(situation)))
    kept, until = True, free.time_to_converge + GIVEN
    for said in iter(lambda: hear(peer), None):
        t = said["t_s"]
        flown = replace(
            alone.pursuer, x=said["x_m"], y=said["y_m"], heading=radians(said["heading_deg"])
        )
        kept = kept and is_clear(flown, situation, t)
        here = moved_to(alone, flown, t)
        if has_joined(here) or t > until:
            send(peer, "")
            joined = t if has_joined(here) else inf
            return Flown(joined=joined, kept=kept, cpu=process_time() - since)
        onward = plan(here)
        send(peer, f"{degrees(next_heading(onward, flown)) % 360.0}")
    raise CalledProcessError(peer.wait(), str(SCRIPT))


def question(situation: Situation) -> dict[str, object]:
    """A situation as BlueSky's script takes it."""
    own, leader, air = situation.pursuer, situation.leader, Air()
    minima = {situation.min_separation, *(o.min_separation for o in traffic(situation))}
    flying: list[tuple[str, Pursuer | Leader | Traffic]] = [
        ("OWN", own),
        ("LEAD", leader),
        *((other.ident, other) for other in traffic(situation)),
    ]
    return {
        "minimum_nm": max(minima) / NM,
        "bank_deg": degrees(own.max_bank),
        "aircraft": [
            {
                "ident": ident,
                "x_m": one.x,
                "y_m": one.y,
                "heading_deg": degrees(one.heading),
                "tas_mps": one.tas,
                "cas_kt": air.cas_from_tas(one.tas, ALTITUDE) / KT,
            }
            for ident, one in flying
        ],
    }


def traffic(situation: Situation) -> tuple[Traffic, ...]:
    """The others that are aircraft."""
    return tuple(other for other in situation.others if isinstance(other, Traffic))


def send(peer: "Popen[str]", line: str) -> None:
    """A line for BlueSky."""
    assert peer.stdin is not None
    peer.stdin.write(f"{line}\n")
    peer.stdin.flush()


def hear(peer: "Popen[str]") -> dict[str, float] | None:
    """What BlueSky says next; it prints other things too."""
    assert peer.stdout is not None
    for line in peer.stdout:
        if line.startswith('{"t_s"'):
            heard: dict[str, float] = json.loads(line)
            return heard
    return None


def moved_to(alone: Situation, own: Pursuer, t: Second) -> Situation:
    """The situation at a time, with the pursuer where it was flown to."""
    leader = alone.leader
    x, y = beside(leader.x, leader.y, leader.heading, leader.tas * t)
    return replace(alone, pursuer=own, leader=replace(leader, x=x, y=y))


def is_clear(own: Pursuer, situation: Situation, t: Second) -> bool:
    """Whether all minima are kept now."""
    leader = situation.leader
    x, y = beside(leader.x, leader.y, leader.heading, leader.tas * t)
    if hypot(x - own.x, y - own.y) < INSIDE * situation.min_separation:
        return False
    for other in traffic(situation):
        x, y = beside(other.x, other.y, other.heading, other.tas * t)
        if hypot(x - own.x, y - own.y) < INSIDE * other.min_separation:
            return False
    return True


def has_joined(here: Situation) -> bool:
    """Whether the pursuer is in the slot."""
    own, leader = here.pursuer, here.leader
    slot = beside(leader.x, leader.y, leader.heading, -here.slot_distance)
    return (
        hypot(own.x - slot[0], own.y - slot[1]) <= AT_SLOT
        and abs(wrap_signed(own.heading - leader.heading)) <= ON_HEADING
    )


def next_heading(onward: Plan | NoPlan, own: Pursuer) -> float:
    """The heading to steer [rad]: as far round as a turn goes, at most a right angle."""
    if isinstance(onward, NoPlan) or not onward.trajectory.segments:
        return own.heading
    first = onward.trajectory.segments[0]
    if isinstance(first, Arc):
        return own.heading - first.turn * min(first.turn_angle, radians(90.0))
    return own.heading


# ---- the table -------------------------------------------------------------------------------


def measure(cases: int) -> tuple[dict[tuple[int, str], list[Flown]], list[str]]:
    """All situations by all methods; sentences about what could not be measured."""
    rows: dict[tuple[int, str], list[Flown]] = {}
    load_kernels()
    drawn = {
        count: [amid_traffic(np.random.default_rng([count, k]), count) for k in range(cases)]
        for count in COUNTS
    }
    for count, situations in drawn.items():
        rows[count, "relguide"] = [by_plan(one) for one in situations]
        rows[count, "search over fixes"] = each(by_fixes, situations, f"Fixes, {count} others")
    try:
        python = install(PEERS["bluesky"], FOLDER)
    except CalledProcessError as error:
        return rows, [absence(PEERS["bluesky"], error)]
    with bluesky(python) as peer:
        for count, situations in drawn.items():
            flown = each(partial(by_mvp, peer), situations, f"MVP, {count} others")
            rows[count, "BlueSky, MVP"] = flown
    return rows, []


def each(
    method: Callable[[Situation], Flown], situations: list[Situation], title: str
) -> list[Flown]:
    """All situations by one method, with a progress bar."""
    done: list[Flown] = []
    flown = map(method, situations)
    done.extend(show_progress(flown, title=title, total=len(situations), done=lambda _: len(done)))
    return done


def table(rows: dict[tuple[int, str], list[Flown]], absent: list[str]) -> Table:
    """What was measured, for people."""
    drawn = Table(title="Joining amid traffic: plan() beside what peers do")
    for k, heading in enumerate(HEADINGS):
        drawn.add_column(heading, justify="left" if k == 1 else "right")
    for (count, name), flown in sorted(rows.items(), key=lambda row: row[0][0]):
        ours = rows[count, "relguide"]
        later = [
            theirs.joined - our.joined
            for theirs, our in zip(flown, ours, strict=True)
            if theirs.joined < inf and theirs.kept and our.joined < inf
        ]
        joined = sum(one.joined < inf and one.kept for one in flown)
        cpu = 1e3 * sum(one.cpu for one in flown) / len(flown)
        drawn.add_row(
            str(count),
            name,
            f"{100.0 * joined / len(flown):.0f} %",
            f"{sum(not one.kept for one in flown)}",
            f"{np.median(later):.0f}" if later else "–",
            f"{np.quantile(later, 0.95):.0f}" if later else "–",
            f"{cpu:.1f}",
        )
    drawn.caption = "\n".join(
        (
            "Later than plan() where both join and keep all minima. BlueSky's CPU time is that of "
            "the plans it asks for, not its own.",
            *absent,
        )
    )
    drawn.caption_justify = "left"
    return drawn


def add_cases(parser: argparse.ArgumentParser, default: int) -> None:
    """An option for how many situations are drawn."""
    told = f"situations for each count of others ({default})"
    parser.add_argument("--amid", type=positive, default=default, metavar="N", help=told)


def main(arguments: list[str] | None = None) -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.amid_others", description=__doc__.splitlines()[0]
    )
    add_cases(parser, 20)
    given = parser.parse_args(arguments)
    Console(width=118).print(table(*measure(given.amid)))
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Whether what validation accepts stays apart: `python -m benchmarks.validation`.

Pictures are drawn: a manoeuvre, its leader, and up to eight others, in wind, level or not, with an
intent, with a cleared path, or with neither; and closed airspaces. Each manoeuvre that is accepted
is then attacked: ten times a second, along the true arcs, the pursuer is put at every corner of the
caution thresholds and within them, others at the corners of theirs, or as near as their bound
allows; those without an intent fly the fan's edges and turn at random within it; all that change
their level do so as early, late, fast and slow as may be. None may then be below the minimum.
"""

import argparse
import sys
from dataclasses import dataclass, replace
from math import cos, hypot, inf, pi, sin
from time import perf_counter, process_time

import numpy as np
from numpy.typing import NDArray
from rich.console import Console

from benchmarks.options import positive
from relguide.atc.picture import Airspace, Picture, Seen
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.atc.tracks import intent_track, path_track
from relguide.atc.validate import validate
from relguide.planning.aircraft import Leader, Traffic
from relguide.planning.heights import RATE_TOLERANCE, START_TOLERANCE, Heights, heights_of
from relguide.planning.intent import ChangeLevel, FlyStraight, LevelChange, TurnTo
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory
from relguide.planning.wind import Wind
from relguide.units import DEG, FT, NM

NOW = 1.7e9
STEP = 0.1
COARSE = 20  # steps
ASKED_AGAIN = 10  # of so many pictures one that is refused is attacked too
SETTINGS = AtcSettings()
LEVELS = tuple(1_000.0 * FT * level for level in (32, 33, 34))
CONSOLE = Console(width=118, highlight=False)
FAR = 5.0 * NM + 6_000.0  # beyond it nothing within the thresholds comes too near
Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Flown:
    """An aircraft as it truly flies, before it strays."""

    path: Trajectory
    heights: Heights
    wind: Wind
    cleared: bool = False
    intends: bool = True

    def at(self, t: Floats, aside: Floats | float = 0.0) -> tuple[Floats, Floats]:
        """Along the true arcs over the ground, and so far to the right; straight on at first."""
        found = self.path.sample(np.maximum(t, 0.0)).over_ground(self.wind)
        before = np.minimum(t, 0.0) * found.speed
        east, north = np.sin(found.track), np.cos(found.track)
        return (
            found.x + before * east + aside * north,
            found.y + before * north - aside * east,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A manoeuvre in a picture, and what truly flies in it."""

    manoeuvre: Manoeuvre
    picture: Picture
    own: Flown
    leader: Flown
    others: tuple[Flown, ...]


@dataclass(slots=True)
class Tally:
    """What came of it."""

    pictures: int = 0
    accepted: int = 0
    attacked: int = 0
    lost: int = 0
    nearest: float = inf
    refused: int = 0
    again: int = 0
    needless: int = 0
    seconds: float = 0.0


def main(arguments: list[str] | None = None) -> int:
    """Draw, validate and attack; 1 if anything accepted is lost."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.validation", description=__doc__)
    parser.add_argument("--pictures", type=positive, default=100_000, metavar="N")
    parser.add_argument("--minutes", type=positive, default=10, metavar="N", help="at most")
    parser.add_argument("--seed", type=positive, default=1, metavar="N", help="of the first one")
    given = parser.parse_args(arguments)
    tally, until = Tally(), perf_counter() + 60.0 * given.minutes
    for seed in range(given.seed, given.seed + given.pictures):
        judge(seed, tally)
        if perf_counter() > until:
            break
    CONSOLE.print(f"A picture of 1,000 others: {crowd():.1f} ms of CPU.")
    CONSOLE.print(
        f"{tally.pictures:,} pictures: {tally.accepted:,} accepted, {tally.attacked:,} pairs "
        f"attacked, {tally.lost} lost; the nearest kept {tally.nearest:.1f} m more than its "
        f"minimum. {tally.refused:,} refused for what may differ alone; of {tally.again:,} of "
        f"these that were attacked too, {tally.needless:,} were not lost. "
        f"{1e3 * tally.seconds / tally.pictures:.2f} ms of CPU each."
    )
    return 1 if tally.lost else 0


def crowd() -> float:
    """CPU time to validate amid 1,000 others, a fifth without an intent [ms]; the median of 20."""
    rng = np.random.default_rng(0)
    case = draw(rng)
    until = case.manoeuvre.path.end
    seen = []
    for i in range(1_000):
        intends = i % 5 > 0
        traffic = _traffic(rng, f"T{i}", intends=intends)
        x, y = rng.uniform(-200_000.0, 200_000.0, 2)
        level = 1_000.0 * FT * rng.integers(28, 41)
        traffic = replace(traffic, x=x, y=y, altitude=level)
        track = intent_track(traffic, start=NOW, until=until, wind=case.own.wind)
        seen.append(_seen(traffic, case.own.wind, track if intends else None))
    picture = replace(case.picture, aircraft=tuple(seen))
    times = []
    for _ in range(20):
        begun = process_time()
        validate(case.manoeuvre, picture, NOW, SETTINGS)
        times.append(1e3 * (process_time() - begun))
    return float(np.median(times))


def judge(seed: int, tally: Tally) -> None:
    """One picture."""
    rng = np.random.default_rng(seed)
    case = draw(rng)
    begun = process_time()
    card = validate(case.manoeuvre, case.picture, NOW, SETTINGS)
    tally.seconds += process_time() - begun
    tally.pictures += 1
    reasons = {finding.reason for finding in card.findings}
    if card.verdict == "acceptable":
        tally.accepted += 1
        least = spare(case, rng, tally)
        tally.nearest = min(tally.nearest, least)
        if least < 0.0:
            tally.lost += 1
            CONSOLE.print(f"seed {seed}: accepted, and {-least:.1f} m too near")
    elif reasons <= {"separation", "traffic_without_intent"} and not any(
        pair.certainty == "certain" for pair in card.pairs
    ):
        tally.refused += 1
        if seed % ASKED_AGAIN == 0:
            tally.again += 1
            tally.needless += spare(case, rng, Tally()) >= 0.0


def draw(rng: np.random.Generator) -> Case:
    """A manoeuvre of some turns, a leader ahead of where it ends, others about it."""
    wind = Wind(east=rng.uniform(-40.0, 40.0), north=rng.uniform(-40.0, 40.0))
    level = float(rng.choice(LEVELS))
    path = _path(rng, rng.uniform(100.0, 600.0))
    changes: tuple[LevelChange, ...] = ()
    if rng.random() < 0.3:
        changes = (_change(rng, rng.uniform(0.0, 200.0)),)
    own = Flown(path=path, heights=Heights(altitude=level, changes=changes), wind=wind)
    until = NOW + path.duration + SETTINGS.followed
    leader, d_min = _leader(rng, path, wind), rng.uniform(2.0, 4.0) * NM
    leads = Flown(path=leader.trajectory, heights=heights_of(leader), wind=wind)
    leader_path = intent_track(leader, start=NOW, until=until, wind=wind)
    others, seen = [], [_seen(leader, wind, leader_path)]
    for i in range(rng.integers(1, 5)):
        kind = rng.random()
        traffic = _brought_near(rng, _traffic(rng, f"T{i}", intends=kind < 0.85), path)
        flown = Flown(path=traffic.trajectory, heights=heights_of(traffic), wind=wind,
                      cleared=kind < 0.25, intends=kind < 0.85)  # fmt: skip
        track = intent_track(traffic, start=NOW, until=until, wind=wind)
        one = _seen(traffic, wind, track if flown.intends else None)
        seen.append(replace(one, cleared=flown.cleared))
        others.append(flown)
    manoeuvre = Manoeuvre(
        ident="OWN",
        leader="LEAD",
        spacing_type="distance",
        spacing=5.0 * NM,
        min_separation=d_min,
        path=path_track(path, start=NOW, until=until, wind=wind, heights=own.heights),
        joins=NOW + path.duration,
        leader_path=leader_path,
    )
    airspaces = tuple(_airspace(rng, f"R{i}") for i in range(rng.integers(0, 3)))
    picture = Picture(as_of=NOW, aircraft=tuple(seen), airspaces=airspaces)
    return Case(manoeuvre=manoeuvre, picture=picture, own=own, leader=leads, others=tuple(others))


def spare(case: Case, rng: np.random.Generator, tally: Tally) -> float:
    """The least by which anything keeps its minimum, however all stray [m]."""
    t = np.arange(0.0, case.manoeuvre.joins - NOW + SETTINGS.followed, STEP)
    t = t[t <= SETTINGS.horizon]
    near = t[np.repeat(_near(case.own, case.leader, t[::COARSE]), COARSE)[: len(t)]]
    near = near[_not_apart(case.own.heights, case.leader.heights, near, rng)]
    (x, y), (ahead_x, ahead_y) = case.own.at(near), case.leader.at(near)
    apart = np.hypot(x - ahead_x, y - ahead_y)
    least = float(np.min(apart, initial=inf)) - case.manoeuvre.min_separation
    for other in case.others:
        found = _spare_of(case.own, other, t, rng)
        if found < inf:
            tally.attacked += 1
            least = min(least, found)
    for airspace in case.picture.airspaces:
        least = min(least, _spare_of_airspace(case.own, airspace, t, rng))
    return least


def _spare_of(own: Flown, other: Flown, t: Floats, rng: np.random.Generator) -> float:
    """The least by which two keep the minimum; infinite if they are never near."""
    if other.intends:
        t = t[np.repeat(_near(own, other, t[::COARSE]), COARSE)[: len(t)]]
    t = t[_not_apart(own.heights, other.heights, t, rng)]
    if not len(t):
        return inf
    ours = _strayed(own, t, rng)
    if not other.intends:
        return _spare_of_fan(ours, other, t, rng)
    least = inf
    bound = SETTINGS.traffic_bound + SETTINGS.traffic_growth * t
    theirs = _strayed(other, t, rng) if other.cleared else [other.at(t)]
    for x, y in ours:
        for other_x, other_y in theirs:
            apart = np.hypot(x - other_x, y - other_y)
            if not other.cleared:
                apart = apart - bound
            least = min(least, float(np.min(apart)))
    return least - SETTINGS.minimum


def _near(own: Flown, other: Flown, t: Floats) -> NDArray[np.bool_]:
    """Whether two may come near until the next of some times."""
    (x, y), (other_x, other_y) = own.at(t), other.at(t)
    near: NDArray[np.bool_] = np.hypot(x - other_x, y - other_y) < FAR + COARSE * STEP * 700.0
    return near


def _strayed(flown: Flown, t: Floats, rng: np.random.Generator) -> list[tuple[Floats, Floats]]:
    """Where a cleared aircraft may be without a caution: at each corner, and somewhere within."""
    along, across = SETTINGS.along.caution, SETTINGS.across.caution
    corners = [(a * along, b * across) for a in (-1.0, 0.0, 1.0) for b in (-1.0, 0.0, 1.0)]
    within = [(rng.uniform(-along, along, len(t)), rng.uniform(-across, across, len(t)))]
    return [flown.at(t + late, aside) for late, aside in (*corners, *within)]


def _spare_of_fan(
    ours: list[tuple[Floats, Floats]], other: Flown, t: Floats, rng: np.random.Generator
) -> float:
    """The least by which one without an intent keeps the minimum, turning as it likes."""
    start_x, start_y = (float(column[0]) for column in other.at(np.zeros(1)))
    east, north = other.at(np.ones(1))
    east, north = float(east[0]) - start_x, float(north[0]) - start_y
    track, speed = np.arctan2(east, north), hypot(east, north)
    bound = SETTINGS.traffic_bound + SETTINGS.traffic_growth * t
    fan, least = SETTINGS.fan, inf
    ways = [(0.0, a, a) for a in np.linspace(-fan, fan, 7)]
    ways += [(rng.uniform(0.0, t[-1] + 1.0), *rng.uniform(-fan, fan, 2)) for _ in range(10)]
    ways += [(rng.uniform(0.0, t[-1] + 1.0), *rng.permutation([-fan, fan])) for _ in range(6)]
    for turns, first, then in ways:
        before, after = np.minimum(t, turns), np.maximum(t - turns, 0.0)
        x = start_x + speed * (before * sin(track + first) + after * sin(track + then))
        y = start_y + speed * (before * cos(track + first) + after * cos(track + then))
        for own_x, own_y in ours:
            least = min(least, float(np.min(np.hypot(own_x - x, own_y - y) - bound)))
    return least - SETTINGS.minimum


def _spare_of_airspace(
    own: Flown, airspace: Airspace, t: Floats, rng: np.random.Generator
) -> float:
    """−1 if it may be inside while it is closed and at its levels, else infinite."""
    corners = np.column_stack((airspace.x, airspace.y))
    middle = corners.mean(axis=0)
    reach = np.max(np.hypot(*(corners - middle).T)) + 2_500.0
    x, y = own.at(t)
    t = t[np.hypot(x - middle[0], y - middle[1]) < reach]
    for heights in _profiles(own.heights, t, rng):
        closed = (t + NOW >= airspace.since) & (t + NOW < airspace.until)
        closed &= (heights >= airspace.low) & (heights < airspace.high)
        if not closed.any():
            continue
        for x, y in _strayed(own, t[closed], rng):
            if _inside(x, y, corners).any():
                return -1.0
    return inf


def _inside(x: Floats, y: Floats, corners: Floats) -> NDArray[np.bool_]:
    """Whether points lie in a polygon, by its winding about them."""
    angle = np.zeros(len(x))
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        ax, ay, bx, by = a[0] - x, a[1] - y, b[0] - x, b[1] - y
        angle += np.arctan2(ax * by - ay * bx, ax * bx + ay * by)
    return np.abs(angle) > pi


def _not_apart(
    own: Heights, other: Heights, t: Floats, rng: np.random.Generator
) -> NDArray[np.bool_]:
    """When 1,000 ft may not keep two apart, by some ways to change the level."""
    found = np.zeros(len(t), dtype=bool)
    if own.altitude is None or other.altitude is None:
        return ~found
    theirs = _profiles(other, t, rng)
    for ours in _profiles(own, t, rng):
        for heights in theirs:
            found |= np.abs(ours - heights) < SETTINGS.vertical_minimum - 1.0
    return found


def _profiles(heights: Heights, t: Floats, rng: np.random.Generator) -> list[Floats]:
    """Altitudes over time: changes as early, late, fast and slow as may be, and one between."""
    corners = [(a, b) for a in (-1.0, 1.0) for b in (-1.0, 1.0)] if heights.changes else [(0, 0)]
    found = []
    for late, fast in (*corners, tuple(rng.uniform(-1.0, 1.0, 2))):
        altitude = np.full(len(t), heights.altitude)
        for change in heights.changes:
            start = max(change.at + START_TOLERANCE * late, 0.0)
            rate = change.rate * (1.0 + RATE_TOLERANCE * fast)
            way = change.to_altitude - float(heights.altitude or 0.0)
            moved = np.minimum(np.maximum(t - start, 0.0) * rate, abs(way))
            altitude = altitude + np.copysign(moved, way)
        found.append(altitude)
    return found


def _path(rng: np.random.Generator, lasts: float) -> Trajectory:
    tas = rng.uniform(90.0, 240.0)
    segments: list[Arc | Straight] = []
    left = tas * lasts
    while left > 0.0:
        bank = rng.uniform(5.0, 30.0) * DEG
        turn = Arc(turn=LEFT if rng.random() < 0.5 else RIGHT, turn_angle=rng.uniform(0.05, 4.0),
                   radius=tas * tas / (9.80665 * np.tan(bank)))  # fmt: skip
        segments += [turn, Straight(length=rng.uniform(0.0, 40_000.0))]
        left -= turn.length + segments[-1].length
    x, y = rng.uniform(-30_000.0, 30_000.0, 2)
    heading = rng.uniform(0.0, 2.0 * pi)
    return Trajectory(x=x, y=y, heading=heading, tas=tas, segments=tuple(segments))


def _leader(rng: np.random.Generator, path: Trajectory, wind: Wind) -> Leader:
    """5 NM ahead of where a path ends, as fast, always straight."""
    end = path.pose_at(path.duration)
    east, north = path.tas * sin(end.heading), path.tas * cos(end.heading)
    ahead = 5.0 * NM / hypot(east + wind.east, north + wind.north)
    return Leader(
        x=end.x + (east + wind.east) * ahead - east * path.duration,
        y=end.y + (north + wind.north) * ahead - north * path.duration,
        heading=end.heading,
        tas=path.tas,
        altitude=float(rng.choice(LEVELS)) if rng.random() < 0.5 else None,
    )


def _traffic(rng: np.random.Generator, ident: str, *, intends: bool) -> Traffic:
    intent: list[FlyStraight | TurnTo | ChangeLevel] = []
    altitude = float(rng.choice(LEVELS)) if rng.random() < 0.8 else None
    if altitude is not None and intends and rng.random() < 0.3:
        change = _change(rng, 0.0)
        intent += [
            FlyStraight(duration=rng.uniform(0.0, 200.0)),
            ChangeLevel(to_altitude=change.to_altitude, rate=change.rate),
        ]
    for _ in range(rng.integers(0, 4) if intends else 0):
        turn = LEFT if rng.random() < 0.5 else RIGHT
        heading, bank = rng.uniform(0.0, 2.0 * pi), rng.uniform(5.0, 30.0) * DEG
        intent += [FlyStraight(duration=rng.uniform(0.0, 200.0)),
                   TurnTo(heading=heading, turn=turn, bank=bank)]  # fmt: skip
    x, y = rng.uniform(-100_000.0, 100_000.0, 2)
    return Traffic(ident=ident, x=x, y=y, heading=rng.uniform(0.0, 2.0 * pi),
                   tas=rng.uniform(80.0, 260.0), min_separation=SETTINGS.minimum,
                   intent=tuple(intent), altitude=altitude)  # fmt: skip


def _brought_near(rng: np.random.Generator, traffic: Traffic, path: Trajectory) -> Traffic:
    """The same, moved so that it once is about as far from a path as it may be."""
    if rng.random() < 0.3:
        return traffic
    t = rng.uniform(0.0, path.duration + SETTINGS.followed)
    there, here = path.pose_at(t), traffic.trajectory.pose_at(t)
    east = traffic.tas * sin(here.heading) - path.tas * sin(there.heading)
    north = traffic.tas * cos(here.heading) - path.tas * cos(there.heading)
    # across to how they move past each other, mostly: so it is nearest then
    bearing = np.arctan2(east, north) + rng.choice([-0.5, 0.5]) * pi + rng.normal(0.0, 0.1)
    apart = rng.uniform(9_500.0, 14_000.0)
    return replace(
        traffic,
        x=traffic.x + there.x - here.x + apart * sin(bearing),
        y=traffic.y + there.y - here.y + apart * cos(bearing),
    )


def _change(rng: np.random.Generator, at: float) -> LevelChange:
    return LevelChange(at=at, to_altitude=float(rng.choice(LEVELS)), rate=rng.uniform(3.0, 12.0))


def _seen(aircraft: Traffic | Leader, wind: Wind, path: object) -> Seen:
    east = aircraft.tas * sin(aircraft.heading) + wind.east
    north = aircraft.tas * cos(aircraft.heading) + wind.north
    ident = aircraft.ident if isinstance(aircraft, Traffic) else "LEAD"
    return Seen(ident=ident, t=NOW, x=aircraft.x, y=aircraft.y,
                track=float(np.arctan2(east, north)), ground_speed=hypot(east, north),
                altitude=aircraft.altitude, path=path)  # type: ignore[arg-type]  # fmt: skip


def _airspace(rng: np.random.Generator, ident: str) -> Airspace:
    """A star of corners about a place: mostly not convex."""
    x, y = rng.uniform(-60_000.0, 60_000.0, 2)
    n = rng.integers(3, 9)
    angles = np.sort(rng.uniform(0.0, 2.0 * pi, n))
    reach = rng.uniform(2_000.0, 25_000.0, n)
    since = NOW + rng.uniform(-300.0, 400.0) if rng.random() < 0.5 else -inf
    return Airspace(
        ident=ident,
        x=tuple((x + reach * np.sin(angles)).tolist()),
        y=tuple((y + reach * np.cos(angles)).tolist()),
        low=float(rng.choice([-inf, LEVELS[1], LEVELS[2]])),
        high=float(rng.choice([inf, LEVELS[1], LEVELS[2] + 150.0])),
        since=since,
        until=since + rng.uniform(50.0, 600.0) if rng.random() < 0.5 else inf,
    )


if __name__ == "__main__":
    sys.exit(main())

"""The drawings of docs/glossary.md, made from real plans: `python -m tools.glossary_drawings`."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import cos, degrees, hypot, radians, sin
from pathlib import Path
from xml.sax.saxutils import escape

from relguide import (
    LEFT,
    BoundaryArc,
    FlyStraight,
    Leader,
    Plan,
    Pursuer,
    Situation,
    Trajectory,
    TurnTo,
    candidates,
    plan,
)
from relguide.planning.trajectory import heading_change

FOLDER = Path(__file__).parents[1] / "docs" / "figures"
INK, PURSUER, LEADER, LIMIT, PALE = "#222222", "#0072b2", "#aa5a8c", "#d55e00", "#8a8a8a"
"""Colours that colour-blind readers tell apart (Okabe and Ito)."""
Point = tuple[float, float]


def main() -> None:
    """Draw all, anew."""
    for name, svg in drawings().items():
        (FOLDER / name).write_text(svg)


def drawings() -> dict[str, str]:
    """File names and pictures."""
    return {
        "glossary_situation.svg": _situation_drawing(),
        "glossary_short_branch.svg": _branch_drawing(
            _situation(-8.3e3, -5.7e3, 16.0), "LRL with a middle arc of less than half a turn"
        ),
        "glossary_long_branch.svg": _branch_drawing(
            _situation(-8.3e3, 19.9e3, 222.0), "LRL with a middle arc of more than half a turn"
        ),
        "glossary_constrained.svg": _constrained_drawing(),
        "glossary_delay.svg": _delay_drawing(),
    }


def _situation(
    x: float, y: float, heading: float, *, tas: float = 240.0, bank: float = 25.0, turn: float = 0.0
) -> Situation:
    """Metres and degrees; the leader at the origin flies north at 200 m/s, then may turn left."""
    intent = (
        (FlyStraight(duration=40.0), TurnTo(heading=radians(-turn), turn=LEFT, bank=radians(25)))
        if turn
        else ()
    )
    return Situation(
        pursuer=Pursuer(x=x, y=y, heading=radians(heading), tas=tas, max_bank=radians(bank)),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0, intent=intent),
        slot_distance=12e3,
        min_separation=9260.0,
    )


def _situation_drawing() -> str:
    situation = _situation(-22e3, -8e3, 40.0)
    pursuer = situation.pursuer
    path = _plan(situation).trajectory
    meets = path.duration
    behind = -situation.slot_distance
    over_there = 200.0 * meets
    page = _Page(left=-31e3, right=19e3, low=-19e3, high=over_there + 12e3, width=330)
    page.line([(0.0, behind), (0.0, over_there)], LEADER, "leader's route", at=0.95, dx=8)
    # both now and at T: the plan keeps clear of the circle that moves with the leader
    page.circle((0.0, 0.0), situation.min_separation, LIMIT, passed=True)
    page.circle((0.0, over_there), situation.min_separation, LIMIT)
    page.text((6.3e3, 8.4e3), "d_min now", LIMIT)
    page.text((6.3e3, over_there + 6.9e3), "d_min at T", LIMIT)
    page.scale((-29e3, over_there + 9e3), 10e3, "10 km")
    page.line([(pursuer.x, pursuer.y), (0.0, 0.0)], PALE, dashed=True)
    page.text((-15.0e3, -8.3e3), "d", PALE)
    page.line(_fly(path), PURSUER, "plan", at=0.8, dx=-34)
    page.aircraft((pursuer.x, pursuer.y), pursuer.heading, PURSUER)
    page.text((pursuer.x - 7e3, pursuer.y - 4.4e3), "pursuer P", PURSUER)
    page.aircraft((0.0, 0.0), 0.0, LEADER)
    page.text((1.6e3, -1.4e3), "leader L", LEADER)
    page.slot((0.0, behind), "slot now")
    page.line([(-2.2e3, 0.0), (-2.2e3, behind)], PALE, "D", at=0.65, dx=-13)
    page.slot((0.0, over_there + behind), "slot at T: joined")
    page.aircraft((0.0, over_there), 0.0, LEADER)
    return page.svg("Pursuer, leader, slot, D and d_min, with the plan to the slot")


def _branch_drawing(situation: Situation, title: str) -> str:
    """A path of the word LRL, as flown."""
    (path,) = [c.trajectory for c in candidates(situation).later if c.word == "LRL"]
    flown = _fly(path)
    page = _Page.around(flown, width=240)
    first, middle, _ = path.durations()
    turned = degrees(abs(heading_change(path.segments[1])))
    over = [path.pose_at(first + middle * k / 60) for k in range(61)]
    page.line(flown, PURSUER)
    page.line([(p.x, p.y) for p in over], INK, f"{turned:.0f}°", at=0.5, dx=8, wide=True)
    page.aircraft(flown[0], situation.pursuer.heading, PURSUER)
    page.slot(flown[-1], "slot at T")
    return page.svg(title)


def _constrained_drawing() -> str:
    situation = _situation(-2800.0, 24.7e3, 310.0, tas=205.0, bank=60.0)
    planned = _plan(situation)
    path = _from_leader(planned.trajectory)
    page = _Page.around([*path, (-11e3, -13e3), (11e3, 11e3)], width=330)
    page.circle((0.0, 0.0), situation.min_separation, LIMIT)
    page.text((-6e3, 3.6e3), "d < d_min", LIMIT)
    page.line(path, PURSUER, "constrained path", at=0.12, dx=8)
    t, flown = 0.0, planned.trajectory
    for segment, duration in zip(flown.segments, flown.durations(), strict=True):
        if isinstance(segment, BoundaryArc):
            arc = [_place_from_leader(flown, t + duration * k / 60) for k in range(61)]
            page.line(arc, INK, "boundary arc", at=0.5, dx=10, wide=True)
            page.dot(arc[0], "contact")
        t += duration
    page.aircraft(path[0], situation.pursuer.heading, PURSUER)
    page.aircraft((0.0, 0.0), 0.0, LEADER)
    page.slot((0.0, -12e3), "slot")
    return page.svg("A constrained path with its boundary arc, seen from the leader")


def _delay_drawing() -> str:
    situation = _situation(-4.9e3, -11.3e3, 41.0, turn=90.0)
    found = candidates(situation)
    assert found.reachable_at_release
    path = _plan(situation).trajectory
    leading = situation.leader.trajectory
    pose = leading.pose_at(path.duration)
    track = [(p.x, p.y) for p in map(leading.pose_at, _times(path.duration))]
    flown = _fly(path)
    page = _Page.around([*track, *flown, (-9e3, 0.0)], width=330)
    page.line(track, LEADER, "leader's route", at=0.12, dx=-90)
    page.line(flown, PURSUER, "a delay, exactly as long as T", at=0.28, dx=-180)
    page.aircraft((situation.pursuer.x, situation.pursuer.y), situation.pursuer.heading, PURSUER)
    page.aircraft((0.0, 0.0), 0.0, LEADER)
    page.aircraft((pose.x, pose.y), pose.heading, LEADER)
    page.slot(flown[-1], "")
    page.text(flown[-1], "slot at its release time", INK, -128, 20)
    return page.svg("A delay: the slot opens later than it could be reached")


def _plan(situation: Situation) -> Plan:
    planned = plan(situation)
    assert isinstance(planned, Plan)
    return planned


def _times(duration: float) -> list[float]:
    return [duration * k / 240 for k in range(241)]


def _fly(path: Trajectory) -> list[Point]:
    return [(p.x, p.y) for p in map(path.pose_at, _times(path.duration))]


def _place_from_leader(path: Trajectory, t: float) -> Point:
    """From a leader that flies north at 200 m/s from the origin."""
    pose = path.pose_at(min(t, path.duration))
    return pose.x, pose.y - 200.0 * t


def _from_leader(path: Trajectory) -> list[Point]:
    return [_place_from_leader(path, t) for t in _times(path.duration)]


class _Page:
    """An SVG of a piece of the world, north up, in metres."""

    def __init__(self, *, left: float, right: float, low: float, high: float, width: int) -> None:
        self._scale = width / (right - left)
        self._left, self._high = left, high
        self._size = width, round((high - low) * self._scale)
        self._parts: list[str] = []

    @classmethod
    def around(cls, points: Iterable[Point], width: int) -> "_Page":
        """Room for points, and a margin for words."""
        xs, ys = zip(*points, strict=True)
        margin = 0.16 * max(max(xs) - min(xs), max(ys) - min(ys))
        return cls(
            left=min(xs) - margin,
            right=max(xs) + 2.2 * margin,
            low=min(ys) - 0.5 * margin,
            high=max(ys) + 0.5 * margin,
            width=width,
        )

    def _at(self, point: Point) -> Point:
        x, y = point
        return (x - self._left) * self._scale, (self._high - y) * self._scale

    def line(
        self,
        points: Sequence[Point],
        colour: str,
        words: str = "",
        *,
        at: float = 0.5,
        dx: float = 0.0,
        dy: float = 0.0,
        dashed: bool = False,
        wide: bool = False,
    ) -> None:
        """A line, and words beside it at a share of its length."""
        drawn = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self._at, points))
        dashes = ' stroke-dasharray="4 3"' if dashed else ""
        self._parts.append(
            f'<polyline points="{drawn}" fill="none" stroke="{colour}" '
            f'stroke-width="{4 if wide else 1.6}"{dashes}/>'
        )
        if words:
            lengths = [0.0]
            for (ax, ay), (bx, by) in pairwise(points):
                lengths.append(lengths[-1] + hypot(bx - ax, by - ay))
            wanted = at * lengths[-1]
            here = next(k for k, length in enumerate(lengths) if length >= wanted)
            before, share = max(here - 1, 0), 1.0
            if lengths[here] > lengths[before]:
                share = (wanted - lengths[before]) / (lengths[here] - lengths[before])
            (ax, ay), (bx, by) = points[before], points[here]
            self.text((ax + share * (bx - ax), ay + share * (by - ay)), words, colour, dx, dy)

    def circle(self, centre: Point, radius: float, colour: str, *, passed: bool = False) -> None:
        """The limit; dashed and empty where it was before."""
        x, y = self._at(centre)
        look = (
            'fill="none" stroke-dasharray="4 3"'
            if passed
            else f'fill="{colour}" fill-opacity="0.10"'
        )
        self._parts.append(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius * self._scale:.1f}" {look} '
            f'stroke="{colour}"/>'
        )

    def scale(self, point: Point, length: float, words: str) -> None:
        """A bar of that length, and how long it is."""
        self.line([point, (point[0] + length, point[1])], INK, wide=True)
        self.text(point, words, INK, 0.0, 16.0)

    def text(self, point: Point, words: str, colour: str, dx: float = 0.0, dy: float = 0.0) -> None:
        """Words that begin at a point."""
        x, y = self._at(point)
        self._parts.append(
            f'<text x="{x + dx:.1f}" y="{y + dy:.1f}" fill="{colour}">{escape(words)}</text>'
        )

    def aircraft(self, point: Point, heading: float, colour: str) -> None:
        """A dart that points where the aircraft does."""
        x, y = self._at(point)
        nose = [(0.0, -8.0), (5.0, 6.0), (0.0, 3.0), (-5.0, 6.0)]
        turned = (
            (x + a * cos(heading) - b * sin(heading), y + a * sin(heading) + b * cos(heading))
            for a, b in nose
        )
        drawn = " ".join(f"{a:.1f},{b:.1f}" for a, b in turned)
        self._parts.append(f'<polygon points="{drawn}" fill="{colour}"/>')

    def slot(self, point: Point, words: str) -> None:
        """An open diamond."""
        x, y = self._at(point)
        self._parts.append(
            f'<path d="M{x:.1f},{y - 6:.1f} l6,6 -6,6 -6,-6z" fill="white" stroke="{INK}"/>'
        )
        self.text(point, words, INK, 9, 4)

    def dot(self, point: Point, words: str) -> None:
        """A filled dot."""
        x, y = self._at(point)
        self._parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{INK}"/>')
        self.text(point, words, INK, 8, -6)

    def svg(self, title: str) -> str:
        """The whole file."""
        width, height = self._size
        body = "\n".join(self._parts)
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
            f'width="{width}" height="{height}" font-family="sans-serif" font-size="12">\n'
            f'<title>{escape(title)}</title>\n<rect width="100%" height="100%" fill="white"/>\n'
            f"{body}\n</svg>\n"
        )


if __name__ == "__main__":
    main()

"""draw(…): two tracks over the ground as an SVG picture, in nautical miles and to scale."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from math import ceil, floor, log10

from relguide.flying.plan_documents import PathPoint
from relguide.planning.situation import Situation
from relguide.planning.slot import over_ground
from relguide.planning.trajectory import Trajectory
from relguide.units import NM, Second

Place = tuple[float, float]
"""East and north over the ground [NM]."""

WIDTH = 820.0
"""Of the picture [px]; the tallest is as high."""
MARGIN = 64.0
"""Around the tracks, for the axes [px]."""
NARROWEST = 320.0
"""Between the margins, for the title [px]."""
ROOM = 0.04
"""Left free around the tracks, as a share of their span."""
STEPS = 400
"""Points of a track."""
INK, PURSUER, LEADER, LIMIT = "#333", "#1a6fb4", "#c2542d", "#b3122d"


def draw(
    flown: Trajectory,
    situation: Situation,
    *,
    nodes: Sequence[PathPoint],
    closest_at: Second,
    title: str,
) -> str:
    """Draw both tracks.

    Args:
        flown: what the pursuer flies, in the air mass.
        situation: its leader, D, d_min and wind.
        nodes: points of the pursuer's track to mark, numbered from 1 at the slot.
        closest_at: when the two aircraft are nearest [s].
        title: the line above the picture.

    Returns:
        the text of an SVG file.
    """
    leader, end = situation.leader.trajectory, flown.duration

    def place(path: Trajectory, t: Second) -> Place:
        ground = over_ground(path.pose_at(t), t, situation.wind)
        return ground.x / NM, ground.y / NM

    times = [end * k / STEPS for k in range(STEPS + 1)]
    ours, theirs = ([place(path, t) for t in times] for path in (flown, leader))
    near, far = place(flown, closest_at), place(leader, closest_at)
    limit = situation.min_separation / NM
    page = _page(
        [*ours, *theirs, (far[0] - limit, far[1] - limit), (far[0] + limit, far[1] + limit)]
    )
    tags = [(ours[0], "pursuer", PURSUER), (theirs[0], "leader", LEADER)]
    return "\n".join(
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {page.width:.0f} '
            f'{page.height:.0f}" font-family="sans-serif" font-size="12" fill="{INK}">',
            f"<title>{escape(title)}</title>",
            '<rect width="100%" height="100%" fill="white"/>',
            f'<text x="{MARGIN}" y="26" font-size="15">{escape(title)}</text>',
            *page.axes(),
            page.circle(far, limit, LIMIT),
            page.line([near, far], LIMIT, dashes="4 3"),
            page.line(theirs, LEADER),
            page.line(ours, PURSUER),
            page.dot(theirs[-1], LEADER),
            *(page.dot((n.x / NM, n.y / NM), PURSUER) for n in nodes),
            *(
                page.text((n.x / NM, n.y / NM), f"{i}", PURSUER, dx=7.0, dy=-6.0)
                for i, n in enumerate(nodes, start=1)
            ),
            page.dot(theirs[0], LEADER),
            *(page.text(at, tag, colour, dx=7.0, dy=16.0) for at, tag, colour in tags),
            page.text(far, "d_min", LIMIT, dx=-16.0, dy=-page.scale * limit - 5.0),
            "</svg>\n",
        )
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Page:
    """Where places lie in the picture: one scale for both axes, north up."""

    west: float
    """Edges of what is shown [NM]."""
    east: float
    south: float
    north: float

    @property
    def scale(self) -> float:
        """Pixels per nautical mile."""
        return (WIDTH - 2.0 * MARGIN) / max(self.east - self.west, self.north - self.south)

    @property
    def width(self) -> float:
        """[px]."""
        return max((self.east - self.west) * self.scale, NARROWEST) + 2.0 * MARGIN

    @property
    def height(self) -> float:
        """[px]."""
        return (self.north - self.south) * self.scale + 2.0 * MARGIN

    def at(self, place: Place) -> tuple[float, float]:
        """In pixels."""
        x = MARGIN + (place[0] - self.west) * self.scale
        return x, self.height - MARGIN - (place[1] - self.south) * self.scale

    def line(self, places: Sequence[Place], colour: str, dashes: str = "none") -> str:
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.at, places))
        return (
            f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.8" '
            f'stroke-dasharray="{dashes}"/>'
        )

    def circle(self, centre: Place, radius: float, colour: str) -> str:
        x, y = self.at(centre)
        return (
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius * self.scale:.1f}" fill="none" '
            f'stroke="{colour}" stroke-dasharray="4 3"/>'
        )

    def dot(self, place: Place, colour: str) -> str:
        x, y = self.at(place)
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>'

    def text(self, place: Place, text: str, colour: str, *, dx: float, dy: float) -> str:
        x, y = self.at(place)
        return (
            f'<text x="{x + dx:.1f}" y="{y + dy:.1f}" fill="{colour}" stroke="white" '
            f'stroke-width="4" paint-order="stroke">{escape(text)}</text>'
        )

    def axes(self) -> list[str]:
        """A grid with its numbers, in nautical miles."""
        step = _round_step(max(self.east - self.west, self.north - self.south) / 8.0)
        bottom, top = self.at((self.west, self.south))[1], self.at((self.west, self.north))[1]
        left, right = self.at((self.west, self.south))[0], self.at((self.east, self.south))[0]
        drawn = []
        for k in range(ceil(self.west / step), floor(self.east / step) + 1):
            x = self.at((k * step, self.south))[0]
            drawn.append(_rule(x, bottom, x, top))
            drawn.append(_number(x, bottom + 18.0, k * step, "middle"))
        for k in range(ceil(self.south / step), floor(self.north / step) + 1):
            y = self.at((self.west, k * step))[1]
            drawn.append(_rule(left, y, right, y))
            drawn.append(_number(left - 8.0, y + 4.0, k * step, "end"))
        middle = 0.5 * (bottom + top)
        drawn.append(
            f'<text x="{0.5 * (left + right):.1f}" y="{bottom + 40.0:.1f}" '
            'text-anchor="middle">east [NM]</text>'
        )
        drawn.append(
            f'<text x="18" y="{middle:.1f}" text-anchor="middle" '
            f'transform="rotate(-90 18 {middle:.1f})">north [NM]</text>'
        )
        return drawn


def _page(places: Sequence[Place]) -> _Page:
    """A page with room for all places and a little more."""
    east, north = ([place[k] for place in places] for k in (0, 1))
    span = max(max(east) - min(east), max(north) - min(north), 1.0)
    room = ROOM * span
    return _Page(
        west=min(east) - room,
        east=max(east) + room,
        south=min(north) - room,
        north=max(north) + room,
    )


def _round_step(wanted: float) -> float:
    """The least of 1, 2 and 5 times powers of ten that is not below what is wanted."""
    power = 10.0 ** floor(log10(wanted))
    return next(k * power for k in (1.0, 2.0, 5.0, 10.0) if k * power >= wanted * (1.0 - 1e-9))


def _rule(x1: float, y1: float, x2: float, y2: float) -> str:
    return f'<path d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}" stroke="#ddd"/>'


def _number(x: float, y: float, value: float, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{value:g}</text>'

"""A plan as a small drawing (SVG), north up: both paths, d_min, and what is proved."""

from math import degrees
from typing import NamedTuple

import numpy as np

from relguide.planning.certificate import Certificate
from relguide.planning.sampling import Samples
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory
from relguide.units import NM, Metre, Second

WIDTH, LEAST_HEIGHT, MOST_HEIGHT = 640.0, 220.0, 560.0
"""Of the drawing [px]."""
HEAD, FOOT, MARGIN = 58.0, 40.0, 34.0
"""Room for the words above, for the scale below, and round the paths [px]."""
POINTS = 240
"""Places along each path."""
STEPS_NM = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500)
"""Lengths that a scale bar may have [NM]."""
OWN, LEADER, INK = "#0b7a2b", "#55595f", "#26292d"
FONT = "B612, 'Segoe UI', 'DejaVu Sans', sans-serif"
AIRCRAFT = "M0 -9V10M-11 -1H11M-4 8H4"
TITLE = ' font-size="17" font-weight="bold"'
END = ' text-anchor="end"'
CHEVRON = "M0 -9L7 8L0 4L-7 8Z"


class _View(NamedTuple):
    """From the ground [m] to the drawing [px]."""

    west: Metre
    north: Metre
    scale: float
    left: float
    top: float

    def place(self, x: Metre, y: Metre) -> tuple[float, float]:
        return (
            self.left + (x - self.west) * self.scale,
            self.top + (self.north - y) * self.scale,
        )


def plan_drawing(
    path: Trajectory, situation: Situation, *, word: str, certificate: Certificate
) -> str:
    """The drawing.

    Args:
        path: of the pursuer, in the air mass.
        situation: gives the leader, d_min and the wind.
        word: its letters.
        certificate: how close the two come.
    """
    joined, d_min = path.duration, situation.min_separation
    times = np.linspace(0.0, joined, POINTS)
    own = path.over_ground(situation.wind, times)
    leading = situation.leader.trajectory.over_ground(situation.wind, times)
    closest = [certificate.at_time]
    ours = path.over_ground(situation.wind, closest)
    theirs = situation.leader.trajectory.over_ground(situation.wind, closest)
    view, height = _fit(own, leading, (theirs.x[0], theirs.y[0], d_min))
    near, far = view.place(ours.x[0], ours.y[0]), view.place(theirs.x[0], theirs.y[0])
    bends = path.over_ground(situation.wind, np.cumsum(path.durations())[:-1])
    end = view.place(own.x[-1], own.y[-1])
    proved = certificate.lower_bound
    parts = [
        f'<rect width="{WIDTH:g}" height="{height:.0f}" rx="6" fill="#ffffff"/>',
        _text(16, 26, f"{word} · joins in {_clock(joined)}", more=TITLE),
        _text(
            16, 46, f"least separation {_miles(certificate.least_separation)} at "
            f"{_clock(certificate.at_time)}, proved above {_miles(proved, down=True)}",
        ),
        _circle(far, d_min * view.scale, f'stroke="{LEADER}" stroke-dasharray="6 4"'),
        _line([near, far], f'stroke="{LEADER}" stroke-dasharray="2 3"'),
        _line(_places(view, leading), f'stroke="{LEADER}" stroke-width="1.8" '
              'stroke-dasharray="12 4 2 4"'),
        _line(_places(view, own), f'stroke="{OWN}" stroke-width="2.6"'),
        *(
            _circle(view.place(x, y), 3.0, f'stroke="{OWN}" stroke-width="1.6"', fill="#ffffff")
            for x, y in zip(bends.x, bends.y, strict=True)
        ),
        _circle(end, 6.0, f'stroke="{OWN}" stroke-width="2"', fill="#ffffff"),
        _circle(end, 2.2, "", fill=OWN),
        *(_symbol(view, leading, at, CHEVRON, f'fill="{LEADER}"') for at in (0, -1)),
        _symbol(view, own, 0, AIRCRAFT, f'fill="none" stroke="{INK}" stroke-width="2.4"'),
        *_scale_bar(view, height),
        _text(
            WIDTH - 16, height - 14, f"d_min {_miles(d_min)} · D {_miles(situation.slot_distance)}",
            more=END,
        ),
        _text(WIDTH - 16, 26, "N ↑", more=END),
    ]  # fmt: skip
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH:g}" height="{height:.0f}" '
        f'viewBox="0 0 {WIDTH:g} {height:.0f}" font-family="{FONT}" font-size="12.5">'
        f"{''.join(parts)}</svg>"
    )


def _fit(own: Samples, leading: Samples, circle: tuple[Metre, Metre, Metre]) -> tuple[_View, float]:
    """The view with all in sight, and the height of the drawing [px]."""
    x, y, radius = circle
    xs = np.concatenate([own.x, leading.x, [x - radius, x + radius]])
    ys = np.concatenate([own.y, leading.y, [y - radius, y + radius]])
    across, up = float(np.ptp(xs)), float(np.ptp(ys))
    room = WIDTH - 2.0 * MARGIN, MOST_HEIGHT - HEAD - FOOT - 2.0 * MARGIN
    scale = min(room[0] / max(across, 1.0), room[1] / max(up, 1.0))
    height = max(LEAST_HEIGHT, HEAD + FOOT + 2.0 * MARGIN + up * scale)
    left = 0.5 * (WIDTH - across * scale)
    top = 0.5 * (HEAD + height - FOOT - up * scale)
    return _View(float(xs.min()), float(ys.max()), scale, left, top), height


def _places(view: _View, flown: Samples) -> list[tuple[float, float]]:
    return [view.place(x, y) for x, y in zip(flown.x.tolist(), flown.y.tolist(), strict=True)]


def _line(places: list[tuple[float, float]], look: str) -> str:
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    return f'<polyline points="{points}" fill="none" {look}/>'


def _circle(at: tuple[float, float], radius: float, look: str, fill: str = "none") -> str:
    return f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="{radius:.1f}" fill="{fill}" {look}/>'


def _symbol(view: _View, flown: Samples, at: int, shape: str, look: str) -> str:
    x, y = view.place(flown.x[at], flown.y[at])
    turned = degrees(flown.heading[at])
    return f'<path d="{shape}" transform="translate({x:.1f} {y:.1f}) rotate({turned:.1f})" {look}/>'


def _scale_bar(view: _View, height: float) -> list[str]:
    longest = 0.25 * WIDTH / view.scale / NM
    miles = max((step for step in STEPS_NM if step <= longest), default=STEPS_NM[0])
    end, y = 16.0 + miles * NM * view.scale, height - 18.0
    bar = f"M16 {y - 4:.1f}V{y:.1f}H{end:.1f}V{y - 4:.1f}"
    return [
        f'<path d="{bar}" fill="none" stroke="{INK}" stroke-width="1.4"/>',
        _text(end + 8.0, y + 4.0, f"{miles:g} NM"),
    ]


def _text(x: float, y: float, words: str, *, more: str = "") -> str:
    return f'<text x="{x:g}" y="{y:g}" fill="{INK}"{more}>{words}</text>'


def _clock(t: Second) -> str:
    return f"{round(t) // 60:02d}:{round(t) % 60:02d}"


def _miles(length: Metre, *, down: bool = False) -> str:
    """In nautical miles; what is proved is rounded down."""
    miles = length / NM
    return f"{(int(miles * 100.0 + 1e-9) / 100.0 if down else miles):.2f} NM"

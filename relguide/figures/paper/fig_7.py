"""Fig. 7: the navigation display in Fig. 6b, beside what section 6 asks it to show."""

from html import escape
from math import cos, sin

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.flying.documents import Document, ForecastChanged, PlanChanged, Sample
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.pictures.picture import picture
from relguide.planning.plan import plan
from relguide.units import NM, Metre, Radian

SCENARIO, INSTANT, RANGE = "fig_6b", 560.0, 80
COMMAND = f"relguide picture {SCENARIO} --at {INSTANT:.0f} --light --out nd.svg"
WIDTH, HEIGHT, LIST = 768, 824, 470
"""The display's own size, and the width of the list [px]."""
OWN = 384.0, 620.0
"""Where the own aircraft is on the display in ARC [px]."""
ACROSS = 500.0
"""From it to the end of the range [px]."""
Point = tuple[float, float]
ELEMENTS = (
    ("the pursuer", "own aircraft, nose up, trend in minutes"),
    ("the leader", "ringed as designated, with its level and speed"),
    ("its route and intent", "dash-dotted, ticks each minute, the turn to 135°"),
    ("the convergence trajectory", "solid once planned, dashed while proposed"),
    ("its turns", "T2: where the next one begins"),
    ("where it converges", "ring on the route, time to go"),
    ("minimum separation", "circle of d_min round the leader"),
    ("least separation ahead", "dotted circle, with its value"),
    ("heading", "scale, lubber line, commanded heading"),
    ("distance", "rings [NM]"),
    ("guidance", "engaged and armed modes, D, autopilot"),
    ("the slot's figures", "D, d, closing speed, cross-track, time to go"),
)
"""What a pilot needs of the manoeuvre, and how the display gives it."""


def draw(step: Step) -> Drawn:
    """The display on the left, numbered; the list on the right."""
    told = [
        one for one in fly(scenario(SCENARIO), plan, sample_period=1.0) if one.t <= INSTANT + 1.0
    ]
    step(0.5)
    shown = picture(told, INSTANT, mode="ARC", range_nm=RANGE, palette="light", caption=COMMAND)
    numbers = "".join(_mark(k, *point) for k, point in enumerate(_places(told), start=1))
    rows = "".join(_row(k, *words) for k, words in enumerate(ELEMENTS, start=1))
    text = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH + LIST}" height="{HEIGHT}" '
        f'viewBox="0 0 {WIDTH + LIST} {HEIGHT}" font-family="B612, Inter, \'Segoe UI\', '
        "'DejaVu Sans', sans-serif\">"
        f'<rect width="100%" height="100%" fill="#ffffff"/>{shown}{numbers}'
        f'<text x="{WIDTH + 24}" y="60" font-size="19" font-weight="bold">A planned convergence'
        f"</text>{rows}</svg>\n"
    )
    return Drawn(
        text,
        f"The display of the cockpit at {INSTANT:.0f} s of Fig. 6b, drawn by the cockpit's own "
        f"program (`{COMMAND}`). Section 6: it shows a proposed or planned manoeuvre to the pilot.",
    )


def _places(told: list[Document]) -> list[Point]:
    """Where each element is on the display."""
    now = next(one for one in told if isinstance(one, Sample) and one.t >= INSTANT)
    own, leader = now.aircraft
    card = [one for one in told if isinstance(one, PlanChanged)][-1]
    segments = card.plan.segments
    closest = [one for one in told if isinstance(one, ForecastChanged)][-1].leader_at_closest

    def at(x: Metre, y: Metre) -> Point:
        return _on_display(x - own.x, y - own.y, own.heading)

    turn, joined = segments[-1].start, segments[-1].end
    if segments[-1].kind == "straight":
        turn = segments[-2].start
    lead = at(leader.x, leader.y)
    begin, close = at(turn.x, turn.y), at(closest.x, closest.y)
    end = at(joined.x, joined.y)
    return [
        (OWN[0] - 46.0, OWN[1] + 14.0),
        (lead[0] + 58.0, lead[1] + 40.0),
        (0.45 * lead[0] + 0.55 * begin[0] + 26.0, 0.45 * lead[1] + 0.55 * begin[1] - 6.0),
        (OWN[0] - 24.0, 0.5 * (OWN[1] + begin[1])),
        (begin[0] - 52.0, begin[1]),
        (end[0] + 148.0, end[1] + 27.0),
        (lead[0] + 124.0, lead[1] - 10.0),
        (close[0] + 50.0, close[1]),
        (292.0, 168.0),
        (60.0, 470.0),
        (441.0, 16.0),
        (185.0, 612.0),
    ]


def _on_display(east: Metre, north: Metre, heading: Radian) -> Point:
    """Nose up, from the own aircraft."""
    scale = ACROSS / (RANGE * NM)
    ahead = east * sin(heading) + north * cos(heading)
    right = east * cos(heading) - north * sin(heading)
    return OWN[0] + scale * right, OWN[1] - scale * ahead


def _mark(number: int, x: float, y: float) -> str:
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="12" fill="#222222"/>'
        f'<text x="{x:.1f}" y="{y + 5:.1f}" font-size="14" font-weight="bold" fill="#ffffff" '
        f'text-anchor="middle">{number}</text>'
    )


def _row(number: int, name: str, shown: str) -> str:
    x, y = WIDTH + 36, 58 + 56 * number
    return (
        f"{_mark(number, x, y - 5)}"
        f'<text x="{x + 24}" y="{y}" font-size="17">{escape(name)}</text>'
        f'<text x="{x + 24}" y="{y + 20}" font-size="14" fill="#555555">{escape(shown)}</text>'
    )


FIGURE = NamedFigure(
    name="fig_7",
    title="Fig. 7: the manoeuvre on the navigation display",
    seconds=2.0,
    draw=draw,
    needs=("quickjs",),
)

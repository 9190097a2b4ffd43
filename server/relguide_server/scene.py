"""A sink of documents: the first link of a flight in 3D, drawn on a viser server.

Scene frame: x east, y north, z up; 1 unit = 1 km, heights ×`ALTITUDE_SCALE`. Everything hangs under
`/world`, which is moved so that the middle between the two aircraft stays at the origin: the
camera, which belongs to the viewer, then follows the flight without being moved.
"""

from collections.abc import Sequence
from math import cos, sin
from typing import NamedTuple, assert_never

import numpy as np
from viser import ViserServer

from relguide.flying.aircraft_documents import (
    AircraftCard,
    AircraftSample,
    GuidanceSample,
    LinkCard,
    find_by_ident,
)
from relguide.flying.documents import (
    Alert,
    Document,
    EngagementChanged,
    FlightEnded,
    FlightStarted,
    ForecastChanged,
    LeaderChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    PlanProposed,
    PlanRefused,
    PlanUnavailable,
    Sample,
    SeparationLost,
    Unable,
)
from relguide.flying.modes import Mode
from relguide.units import NM
from relguide_server import scene_paint as paint
from relguide_server import scene_shapes as shapes
from relguide_server.scene_aircraft import ENLARGED, AircraftFigure, height_of
from relguide_server.scene_camera import Cameras
from relguide_server.scene_paint import label, lines
from relguide_server.scene_shapes import ALTITUDE_SCALE, KM

CELL = 5.0 * NM / KM
"""Cell of the ground grid [scene units]."""
FLOWN_PART = 4.0
"""The path ahead is cut off behind the aircraft each so many seconds [s]: a kilometre."""
WALL = 0.8
"""Half the height of the cylinder of radius d_min [scene units]; separation is horizontal."""


GATES: dict[Mode, paint.Colour] = {
    "heading": paint.SLOT,
    "converge": paint.PLAN,
    "capture": paint.PLAN,
    "follow": paint.PLAN,
    "escape": paint.CAUTION,
}
"""The slot's colour, as on the navigation display."""


class _Cast(NamedTuple):
    """Who is drawn."""

    link: LinkCard
    pursuer: AircraftCard
    leader: AircraftCard


class _Pair(NamedTuple):
    """Both of them at one instant."""

    pursuer: AircraftSample
    leader: AircraftSample
    guidance: GuidanceSample


class Scene:
    """Draws one flight, from one thread."""

    def __init__(self, server: ViserServer) -> None:
        self._server = server
        self._scene = server.scene
        self._wind = (0.0, 0.0)
        self._height = 0.0
        self._own_height = 0.0
        self._forecast: ForecastChanged | None = None
        self._proposal: PlanProposed | None = None
        self._drawn_from = 0.0
        self._promise = ""
        self._cast: _Cast | None = None
        self._figures: dict[str, AircraftFigure] = {}
        self._separation_lost = False
        self._gate = (paint.SLOT, "")
        server.gui.configure_theme(dark_mode=True, show_logo=False, show_share_button=False)
        server.scene.set_background_image(np.full((1, 1, 3), paint.BACKGROUND, dtype=np.uint8))
        server.scene.set_up_direction("+z")
        server.scene.configure_default_lights(cast_shadow=False)
        self._world = server.scene.add_frame("/world", show_axes=False)
        self._scale = server.scene.add_frame("/world/scale", show_axes=False)
        self._slot = server.scene.add_frame("/world/slot", show_axes=False)
        self._cameras = Cameras(server)

    def draw(self, documents: Sequence[Document]) -> None:
        """Bring the picture up to date with documents in the order of the flight."""
        for document in documents:
            if isinstance(document, FlightStarted):
                self._cast = _cast(document)
        if self._cast is None:
            return
        # Paths are drawn at the heights of those who fly them: a sample behind may bring these.
        link = self._cast.link
        samples = [d for d in documents if isinstance(d, Sample)]
        if samples:
            self._height = height_of(find_by_ident(samples[-1].aircraft, link.leader))
            self._own_height = height_of(find_by_ident(samples[-1].aircraft, link.pursuer))
        with self._server.atomic():
            for document in documents:
                self._draw_one(document, self._cast)

    def _draw_one(self, document: Document, cast: _Cast) -> None:
        link = cast.link
        match document:
            case FlightStarted():
                self._start(document)
            case LeaderRoute():
                if (document.expected_by, document.ident) == (link.pursuer, link.leader):
                    self._draw_route(document)
            case PlanChanged():
                if document.ident == link.pursuer:
                    self._draw_plan(document)
            case PlanUnavailable():
                if document.ident != link.pursuer:
                    return
                self._scene.remove_by_name("/world/plan")
            case ModeChanged(ident=ident, mode="heading" | "escape" | "capture" | "follow"):
                if ident == link.pursuer:
                    self._scene.remove_by_name("/world/plan")
            case ForecastChanged():
                if document.ident == link.pursuer:
                    self._forecast = document
                    self._draw_forecast(document.t)
            case Sample():
                self._sample(document.t, _pair(document, link), cast)
            case LeaderChanged() | ModeChanged() | SeparationLost() | FlightEnded():
                pass  # what they change is seen in the samples
            case PlanProposed():
                if document.ident == link.pursuer:
                    self._proposal = document
                    self._draw_proposal(paint.PROPOSED)
            case EngagementChanged():
                if document.ident == link.pursuer:
                    self._change_engagement(document)
            case PlanRefused() | Alert() | Unable():
                pass  # for the navigation display
            case _:
                assert_never(document)

    def _start(self, started: FlightStarted) -> None:
        wind = started.wind
        self._wind = (-wind.speed * sin(wind.from_), -wind.speed * cos(wind.from_))
        self._draw_ground()

    def _draw_ground(self) -> None:
        """The grid, and a scale on it: two cells long, with north beside it."""
        self._scene.add_grid(
            "/world/grid",
            infinite_grid=True,
            cell_size=CELL,
            cell_color=paint.GRID,
            cell_thickness=1.0,
            section_size=4.0 * CELL,
            section_color=paint.GRID_SECTION,
            section_thickness=1.4,
            fade_distance=300.0,
            shadow_opacity=0.0,
        )
        bar = [
            [(0, 0, 0), (2 * CELL, 0, 0)],
            *([(k * CELL, -0.7, 0), (k * CELL, 0.7, 0)] for k in range(3)),
            [(0, 0, 0), (0, CELL, 0)],
            [(0, CELL, 0), (-0.8, CELL - 2.0, 0)],
            [(0, CELL, 0), (0.8, CELL - 2.0, 0)],
        ]
        lines(self._scene, "/world/scale/bar", np.array(bar, dtype=float), paint.LEADER, 2.0)
        for k, text in ((0, "0"), (1, "5"), (2, "10 NM")):
            label(self._scene, f"/world/scale/{k}", text, (k * CELL, -1.0, 0), "top-center")
        label(self._scene, "/world/scale/north", "N", (0, CELL + 0.4, 0), "bottom-center")
        note = f"grid 5 NM · heights ×{ALTITUDE_SCALE:.0f} · aircraft ×{ENLARGED:.0f}: NOT TO SCALE"
        label(self._scene, "/world/scale/note", note, (0, -4.5, 0), "top-left")

    def _draw_plan(self, changed: PlanChanged) -> None:
        """The plan's ideal path, a thin line beside the one that will be flown."""
        points = shapes.path_points(changed.plan.segments, self._wind, self._own_height)
        lines(self._scene, "/world/plan", shapes.polyline(points), paint.PLAN, 1.0)

    def _draw_proposal(self, colour: paint.Colour) -> None:
        """The path that could be flown, dashed."""
        if self._proposal is None:
            self._scene.remove_by_name("/world/proposal")
            return
        segments = self._proposal.plan.segments
        points = shapes.path_points(segments, self._wind, self._own_height)
        lines(self._scene, "/world/proposal", shapes.dashes(points, dash=2.4, gap=2.0), colour, 2.5)

    def _change_engagement(self, changed: EngagementChanged) -> None:
        """A proposal is accepted, or taken back, or there is none any more."""
        if {changed.previous, changed.engagement} != {"designated", "armed"}:
            self._proposal = None
        armed = changed.engagement == "armed"
        self._draw_proposal(paint.SLOT if armed else paint.PROPOSED)

    def _draw_forecast(self, t: float) -> None:
        """What is left at flight time t [s] of the path that will be flown, and its shadow."""
        forecast, self._drawn_from = self._forecast, t
        if forecast is None or t >= forecast.times[-1]:
            for name in ("/world/forecast", "/world/forecast_shadow"):
                self._scene.remove_by_name(name)
            return
        columns = (forecast.times, forecast.x, forecast.y)
        points = shapes.timed_points(*columns, height=self._own_height, since=t)
        lines(self._scene, "/world/forecast", shapes.polyline(points), paint.PLAN, 3.0)
        shadow = shapes.polyline(points * (1.0, 1.0, 0.0))
        lines(self._scene, "/world/forecast_shadow", shadow, paint.PLAN_SHADOW, 1.5)

    def _draw_promise(self, t: float, guidance: GuidanceSample) -> None:
        """Where it joins, and how long until then, as the navigation display has it."""
        forecast, left = self._forecast, guidance.time_to_go
        minutes, seconds = divmod(round(left), 60)
        text = f"CNV {minutes:02d}:{seconds:02d}"
        if left <= 0.0 or forecast is None or t + left > forecast.times[-1] + 0.5:
            text = ""
        if text == self._promise:
            return
        self._promise = text
        if not text or forecast is None:
            self._scene.remove_by_name("/world/join")
            return
        x = float(np.interp(t + left, forecast.times, forecast.x)) / KM
        y = float(np.interp(t + left, forecast.times, forecast.y)) / KM
        label(self._scene, "/world/join", text, (x, y, self._own_height), "bottom-left")

    def _draw_route(self, route: LeaderRoute) -> None:
        points = shapes.path_points(route.segments, self._wind, self._height)
        # The style carries the state: long dashes are a declared intent, dots are a guess.
        dash, gap = (2.4, 1.4) if route.intent_known else (0.4, 1.6)
        segments = shapes.dashes(points, dash=dash, gap=gap)
        lines(self._scene, "/world/route", segments, paint.LEADER, 2.0)

    def _sample(self, t: float, pair: _Pair, cast: _Cast) -> None:
        guidance, min_separation = pair.guidance, cast.link.min_separation
        if not self._figures:
            self._first(pair, cast)
        self._figures["pursuer"].move(pair.pursuer, t)
        self._figures["leader"].move(pair.leader, t)
        if t - self._drawn_from >= FLOWN_PART:
            self._draw_forecast(t)
        self._draw_promise(t, guidance)
        self._centre(pair)
        self._cameras.frame(guidance.separation / KM, self._height)
        slot = guidance.slot
        self._slot.position = (slot.x / KM, slot.y / KM, self._height)
        self._slot.wxyz = shapes.attitude(slot.heading, 0.0)
        self._slot.visible = guidance.engagement != "off"
        colour = GATES[guidance.mode] if guidance.engagement == "engaged" else paint.SLOT
        gate = (colour, "SLOT · joined" if guidance.joined else "SLOT")
        if gate != self._gate:
            self._draw_gate(*gate)
        lost = guidance.separation < min_separation
        if lost != self._separation_lost:
            self._draw_min_separation(min_separation, lost=lost)

    def _first(self, pair: _Pair, cast: _Cast) -> None:
        scene = self._scene
        self._figures = {
            "pursuer": AircraftFigure(scene, "pursuer", paint.PURSUER, cast.pursuer, pair.pursuer),
            "leader": AircraftFigure(scene, "leader", paint.LEADER, cast.leader, pair.leader),
        }
        self._draw_min_separation(cast.link.min_separation, lost=False)

    def _centre(self, pair: _Pair) -> None:
        x = (pair.pursuer.x + pair.leader.x) / 2.0 / KM
        y = (pair.pursuer.y + pair.leader.y) / 2.0 / KM
        self._world.position = (-x, -y, 0.0)
        # The scale moves in whole cells, so that it stays on the lines of the grid.
        south = y - max(0.35 * pair.guidance.separation / KM, CELL)
        self._scale.position = (CELL * round(x / CELL - 1.5), CELL * round(south / CELL), 0.0)

    def _draw_gate(self, colour: paint.Colour, text: str) -> None:
        self._gate = (colour, text)
        lines(self._scene, "/world/slot/gate", shapes.gate(3.6, 2.4), colour, 3.0)
        lines(self._scene, "/world/slot/drop", shapes.drop(self._height, 0.5), colour, 0.8)
        label(self._scene, "/world/slot/text", text, (0, 0, -1.4), "top-center")

    def _draw_min_separation(self, min_separation: float, *, lost: bool) -> None:
        """d_min round the leader, at its altitude."""
        self._separation_lost = lost
        radius = min_separation / KM
        if radius <= 0.0:
            return
        colour = paint.ALERT if lost else paint.LEADER
        self._scene.add_cylinder(
            "/world/leader/min_separation",
            radius,
            2.0 * WALL,
            colour,
            opacity=0.14,
            radial_segments=72,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )
        edges = np.concatenate((shapes.ring(radius, WALL), shapes.ring(radius, -WALL)))
        lines(self._scene, "/world/leader/edge", edges, colour, 1.5)
        text = f"MIN {min_separation / NM:.1f} NM"
        label(
            self._scene,
            "/world/leader/min_separation_text",
            text,
            (0.8 * radius, -0.6 * radius, -WALL),
            "top-left",
        )


def _cast(started: FlightStarted) -> _Cast:
    link = started.links[0]
    return _Cast(
        link,
        find_by_ident(started.aircraft, link.pursuer),
        find_by_ident(started.aircraft, link.leader),
    )


def _pair(sample: Sample, link: LinkCard) -> _Pair:
    return _Pair(
        find_by_ident(sample.aircraft, link.pursuer),
        find_by_ident(sample.aircraft, link.leader),
        find_by_ident(sample.guidance, link.pursuer),
    )

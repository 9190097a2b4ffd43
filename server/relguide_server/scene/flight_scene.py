"""A sink of documents: the first link of a flight in 3D, drawn on a viser server.

Scene frame: x east, y north, z up; 1 unit = 1 km, heights ×`ALTITUDE_SCALE`. Everything hangs under
`/world`, which is moved so that the middle between the two aircraft stays at the origin: the
camera, which belongs to the viewer, then follows the flight without being moved.
"""

from collections.abc import Sequence
from dataclasses import replace
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
    FanChanged,
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
    PromiseChanged,
    Sample,
    SeparationLost,
    Unable,
)
from relguide.flying.plan_documents import PathPoint
from relguide.planning.frames import LocalPlane
from relguide.units import NM, Metre, Second
from relguide_server.scene import paint as paint
from relguide_server.scene import shapes as shapes
from relguide_server.scene.aircraft import AircraftFigure, height_of, place_of
from relguide_server.scene.camera import Cameras
from relguide_server.scene.extrapolation import carry, onward
from relguide_server.scene.ground import draw_ground
from relguide_server.scene.paint import lines
from relguide_server.scene.shapes import KM, GateLook

CELL = 5.0 * NM / KM
"""Cell of the ground grid [scene units]."""
FLOWN_PART = 4.0
"""The path ahead is cut off behind the aircraft each so many seconds [s]: a kilometre."""
WALL = 0.8
"""Half the height of the cylinder of radius d_min [scene units]; separation is horizontal."""


DASHED = (2.4, 2.0)
"""A path that is proposed or accepted."""
DECLARED = (2.4, 0.8, 0.4, 0.8)
"""The leader's route as it declared it: dash-dot."""
GUESSED = (0.4, 1.6)
"""Where it goes if it flies straight on: dots."""
THIN = (1.6, 1.0)
"""Distances: the minimum, the closest approach."""
HALO = 1.0
"""Radius of the rings that mark both aircraft when they are closest [scene units]."""
GRAZE = 20.0
"""Plans may graze d_min: this much below it is no loss yet [m]."""


class _Cast(NamedTuple):
    """Who is drawn."""

    link: LinkCard
    pursuer: AircraftCard
    leader: AircraftCard


class _Closest(NamedTuple):
    """When the two are closest, and where."""

    t: Second
    pursuer: PathPoint
    leader: PathPoint


class _Pair(NamedTuple):
    """Both of them at one instant."""

    pursuer: AircraftSample
    leader: AircraftSample
    guidance: GuidanceSample


class FlightScene:
    """Draws one flight, from one thread; with coasts and airports, if it is somewhere on earth."""

    def __init__(self, server: ViserServer, plane: LocalPlane | None = None) -> None:
        self._plane = plane
        self._server = server
        self._scene = server.scene
        self._wind = (0.0, 0.0)
        self._height = 0.0
        self._radius = 0.0
        self._own_height = 0.0
        self._forecast: ForecastChanged | None = None
        self._proposal: PlanProposed | None = None
        self._plan: PlanChanged | None = None
        self._drawn_from = 0.0
        self._closest: _Closest | None = None
        self._pair: _Pair | None = None
        self._cast: _Cast | None = None
        self._figures: dict[str, AircraftFigure] = {}
        self._drawn: set[str] = set()
        self._min_colour = paint.LEADER
        self._gate: tuple[paint.Colour, GateLook] | None = None
        server.gui.configure_theme(dark_mode=True, show_logo=False, show_share_button=False)
        server.scene.set_background_image(np.full((1, 1, 3), paint.BACKGROUND, dtype=np.uint8))
        server.scene.set_up_direction("+z")
        server.scene.configure_default_lights(cast_shadow=False)
        self._world = server.scene.add_frame("/world", show_axes=False)
        self._slot = server.scene.add_frame("/world/slot", show_axes=False)
        self._cameras = Cameras(server)

    def draw(self, documents: Sequence[Document]) -> None:
        """Bring the picture up to date with documents in the order of the flight."""
        for document in documents:
            if isinstance(document, FlightStarted):
                self._cast = _cast(document)
                self._radius = self._cast.link.min_separation / KM
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
                    self._plan = document
                    self._draw_plan(document.t)
            case PlanUnavailable():
                if document.ident != link.pursuer:
                    return
                self._forget_plan()
            case ModeChanged(ident=ident, mode="heading" | "escape" | "capture" | "follow"):
                if ident == link.pursuer:
                    self._forget_plan()
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
            case PlanRefused() | PromiseChanged() | FanChanged() | Alert() | Unable():
                pass  # for the navigation display
            case _:
                assert_never(document)

    def glide(self, ahead: Second) -> None:
        """Carry the picture on from the newest sample: both turn on as they did then."""
        if self._pair is None:
            return
        pursuer, leader, guidance = self._pair
        slot = onward(guidance.slot, leader.ground_speed, guidance.slot.heading, ahead)
        moved = _Pair(carry(pursuer, ahead), carry(leader, ahead), replace(guidance, slot=slot))
        with self._server.atomic():
            self._place(moved)

    def _start(self, started: FlightStarted) -> None:
        wind = started.wind
        self._wind = (-wind.speed * sin(wind.from_), -wind.speed * cos(wind.from_))
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
        if self._plane is not None:
            draw_ground(self._scene, self._plane)

    def _draw_plan(self, t: Second) -> None:
        """What is left of the plan's ideal path, a thin line beside the one that will be flown."""
        if self._plan is None:
            return
        segments, since = self._plan.plan.segments, t - self._plan.t
        points = shapes.path_points(segments, self._wind, self._own_height, since=since)
        lines(self._scene, "/world/plan", shapes.polyline(points), paint.PLAN, 1.0)

    def _forget_plan(self) -> None:
        self._plan = None
        self._scene.remove_by_name("/world/plan")

    def _draw_proposal(self, colour: paint.Colour) -> None:
        """The path that could be flown, dashed."""
        if self._proposal is None:
            self._scene.remove_by_name("/world/proposal")
            return
        segments = self._proposal.plan.segments
        points = shapes.path_points(segments, self._wind, self._own_height)
        lines(self._scene, "/world/proposal", shapes.dashes(points, DASHED), colour, 2.5)

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

    def _draw_closest(self, t: Second, guidance: GuidanceSample) -> None:
        """Where both are when they are closest, while that is to come and is not the join."""
        found = self._closest_ahead(t, guidance)
        if found == self._closest:
            return
        self._closest = found
        if found is None:
            for name in ("/world/closest", "/world/closest_min"):
                self._scene.remove_by_name(name)
            return
        own = np.array((found.pursuer.x / KM, found.pursuer.y / KM, self._own_height))
        leader = np.array((found.leader.x / KM, found.leader.y / KM, self._height))
        marks = [shapes.ring(HALO) + own, shapes.ring(HALO) + leader, np.array([[own, leader]])]
        lines(self._scene, "/world/closest", np.concatenate(marks), paint.LEADER, 1.5)
        then = shapes.dashes(shapes.circle(self._radius) + leader, GUESSED)
        lines(self._scene, "/world/closest_min", then, paint.LEADER, 1.2)

    def _closest_ahead(self, t: Second, guidance: GuidanceSample) -> _Closest | None:
        proposal, forecast = self._proposal, self._forecast
        if proposal is not None and guidance.engagement in ("designated", "armed"):
            closest = proposal.plan.separation.at
            at, join = proposal.t + closest, proposal.t + proposal.plan.time_to_converge
            own, leader = proposal.pursuer_at_closest, proposal.leader_at_closest
        elif forecast is not None and guidance.time_to_go > 0.0:
            own, leader = forecast.pursuer_at_closest, forecast.leader_at_closest
            at, join = own.t, t + guidance.time_to_go
        else:
            return None
        return _Closest(at, own, leader) if t < at < join - 1.0 else None

    def _draw_route(self, route: LeaderRoute) -> None:
        points = shapes.path_points(route.segments, self._wind, self._height)
        # The style carries the state: dash-dot is a declared intent, dots are a guess.
        pattern = DECLARED if route.intent_known else GUESSED
        lines(self._scene, "/world/route", shapes.dashes(points, pattern), paint.LEADER, 2.0)

    def _sample(self, t: Second, pair: _Pair, cast: _Cast) -> None:
        guidance = pair.guidance
        if not self._figures:
            self._first(pair)
        self._pair = pair
        self._figures["pursuer"].mark(pair.pursuer, t)
        self._figures["leader"].mark(pair.leader, t)
        if t - self._drawn_from >= FLOWN_PART:
            self._draw_forecast(t)
            self._draw_plan(t)
        self._draw_closest(t, guidance)
        self._slot.visible = guidance.engagement != "off"
        self._draw_gate(guidance)
        self._draw_min_separation(guidance, cast.link.min_separation)
        self._place(pair)

    def _place(self, pair: _Pair) -> None:
        """Put what moves where it is, and the middle of the two at the origin."""
        self._figures["pursuer"].move(pair.pursuer)
        self._figures["leader"].move(pair.leader)
        slot = pair.guidance.slot
        self._slot.position = (slot.x / KM, slot.y / KM, self._height)
        self._slot.wxyz = shapes.attitude(slot.heading, 0.0)
        own, leader = place_of(pair.pursuer), place_of(pair.leader)
        x, y = (own[0] + leader[0]) / 2.0, (own[1] + leader[1]) / 2.0
        self._world.position = (-x, -y, 0.0)
        self._cameras.frame(
            (own[0] - x, own[1] - y, own[2]),
            (leader[0] - x, leader[1] - y, leader[2]),
            self._radius,
        )

    def _first(self, pair: _Pair) -> None:
        scene = self._scene
        self._figures = {
            "pursuer": AircraftFigure(scene, "pursuer", paint.PURSUER, pair.pursuer),
            "leader": AircraftFigure(scene, "leader", paint.LEADER, pair.leader),
        }

    def _draw_gate(self, guidance: GuidanceSample) -> None:
        gate = _gate_of(guidance)
        if gate == self._gate:
            return
        self._gate = colour, look = gate
        lines(self._scene, "/world/slot/gate", shapes.gate(3.6, 2.4, look), colour, 3.0)
        lines(self._scene, "/world/slot/drop", shapes.drop(self._height, 0.5), colour, 0.8)

    def _draw_min_separation(self, guidance: GuidanceSample, min_separation: Metre) -> None:
        """d_min round the leader, at its altitude."""
        colour = _min_colour(guidance, min_separation)
        radius = min_separation / KM
        name = "/world/leader/min_separation"
        if radius <= 0.0 or (colour == self._min_colour and name in self._drawn):
            return
        self._drawn.add(name)
        self._min_colour = colour
        self._scene.add_cylinder(
            name,
            radius,
            2.0 * WALL,
            colour,
            opacity=0.14,
            radial_segments=72,
            side="double",
            cast_shadow=False,
            receive_shadow=False,
        )
        edges = [shapes.dashes(shapes.circle(radius, z), THIN) for z in (WALL, -WALL)]
        lines(self._scene, "/world/leader/edge", np.concatenate(edges), colour, 1.5)


def _gate_of(guidance: GuidanceSample) -> tuple[paint.Colour, GateLook]:
    """The slot's colour and look, as on the navigation display."""
    unable = guidance.engagement == "engaged" and guidance.mode == "heading"
    if unable or guidance.mode == "escape":
        return paint.CAUTION, "crossed"
    colour = paint.PLAN if guidance.engagement == "engaged" else paint.SLOT
    return colour, "filled" if guidance.joined else "open"


def _min_colour(guidance: GuidanceSample, min_separation: Metre) -> paint.Colour:
    if guidance.separation < min_separation - GRAZE:
        return paint.ALERT
    return paint.CAUTION if guidance.alert in ("caution", "warning") else paint.LEADER


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

"""A sink of documents: the first link of a flight in 3D, drawn on a viser server.

Scene frame: x east, y north, z up; 1 unit = 1 km, heights ×`ALTITUDE_SCALE`. Everything hangs under
`/world`, which is moved so that the middle between the two aircraft stays at the origin: the
camera, which belongs to the viewer, then follows the flight without being moved.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import cos, inf, sin
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
    AssignmentChanged,
    ClearanceNews,
    CommandGiven,
    ControlChanged,
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
from relguide.planning.frames import LocalPlane
from relguide.units import NM, Second
from relguide_server.scene import paint as paint
from relguide_server.scene import shapes as shapes
from relguide_server.scene.aircraft import (
    LENGTH,
    AircraftFigure,
    enlargement,
    height_of,
    place_of,
)
from relguide_server.scene.camera import Array, Cameras, Sights
from relguide_server.scene.closest_pair import ClosestPair, closest_ahead
from relguide_server.scene.extrapolation import carry, onward
from relguide_server.scene.ground import draw_ground
from relguide_server.scene.minimum_ring import GONE, MinimumRing, leader_colour
from relguide_server.scene.paint import lines
from relguide_server.scene.shapes import KM
from relguide_server.scene.sky import draw_sky
from relguide_server.scene.slot_gate import SlotGate, is_silent
from relguide_server.scene.surroundings import Surroundings

CELL = 5.0 * NM / KM
"""Cell of the ground grid [scene units]."""
FLOWN_PART = 4.0
"""The path ahead is cut off behind the aircraft each so many seconds [s]: a kilometre."""
SEEN_EVERY = 30.0
"""Between two places of the path ahead that are kept in the picture [s]."""

DASHED = (2.4, 2.0)
"""A path that is proposed or accepted."""
DECLARED = (2.4, 0.8, 0.4, 0.8)
"""The leader's route as it declared it: dash-dot."""
GUESSED = (0.4, 1.6)
"""Where it goes if it flies straight on: dots."""


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
        self._was_flown = True
        self._pair: _Pair | None = None
        self._cast: _Cast | None = None
        self._figures: dict[str, AircraftFigure] = {}
        self._surroundings: Surroundings | None = None
        self._route: LeaderRoute | None = None
        self._is_routed = False
        self._ahead: Array = np.empty((0, 3))
        self._length = 0.0
        server.gui.configure_theme(dark_mode=True, show_logo=False, show_share_button=False)
        server.scene.set_background_image(np.full((1, 1, 3), paint.BACKGROUND, dtype=np.uint8))
        server.scene.set_up_direction("+z")
        draw_sky(server.scene)
        self._world = server.scene.add_frame("/world", show_axes=False)
        self._gate = SlotGate(server.scene)
        self._minimum = MinimumRing(server.scene)
        self._closest = ClosestPair(server.scene)
        self._cameras = Cameras(server)

    def draw(self, documents: Sequence[Document]) -> None:
        """Bring the picture up to date with documents in the order of the flight."""
        for document in documents:
            if isinstance(document, FlightStarted):
                self._cast = _cast(document)
                self._radius = self._cast.link.min_separation / KM
                self._surroundings = Surroundings(self._scene, self._cast.link, document.cells)
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
                    self._route = document
                    self._draw_route(document.t)
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
                    self._drawn_from = -inf  # the next sample says when it joins
            case Sample():
                self._sample(document.t, _pair(document, link), cast)
                self._draw_others(document, link)
            case LeaderChanged() | ModeChanged() | SeparationLost() | FlightEnded():
                pass  # what they change is seen in the samples
            case PlanProposed():
                if document.ident == link.pursuer:
                    self._proposal = document
                    self._draw_proposal(paint.PROPOSED)
            case EngagementChanged():
                if document.ident == link.pursuer:
                    self._change_engagement(document)
            case Alert():
                if document.ident == link.pursuer and self._surroundings is not None:
                    self._surroundings.warn(document)
            case PlanRefused() | PromiseChanged() | FanChanged() | Unable() | ClearanceNews():
                pass  # for the navigation display
            case CommandGiven() | ControlChanged() | AssignmentChanged():
                pass  # what they change is seen in the samples and plans
            case _:
                assert_never(document)

    def _draw_others(self, sample: Sample, link: LinkCard) -> None:
        if self._surroundings is None:
            return
        separation = find_by_ident(sample.guidance, link.pursuer).separation
        self._surroundings.draw(sample.t, sample.aircraft, enlargement(separation))

    def glide(self, ahead: Second) -> None:
        """Carry the picture on from the newest sample: both turn on as they did then."""
        if self._pair is None:
            return
        pursuer, leader, guidance = self._pair
        slot = onward(guidance.slot, leader.ground_speed, guidance.slot.heading, ahead)
        moved = _Pair(carry(pursuer, ahead), carry(leader, ahead), replace(guidance, slot=slot))
        with self._server.atomic():
            self._place(moved)
            if self._surroundings is not None:
                self._surroundings.move(ahead)

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
        if forecast is None or t >= forecast.times[-1] or not self._is_flown():
            for name in ("/world/forecast", "/world/forecast_shadow"):
                self._scene.remove_by_name(name)
            return
        columns = (forecast.times, forecast.x, forecast.y)
        points = shapes.timed_points(
            *columns, height=self._own_height, since=t, until=self._drawn_until(t)
        )
        lines(self._scene, "/world/forecast", shapes.polyline(points), paint.PLAN, 3.0)
        shadow = shapes.polyline(points * (1.0, 1.0, 0.0))
        lines(self._scene, "/world/forecast_shadow", shadow, paint.PLAN_SHADOW, 1.5)

    def _is_flown(self) -> bool:
        """Whether guidance flies: what the aircraft would do on its own is no path of guidance."""
        if self._pair is None:
            return True
        guidance = self._pair.guidance
        return guidance.engagement == "engaged" and guidance.mode != "heading"

    def _drawn_until(self, t: Second) -> Second:
        """Up to when the path is drawn: the join, or once joined where the leader is now."""
        if self._pair is None or self._cast is None:
            return inf
        guidance, leader = self._pair.guidance, self._pair.leader
        if guidance.mode == "follow":
            return t + self._cast.link.slot_distance / max(1.0, leader.ground_speed)
        return t + guidance.time_to_go if guidance.time_to_go > 0.0 else inf

    def _draw_route(self, t: Second) -> None:
        """What is to come of the leader's route: dash-dot as declared, dots where it is a guess."""
        if self._route is None:
            return
        points = shapes.path_points(self._route.segments, self._wind, self._height, since=t)
        pattern = DECLARED if self._route.intent_known else GUESSED
        dashed = shapes.dashes(points, pattern)
        drawn = lines(self._scene, "/world/route", dashed, paint.LEADER, 2.0)
        drawn.visible = self._is_routed

    def _sample(self, t: Second, pair: _Pair, cast: _Cast) -> None:
        guidance = pair.guidance
        if not self._figures:
            self._first(pair)
        self._pair = pair
        self._figures["pursuer"].mark(pair.pursuer, t)
        self._figures["leader"].mark(pair.leader, t)
        is_flown, is_routed = self._is_flown(), _is_routed(guidance)
        is_changed = (is_flown, is_routed) != (self._was_flown, self._is_routed)
        self._was_flown, self._is_routed = is_flown, is_routed
        if t - self._drawn_from >= FLOWN_PART or is_changed:
            self._draw_route(t)
            self._draw_forecast(t)
            self._draw_plan(t)
        closest = closest_ahead(t, guidance, self._proposal, self._forecast)
        self._closest.draw(closest, self._own_height, self._height, self._radius)
        enlarged = enlargement(guidance.separation)
        self._figures["pursuer"].show(paint.PURSUER, enlarged)
        self._figures["leader"].show(leader_colour(guidance, cast.link.min_separation), enlarged)
        self._figures["leader"].hide(guidance.leader_age > GONE)
        is_about_others = self._surroundings is not None and self._surroundings.are_all_alerts
        to_leader = replace(guidance, alert="none") if is_about_others else guidance
        self._minimum.draw(to_leader, cast.link.min_separation)
        self._length = LENGTH / KM * enlarged
        self._gate.draw(guidance, self._height, self._length)
        self._ahead = self._path_ahead(t, guidance)
        self._place(pair)
        self._frame(pair)

    def _path_ahead(self, t: Second, guidance: GuidanceSample) -> Array:
        """Places of the committed or proposed path until it joins, from the world's origin."""
        proposal, forecast = self._proposal, self._forecast
        if is_silent(guidance):
            return np.empty((0, 3))
        if proposal is not None and guidance.engagement in ("designated", "armed"):
            segments, since = proposal.plan.segments, t - proposal.t
            points = shapes.path_points(segments, self._wind, self._own_height, since=since)
            return points[:: max(1, len(points) // 40)]
        if forecast is None or guidance.time_to_go <= 0.0:
            return np.empty((0, 3))
        count = 2 + int(guidance.time_to_go / SEEN_EVERY)
        times = np.linspace(t, t + guidance.time_to_go, count)
        x, y = (
            np.interp(times, forecast.times, column) / KM for column in (forecast.x, forecast.y)
        )
        return np.column_stack((x, y, np.full(count, self._own_height)))

    def _place(self, pair: _Pair) -> None:
        """Put what moves where it is, and the middle of the two at the origin."""
        self._figures["pursuer"].move(pair.pursuer)
        self._figures["leader"].move(pair.leader)
        self._gate.move(pair.guidance, self._height)
        own, leader = place_of(pair.pursuer), place_of(pair.leader)
        self._world.position = (-(own[0] + leader[0]) / 2.0, -(own[1] + leader[1]) / 2.0, 0.0)

    def _frame(self, pair: _Pair) -> None:
        """Keep in the picture what matters: both, the minimum round the leader, the path ahead."""
        own, leader = place_of(pair.pursuer), place_of(pair.leader)
        middle = ((own[0] + leader[0]) / 2.0, (own[1] + leader[1]) / 2.0, 0.0)
        places = np.vstack((own, leader, self._ahead)) - middle
        radii = np.zeros(len(places))
        radii[:2] = self._length / 2.0, self._minimum.reach
        self._cameras.frame(Sights(places, radii))

    def _first(self, pair: _Pair) -> None:
        scene = self._scene
        self._figures = {
            "pursuer": AircraftFigure(scene, "pursuer", paint.PURSUER, pair.pursuer),
            "leader": AircraftFigure(scene, "leader", paint.LEADER, pair.leader),
        }


def _is_routed(guidance: GuidanceSample) -> bool:
    """Whether the leader's route is shown: it is designated, and heard of."""
    return guidance.engagement != "off" and not is_silent(guidance)


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

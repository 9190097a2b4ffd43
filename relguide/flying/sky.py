"""What each pursuer sees besides its leader: all other aircraft, and weather cells.

An aircraft that flies a declared intent is expected to fly the rest of it, one that was found not
to is not. A pursuer shares where its guidance takes it. All others are expected to fly straight on.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import hypot

import numpy as np

from relguide.flying.belief import Belief
from relguide.flying.fleet import Fleet
from relguide.flying.knowledge import as_declared, breaks_its_word, declared_by
from relguide.flying.leaders.declared import remaining
from relguide.flying.perception import Perceived, Perception
from relguide.flying.pursuit import Pursuit
from relguide.flying.seen_others import SeenOther, pieces_along
from relguide.flying.world import Declared, Guided, World, kept_from
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import Body
from relguide.kernels.flight.program import roll_lead
from relguide.planning.cells import Cell, Disc
from relguide.planning.heights import Heights, counted
from relguide.planning.intent import IntentPiece, LevelChange
from relguide.planning.limits import ALTITUDE, POSITION
from relguide.units import Metre, MetrePerSecond, Second

DOUBTED_FOR = 5
"""So many seconds off what it declared, an aircraft is no longer relied on."""
LEVEL: MetrePerSecond = 1.0
"""An aircraft that climbs or descends slower flies level [m/s]."""
OFF_FORECAST: Metre = 500.0
"""So far from its own forecast, an aircraft does not fly what it shared [m]."""


class Sky:
    """All that flies, and the weather: one of the few things here that change."""

    def __init__(self, world: World, fleet: Fleet, seed: int = 0) -> None:
        """Before the flight.

        Args:
            world: as it begins.
            fleet: its aircraft.
            seed: of what is not perceived exactly.
        """
        self._world, self._fleet, self._seed = world, fleet, seed
        self._perceptions: dict[tuple[int, int], Perception] = {}
        self._declared: dict[int, Fleet] = {}
        self._doubted: dict[int, int] = {}
        self._broken: set[int] = set()
        self._programs = tuple(fleet.declared)
        for j, aircraft in enumerate(world.aircraft):
            match aircraft.pilot:
                case Declared(declares=tuple(intent)):
                    self._declared[j] = as_declared(fleet, j, intent)
                case _:
                    pass

    def fly_second(self, t: Second) -> None:
        """Fly on what was declared and is not flown, and find out those that break their word."""
        for j, declared in list(self._declared.items()):
            if self._fleet.declared[j] is not self._programs[j]:
                del self._declared[j]  # what it was ordered to do is what it declares from now on
                continue
            off = breaks_its_word(self._fleet, j, declared)
            self._doubted[j] = self._doubted.get(j, 0) + 1 if off else 0
            if self._doubted[j] >= DOUBTED_FOR:
                self._broken.add(j)
                del self._declared[j]
            else:
                declared.fly_second(t)

    def seen_by(self, one: Pursuit, pursuits: Sequence[Pursuit], belief: Belief) -> Belief:
        """What a pursuer knows, with all that it keeps clear of besides its leader.

        Args:
            one: the pursuer.
            pursuits: all of them: they share where they go.
            belief: what it knows of itself, its leader and the wind.
        """
        aircraft, cells = self._world.aircraft, self._world.cells
        if len(aircraft) == 2 and not cells:
            return belief
        guided = {other.pursuer: other for other in pursuits}
        return replace(
            belief,
            others=tuple(
                self._seen(one, j, guided.get(j), belief)
                for j in range(len(aircraft))
                if j not in (one.pursuer, one.leader)
            ),
            cells=tuple(cell.after(belief.t) for cell in cells if _is_in_plane(cell, belief.t)),
        )

    def _seen(self, one: Pursuit, j: int, guided: Pursuit | None, belief: Belief) -> SeenOther:
        fleet, aircraft = self._fleet, self._world.aircraft[j]
        seen = self._perceive(one, j, belief.t)
        body = fleet.body(j) if seen is None else seen.leader
        can = fleet.believed_limits[j]
        shared = None if guided is None else _shared(guided, body, belief.t)
        declared = self._intent(j, body, belief.t)
        heading, intent = body.heading, declared or ()
        if shared is not None:
            intent = pieces_along(shared)
        elif declared is None and abs(body.bank) > 1e-3:
            heading += turn_rate(body.tas, body.bank) * roll_lead(can, body.bank, 0.0)
        heights = self._heights(j, belief.t, known=declared is not None)
        return SeenOther(
            ident=aircraft.ident,
            body=body,
            heading=heading,
            wind=belief.wind,
            min_separation=kept_from(aircraft, one.link),
            intent=intent,
            declared=declared is not None or shared is not None,
            broke_its_word=j in self._broken,
            shared=None if shared is None else shared[:, :2],
            margin=0.0 if seen is None else seen.spread.margin,
            counts=counted(belief.own_heights, heights),
        )

    def _intent(self, j: int, body: Body, t: Second) -> tuple[IntentPiece, ...] | None:
        """What an aircraft has declared and not flown yet; `None` if nothing can be relied on."""
        if j in self._broken and self._fleet.declared[j] is self._programs[j]:
            return None
        source = self._declared.get(j)
        flown = declared_by(self._fleet, j, source)
        if flown is None:
            return None
        return remaining(flown.program, flown.cursor, body, self._fleet.believed_limits[j], t)

    def _heights(self, j: int, t: Second, *, known: bool) -> Heights:
        """The altitude of an aircraft, and its changes: if it declared none, on as now."""
        fleet, climb = self._fleet, self._fleet.verticals[j].speed
        flown = declared_by(fleet, j, self._declared.get(j)) if known else None
        if flown is not None or isinstance(self._world.aircraft[j].pilot, Guided):
            return fleet.heights(j, t, None if flown is None else flown.program)
        here = Heights(altitude=fleet.verticals[j].altitude)
        if abs(climb) < LEVEL:
            return here
        to = ALTITUDE.high if climb > 0.0 else ALTITUDE.low
        return replace(here, changes=(LevelChange(at=0.0, to_altitude=to, rate=abs(climb)),))

    def _perceive(self, one: Pursuit, j: int, t: Second) -> Perceived | None:
        """An aircraft as a pursuer perceives it; `None` where it sees the truth."""
        if one.perception is None:
            return None
        fleet, pair = self._fleet, (one.pursuer, j)
        perception = self._perceptions.get(pair)
        if perception is None:
            rng = np.random.default_rng([self._seed, *pair])
            perception = one.perception.beside(rng)
            perception.listen(fleet.body(j), fleet.drift(j), None)
            self._perceptions[pair] = perception
        perception.share_wind(one.perception)
        return perception.see(t, fleet.body(j), fleet.drift(j), None)


def _shared(guided: Pursuit, body: Body, t: Second) -> FloatArray | None:
    """Where the guidance of an aircraft takes it from now on; `None` if it does not say so."""
    ahead = guided.memory.forecast
    k = -1 if ahead is None else ahead.row(t)
    if ahead is None or k < 0 or k + 1 >= len(ahead.own):
        return None
    rows = ahead.own[k:]
    if hypot(rows[0, 0] - body.x, rows[0, 1] - body.y) > OFF_FORECAST:
        return None
    return rows


def _is_in_plane(cell: Cell, t: Second) -> bool:
    shape = cell.shape
    corners = ((shape.x, shape.y),) if isinstance(shape, Disc) else shape.corners
    edge = POSITION.high
    return all(
        abs(x + cell.east * t) <= edge and abs(y + cell.north * t) <= edge for x, y in corners
    )

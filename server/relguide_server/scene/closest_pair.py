"""Where both aircraft of the 3D scene will be when they are closest."""

from typing import NamedTuple

import numpy as np
from viser import SceneApi

from relguide.flying.aircraft_documents import GuidanceSample
from relguide.flying.documents import ForecastChanged, PlanProposed
from relguide.flying.plan_documents import PathPoint
from relguide.units import Second
from relguide_server.scene import paint as paint
from relguide_server.scene import shapes as shapes
from relguide_server.scene.paint import lines
from relguide_server.scene.shapes import KM

HALO = 1.0
"""Radius of the rings that mark both aircraft when they are closest [scene units]."""
DOTTED = (0.4, 1.6)
"""Dots and gaps of the minimum round the leader then [scene units]."""


class Closest(NamedTuple):
    """When the two are closest, and where."""

    t: Second
    pursuer: PathPoint
    leader: PathPoint


class ClosestPair:
    """What is drawn of it."""

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._drawn: Closest | None = None

    def draw(self, found: Closest | None, own_height: float, height: float, radius: float) -> None:
        """Mark both places and the minimum round the leader there.

        Args:
            found: where they are closest; `None` once that is passed.
            own_height: of own ship [scene units].
            height: of the leader [scene units].
            radius: the minimum separation [scene units].
        """
        if found == self._drawn:
            return
        self._drawn = found
        if found is None:
            for name in ("/world/closest", "/world/closest_min"):
                self._scene.remove_by_name(name)
            return
        own = np.array((found.pursuer.x / KM, found.pursuer.y / KM, own_height))
        leader = np.array((found.leader.x / KM, found.leader.y / KM, height))
        marks = [shapes.ring(HALO) + own, shapes.ring(HALO) + leader, np.array([[own, leader]])]
        lines(self._scene, "/world/closest", np.concatenate(marks), paint.LEADER, 1.5)
        then = shapes.dashes(shapes.circle(radius) + leader, DOTTED)
        lines(self._scene, "/world/closest_min", then, paint.LEADER, 1.2)


def closest_ahead(
    t: Second,
    guidance: GuidanceSample,
    proposal: PlanProposed | None,
    forecast: ForecastChanged | None,
) -> Closest | None:
    """Where both are closest, while that is to come and is not the join."""
    if proposal is not None and guidance.engagement in ("designated", "armed"):
        closest = proposal.plan.separation.at
        at, join = proposal.t + closest, proposal.t + proposal.plan.time_to_converge
        own, leader = proposal.pursuer_at_closest, proposal.leader_at_closest
    elif forecast is not None and guidance.time_to_go > 0.0:
        own, leader = forecast.pursuer_at_closest, forecast.leader_at_closest
        at, join = own.t, t + guidance.time_to_go
    else:
        return None
    return Closest(at, own, leader) if t < at < join - 1.0 else None

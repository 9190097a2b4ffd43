"""The slot in the 3D scene: a gate of thin lines that own ship flies into, and then stays in."""

from viser import SceneApi

from relguide.flying.aircraft_documents import GuidanceSample
from relguide_server.scene import paint as paint
from relguide_server.scene import shapes as shapes
from relguide_server.scene.paint import lines
from relguide_server.scene.shapes import KM, GateLook

LONG, WIDE, HIGH = 1.5, 1.3, 0.5
"""The gate by the length of the aircraft as it is drawn: it holds it whole, whatever the view."""
FOOT = 0.5
"""Half the cross where the line meets the ground [scene units]."""


class SlotGate:
    """The gate under `/world/slot`, and the line from it down to the ground."""

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._place = scene.add_frame("/world/slot", show_axes=False)
        self._drawn: tuple[paint.Colour, GateLook, float, float] | None = None

    def draw(self, guidance: GuidanceSample, height: float, length: float) -> None:
        """Show what has become of the slot.

        Args:
            guidance: of own ship.
            height: of the leader [scene units].
            length: of an aircraft as it is drawn [scene units].
        """
        self._place.visible = guidance.engagement != "off" and not is_silent(guidance)
        drawn = (*look_of(guidance), height, length)
        if drawn == self._drawn:
            return
        self._drawn = colour, look, _, _ = drawn
        frame = shapes.gate(LONG * length, WIDE * length, HIGH * length, look)
        lines(self._scene, "/world/slot/gate", frame, colour, 1.6)
        lines(self._scene, "/world/slot/drop", shapes.drop(height, FOOT), colour, 0.8)

    def move(self, guidance: GuidanceSample, height: float) -> None:
        """Put it where the slot is."""
        slot = guidance.slot
        self._place.position = (slot.x / KM, slot.y / KM, height)
        self._place.wxyz = shapes.attitude(slot.heading, 0.0)


LOST = 10.0
"""Reports of the leader older than this are flown no more [s]."""


def is_silent(guidance: GuidanceSample) -> bool:
    """Whether guidance has lost its leader: then it says nothing of the slot or the route."""
    return guidance.leader_age > LOST


def look_of(guidance: GuidanceSample) -> tuple[paint.Colour, GateLook]:
    """The slot's colour and look, as on the navigation display."""
    unable = guidance.engagement == "engaged" and guidance.mode == "heading"
    if unable or guidance.mode == "escape":
        return paint.CAUTION, "crossed"
    colour = paint.PLAN if guidance.engagement == "engaged" else paint.SLOT
    return colour, "held" if guidance.joined else "open"

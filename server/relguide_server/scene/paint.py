"""The brushes of the 3D scene: colours by meaning, as on the navigation display, and lines.

Texts are written by the cockpit's page over the picture, where they keep apart.
"""

from viser import LineSegmentsHandle, SceneApi

from relguide_server.scene.shapes import Points

Colour = tuple[int, int, int]
"""Red, green, blue, 0–255."""

BACKGROUND: Colour = (4, 4, 5)
PLAN: Colour = (0, 255, 0)
PLAN_SHADOW: Colour = (0, 92, 24)
SLOT: Colour = (23, 233, 242)
PROPOSED: Colour = (255, 255, 0)
PURSUER: Colour = (255, 255, 0)
LEADER: Colour = (229, 223, 214)
CAUTION: Colour = (235, 136, 12)
ALERT: Colour = (255, 59, 48)
TRAFFIC: Colour = (229, 223, 214)
CELL: Colour = (141, 138, 133)
COAST: Colour = (92, 122, 150)
AIRPORT: Colour = (128, 138, 152)
GRID: Colour = (66, 82, 88)
GRID_SECTION: Colour = (92, 110, 118)
EARTH: Colour = (29, 40, 41)
HAZE: Colour = (66, 84, 104)
ZENITH: Colour = (7, 13, 27)
SKYLIGHT: Colour = (150, 175, 210)
SUNLIGHT: Colour = (255, 226, 180)


def dim(colour: Colour, share: float) -> Colour:
    """The same hue, darker."""
    red, green, blue = (int(share * part) for part in colour)
    return red, green, blue


def lines(
    scene: SceneApi, name: str, segments: Points, colour: Colour, pixels: float
) -> LineSegmentsHandle:
    """Line segments (n, 2, 3), as thick at any distance; the same name again replaces them."""
    return scene.add_line_segments(
        name, segments, colour, thickness=pixels, thickness_units="screen"
    )

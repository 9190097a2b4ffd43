"""The sky and the ground of the 3D scene: one mesh round everything, its colours at its corners.

It is a surface of revolution: from the ground under the middle of the picture out to the horizon,
and from there up to the zenith. Haze lies along the horizon, and it is lighter below the sun. It is
sent once and not lit, so that it costs a viewer one mesh. The format is glTF 2.0 in one binary.
"""

import json
import struct
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from relguide.units import DEG
from relguide_server.scene import paint as paint
from relguide_server.scene.shapes import Points

RADIUS = 6000.0
"""How far away the sky is [scene units]."""
BELOW = 0.2
"""How far the ground lies under its grid [scene units]: nearer, the two would flicker."""
SUN = 205.0 * DEG
"""Where the sun stands [rad clockwise from north] …"""
SUN_HEIGHT = 32.0 * DEG
"""… and how high [rad]."""
SECTORS = 48
GROUND = (  # distance from the middle [scene units], share of haze
    (0.0, 0.0),
    (60.0, 0.05),
    (120.0, 0.18),
    (240.0, 0.42),
    (480.0, 0.68),
    (1000.0, 0.86),
    (2400.0, 0.96),
    (RADIUS, 1.0),
)
SKY = ((1.2, 0.86), (3.5, 0.64), (8.0, 0.42), (16.0, 0.24), (32.0, 0.08), (60.0, 0.0), (89.9, 0.0))
"""Elevation [°], share of haze."""
GLOW = 0.55
"""How much of the light at the sun's foot is the sun's own."""


def draw_sky(scene: SceneApi) -> None:
    """Sky, horizon and ground, and the light that falls from there."""
    scene.add_glb("/sky", sky_glb(), cast_shadow=False, receive_shadow=False)
    scene.configure_default_lights(enabled=False)
    scene.add_light_hemisphere(
        "/light/sky", sky_color=paint.SKYLIGHT, ground_color=paint.EARTH, intensity=1.6
    )
    level = 100.0 * cos(SUN_HEIGHT)
    scene.add_light_directional(
        "/light/sun",
        color=paint.SUNLIGHT,
        intensity=2.4,
        position=(level * sin(SUN), level * cos(SUN), 100.0 * sin(SUN_HEIGHT)),
    )


def sky_glb() -> bytes:
    """The mesh, as a binary glTF with colours at its corners and a material without light."""
    places, colours = _rings()
    faces = _faces(len(places) // SECTORS)
    blocks = [
        places.astype("<f4").tobytes(),
        colours.astype("<f4").tobytes(),
        faces.astype("<u2").tobytes(),
    ]
    starts = np.cumsum([0] + [len(block) for block in blocks]).tolist()
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_unlit"],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "materials": [{"doubleSided": True, "extensions": {"KHR_materials_unlit": {}}}],
        "meshes": [
            {
                "primitives": [
                    {"attributes": {"POSITION": 0, "COLOR_0": 1}, "indices": 2, "material": 0}
                ]
            }
        ],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": len(places),
                "type": "VEC3",
                "min": places.min(axis=0).tolist(),
                "max": places.max(axis=0).tolist(),
            },
            {"bufferView": 1, "componentType": 5126, "count": len(colours), "type": "VEC3"},
            {"bufferView": 2, "componentType": 5123, "count": faces.size, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": len(block)}
            for start, block in zip(starts, blocks, strict=False)
        ],
        "buffers": [{"byteLength": starts[-1]}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    chunks = [(b"JSON", text.ljust(-(-len(text) // 4) * 4)), (b"BIN\0", b"".join(blocks))]
    body = b"".join(struct.pack("<I", len(data)) + kind + data for kind, data in chunks)
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


def _rings() -> tuple[Points, Points]:
    """Corners ring by ring, from the middle of the ground to the zenith, and their colours."""
    flat = [(distance, -BELOW, haze, paint.EARTH) for distance, haze in GROUND]
    dome = [
        (RADIUS * cos(up * DEG), RADIUS * sin(up * DEG), haze, paint.ZENITH) for up, haze in SKY
    ]
    angles = 2.0 * pi * np.arange(SECTORS) / SECTORS
    facing = np.clip(np.cos(angles - SUN), 0.0, 1.0) ** 3
    places, colours = [], []
    for distance, z, haze, clear in flat + dome:
        places.append(
            np.column_stack(
                (distance * np.sin(angles), distance * np.cos(angles), np.full(SECTORS, z))
            )
        )
        glow = (GLOW * haze**2 * facing)[:, None]
        hazy = (1.0 - glow) * _light(paint.HAZE) + glow * _light(paint.SUNLIGHT)
        colours.append((1.0 - haze) * _light(clear) + haze * hazy)
    return np.concatenate(places), np.concatenate(colours)


def _faces(rings: int) -> NDArray[np.int64]:
    """Two triangles for each piece between two rings, as numbers of corners."""
    at = np.arange(SECTORS)
    after = (at + 1) % SECTORS
    pieces = [
        np.column_stack((k + at, k + after, k + SECTORS + at, k + after, k + SECTORS + after,
                         k + SECTORS + at))
        for k in range(0, (rings - 1) * SECTORS, SECTORS)
    ]  # fmt: skip
    return np.concatenate(pieces).reshape(-1)


def _light(colour: paint.Colour) -> Points:
    """A colour of the screen as glTF has it: the share of light, not of the screen's steps."""
    share: Points = (np.array(colour) / 255.0) ** 2.2
    return share

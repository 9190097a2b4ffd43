"""The sky of the scene: closed from the ground to the zenith, lightest along the horizon."""

import io
import json
import struct

import numpy as np
import trimesh
from relguide_server.scene.sky import RADIUS, sky_glb


def corners_and_colours() -> tuple[np.ndarray, np.ndarray]:
    """As glTF says: both accessors of the only mesh."""
    glb = sky_glb()
    (length,) = struct.unpack_from("<I", glb, 12)
    document = json.loads(glb[20 : 20 + length])
    data = glb[28 + length :]
    places, colours = (
        np.frombuffer(data, "<f4", 3 * accessor["count"], view["byteOffset"]).reshape(-1, 3)
        for accessor, view in zip(document["accessors"][:2], document["bufferViews"], strict=False)
    )
    return places, colours


def test_it_reaches_all_round_from_the_ground_to_the_zenith() -> None:
    sky = trimesh.load(io.BytesIO(sky_glb()), file_type="glb", force="mesh")
    assert np.linalg.norm(sky.vertices, axis=1).max() < RADIUS * 1.001
    assert sky.vertices[:, 2].max() > 0.999 * RADIUS
    assert sky.vertices[:, 2].min() > -1.0  # flat ground
    assert len(sky.faces) < 2000  # cheap: software draws it


def test_the_horizon_is_lighter_than_the_ground_and_the_zenith() -> None:
    places, colours = corners_and_colours()
    light, away = colours.mean(axis=1), np.hypot(places[:, 0], places[:, 1])
    horizon = light[(np.abs(places[:, 2]) < 0.05 * RADIUS) & (away > 0.9 * RADIUS)]
    assert light[away < 100.0].max() < horizon.min()
    assert light[places[:, 2] > 0.9 * RADIUS].max() < horizon.min()
    assert horizon.max() > 1.1 * horizon.min()  # the sun is somewhere

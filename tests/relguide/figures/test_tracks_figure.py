"""The picture: well-formed, to scale, with what it has to show."""

from itertools import pairwise
from math import hypot
from xml.etree import ElementTree

import pytest

from relguide.figures.tracks_figure import draw
from relguide.flying.regular_card import regular_check
from relguide.planning.regular import regular_from_trajectory
from relguide.units import NM
from tests.plans import golden_plan

SVG = "{http://www.w3.org/2000/svg}"


@pytest.mark.parametrize("ident", ["R001", "R061"])
def test_tracks_are_drawn_to_scale(ident: str) -> None:
    answer = golden_plan(ident)
    situation, flown = answer.situation, answer.trajectory
    regular = regular_from_trajectory(flown, turn_radius=situation.pursuer.turn_radius)
    found = regular_check(regular, situation)
    picture = draw(
        flown, situation, nodes=found.nodes, closest_at=found.separation.at, title="a < b & c"
    )
    page = ElementTree.fromstring(picture)
    texts = [text.text for text in page.iter(f"{SVG}text")]
    assert texts[0] == "a < b & c"
    assert {"east [NM]", "north [NM]", "pursuer", "leader", "d_min"} <= set(texts)
    assert {str(i) for i in range(1, found.order + 1)} <= set(texts)
    limit, *_ = [c for c in page.iter(f"{SVG}circle") if c.get("fill") == "none"]
    scale = float(limit.attrib["r"]) / (situation.min_separation / NM)
    near, leader, pursuer = (
        [tuple(map(float, p.split(","))) for p in line.attrib["points"].split()]
        for line in page.iter(f"{SVG}polyline")
    )
    for track, length in (
        (pursuer, flown.length),
        (leader, situation.leader.tas * flown.duration),
        (near, found.separation.least),
    ):
        drawn = sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(track))
        assert drawn == pytest.approx(length / NM * scale, rel=5e-3)
    _, _, width, height = map(float, page.attrib["viewBox"].split())
    assert all(0.0 < x < width and 0.0 < y < height for x, y in (*pursuer, *leader))

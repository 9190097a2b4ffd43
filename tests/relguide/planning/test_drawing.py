"""The drawing of a plan: XML, all in sight, true to scale."""

import re
from math import hypot
from xml.etree import ElementTree

import pytest

from relguide import Plan, plan
from relguide.units import NM
from tests.flights import random_start

SVG = "{http://www.w3.org/2000/svg}"


def drawn(seed: int) -> tuple[Plan, ElementTree.Element]:
    """A plan in wind and its drawing."""
    found = plan(random_start(seed, wind=20.0))
    assert isinstance(found, Plan)
    return found, ElementTree.fromstring(found._repr_svg_())


def points(line: ElementTree.Element) -> list[tuple[float, float]]:
    pairs = (pair.split(",") for pair in line.get("points", "").split())
    return [(float(x), float(y)) for x, y in pairs]


def number(element: ElementTree.Element, name: str) -> float:
    return float(element.get(name, "nan"))


@pytest.mark.parametrize("seed", range(1, 7))
def test_all_is_in_sight(seed: int) -> None:
    _, root = drawn(seed)
    width, height = number(root, "width"), number(root, "height")
    assert width == 640.0
    assert 220.0 <= height <= 561.0
    for line in root.iter(f"{SVG}polyline"):
        for x, y in points(line):
            assert 30.0 <= x <= width - 30.0
            assert 58.0 <= y <= height - 40.0


@pytest.mark.parametrize("seed", range(1, 7))
def test_it_is_true_to_its_scale_bar(seed: int) -> None:
    found, root = drawn(seed)
    (bar,) = (d for path in root.iter(f"{SVG}path") if (d := path.get("d", "")).startswith("M16 "))
    begin, end = (float(n) for n in re.findall(r"^M(\S+) .*H([\d.]+)V", bar)[0])
    said = [text.text or "" for text in root.iter(f"{SVG}text")]
    (miles,) = (float(words[:-3]) for words in said if re.fullmatch(r"[\d.]+ NM", words))
    scale = (end - begin) / (miles * NM)
    *_, own = root.iter(f"{SVG}polyline")
    first, last = points(own)[0], points(own)[-1]
    flown = found.over_ground([0.0, found.time_to_converge])
    across, up = flown.x[1] - flown.x[0], flown.y[1] - flown.y[0]
    assert last[0] - first[0] == pytest.approx(across * scale, abs=1.0)
    assert first[1] - last[1] == pytest.approx(up * scale, abs=1.0)
    dashed = next(c for c in root.iter(f"{SVG}circle") if c.get("stroke-dasharray"))
    assert number(dashed, "r") == pytest.approx(found.situation.min_separation * scale, abs=0.3)
    tie = points(next(iter(root.iter(f"{SVG}polyline"))))
    apart = hypot(tie[1][0] - tie[0][0], tie[1][1] - tie[0][1])
    assert apart == pytest.approx(found.certificate.least_separation * scale, abs=0.5)


def test_it_says_word_time_and_what_is_proved() -> None:
    found, root = drawn(1)
    said = [text.text or "" for text in root.iter(f"{SVG}text")]
    assert said[0].startswith(f"{found.word} · joins in ")
    proved = float(said[1].rpartition("proved above ")[2].removesuffix(" NM"))
    assert found.certificate.lower_bound / NM - 0.01 < proved <= found.certificate.lower_bound / NM

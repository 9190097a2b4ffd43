"""Whoever's work is shipped is named in THIRD_PARTY_NOTICES.md, with its licence."""

import re

from tools.notices import (
    NOTICES,
    bundled_notices,
    guide_notices,
    imports_of_page,
    installed_notices,
)

SHOWN = NOTICES.read_text("utf-8")
RENEW = "python -m tools.notices writes the file anew"


def test_each_distribution_of_the_container_has_its_licence() -> None:
    named = set(re.findall(r"^\| (\S+) \| \S.* \| <https?://\S+> \|$", SHOWN, re.MULTILINE))
    found = {notice.name for notice in installed_notices()}
    assert {"numpy", "numba", "pydantic", "viser", "anyio"} <= found
    assert found <= named, RENEW


def test_each_package_in_the_page_has_the_text_of_its_licence() -> None:
    assert imports_of_page() >= {"preact", "@preact/signals", "@fontsource/b612"}
    for notice in bundled_notices():
        _, _, section = SHOWN.partition(f"\n### {notice.name}\n")
        text = section.partition("\n##")[0]
        assert text.startswith(f"\n{notice.licence}, <"), RENEW
        assert "Copyright" in text, RENEW
        assert "AS IS" in text, RENEW


def test_the_data_of_the_ground_have_theirs() -> None:
    _, _, section = SHOWN.partition("\n## On the ground of the 3D scene\n")
    text = section.partition("\n##")[0]
    for said in ("Natural Earth", "world-atlas 2.0.2", "airportsdata", "Copyright", "AS IS"):
        assert said in text, RENEW


def test_what_the_guide_holds_has_the_text_of_its_licence() -> None:
    _, _, section = SHOWN.partition("\n## In the guide\n")
    text = "".join(section.partition("\n## ")[0].split())
    for name, _, _, file in guide_notices():
        assert "".join(file.read_text("utf-8").split()) in text, f"{name}: {RENEW}"

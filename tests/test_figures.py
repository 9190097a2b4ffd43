"""Every figure under docs/figures is a picture that a browser shows."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

FOLDER = Path(__file__).parents[1] / "docs" / "figures"


@pytest.mark.parametrize("file", sorted(FOLDER.rglob("*.svg")), ids=lambda file: file.name)
def test_a_figure_is_xml(file: Path) -> None:
    root = ElementTree.parse(file).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"

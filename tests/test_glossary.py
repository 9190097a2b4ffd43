"""docs/glossary.md: its names are those of the code and of the wire, its drawings up to date."""

import re
from pathlib import Path

import pytest

from tools.glossary_drawings import FOLDER, drawings

ROOT = Path(__file__).parents[1]
GLOSSARY = (ROOT / "docs" / "glossary.md").read_text()
LIBRARY = "\n".join(file.read_text() for file in (ROOT / "relguide").rglob("*.py"))
WIRE = (ROOT / "web" / "src" / "wire.ts").read_text() + "\n".join(
    file.read_text() for file in (ROOT / "relguide" / "contract").glob("*.py")
)


def rows() -> list[list[str]]:
    """The cells of all tables, without their heads, by the names of their columns."""
    found = []
    head: list[str] = []
    for line in GLOSSARY.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("|"):
            head = []
        elif not head:
            head = cells
        elif not set(line) <= set("|-"):
            found.append([cells[head.index("in code")], cells[-1] if "wire" in head[-1] else ""])
    return found


def test_tables_are_read() -> None:
    assert len(rows()) > 40


@pytest.mark.parametrize("column", [0, 1], ids=["in code", "on the wire"])
def test_names_occur(column: int) -> None:
    text = (LIBRARY, WIRE)[column]
    missing = [
        name
        for row in rows()
        for name in re.findall(r"`([\w=\"]+)`", row[column])
        if not re.search(rf"\b{re.escape(name.partition('=')[0])}\b", text)
    ]
    assert not missing


def test_drawings_are_fresh() -> None:
    stale = [name for name, svg in drawings().items() if (FOLDER / name).read_text() != svg]
    assert not stale, "draw them anew: python -m tools.glossary_drawings"

"""The constants of guidance as a file to change: `python -m tools.campaign.constants`.

It writes examples/settings.toml: each key with its default, and its reason above it.
"""

import ast
import inspect
from dataclasses import fields
from pathlib import Path
from typing import get_args

from relguide.flying.guidance import settings
from relguide.flying.guidance.settings import DEFAULT, FLAGS, UNITS, Settings

FILE = Path(__file__).parents[2] / "examples" / "settings.toml"
HEAD = """\
# Every constant of guidance with its default. Change what you like, leave out the rest, and fly:
# relguide fly fig_6a --settings examples/settings.toml

[guidance]
"""


def constants_toml() -> str:
    """The file, in the order of the record."""
    reasons = _docstrings()
    lines = [f"# {reasons[field.name]}\n{_assignment(field.name)}\n" for field in fields(Settings)]
    return HEAD + "\n".join(lines)


def _assignment(name: str) -> str:
    value = getattr(DEFAULT, name)
    if name in FLAGS:
        return f"{name} = {str(value).lower()}"
    (field,) = (field for field in fields(Settings) if field.name == name)
    if field.type is float:
        return f"{name} = {value:.4g}"
    (unit,) = get_args(field.type)[1:]
    # angles in degrees; a bandwidth in rad/s, as docs/flight.md has it
    shown = unit if name.endswith("bandwidth") else {"rad": "deg", "radps": "degps"}.get(unit, unit)
    for ending in (shown, *UNITS[unit]):
        number = f"{value / UNITS[unit][ending]:.4g}"
        if abs(float(number) * UNITS[unit][ending] - value) <= 1e-9 * abs(value):
            return f"{name}_{ending} = {number}"
    raise ValueError(f"{name} has no short number in any of its units.")


def _docstrings() -> dict[str, str]:
    """What stands under each field, on one line."""
    (record,) = [
        node
        for node in ast.parse(inspect.getsource(settings)).body
        if isinstance(node, ast.ClassDef) and node.name == Settings.__name__
    ]
    found = dict[str, str]()
    for field, after in zip(record.body, record.body[1:], strict=False):
        if isinstance(field, ast.AnnAssign) and isinstance(after, ast.Expr):
            assert isinstance(field.target, ast.Name)
            assert isinstance(after.value, ast.Constant)
            found[field.target.id] = " ".join(str(after.value.value).split())
    return found


if __name__ == "__main__":
    FILE.write_text(constants_toml())

"""The constants of guidance as docs/flight.md shows them: key of a file, value, reason."""

import ast
import inspect
from dataclasses import fields
from typing import get_args

from relguide.flying.guidance import settings
from relguide.flying.guidance.settings import DEFAULT, FLAGS, UNITS, Settings
from tools.campaign.tables import Cells

CONSTANTS = "key", "value", "what it is for"


def constants_cells() -> Cells:
    """A row each, in the order of the record."""
    reasons = _docstrings()
    cells = []
    for field in fields(Settings):
        value, reason = getattr(DEFAULT, field.name), reasons[field.name]
        if field.name in FLAGS:
            cells.append([f"`{field.name}`", str(value).lower(), reason])
            continue
        key, factor = field.name, 1.0
        if field.type is not float:
            (unit,) = get_args(field.type)[1:]
            # angles in degrees; but a bandwidth in rad/s, as the page's formulas have it
            shown = {"rad": "deg", "radps": "degps"}.get(unit, unit)
            if field.name.endswith("bandwidth"):
                shown = unit
            key, factor = f"{field.name}_{shown}", UNITS[unit][shown]
        cells.append([f"`{key}`", f"{value / factor:.4g}", reason])
    return cells


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

"""How values show themselves: as code to paste, without what is as it is by default."""

from dataclasses import MISSING, fields
from typing import Any


def as_code(value: Any) -> str:
    """The call that makes a dataclass again, fields at their defaults left out."""
    shown = [
        f"{f.name}={getattr(value, f.name)!r}"
        for f in fields(value)
        if f.init and (f.default is MISSING or getattr(value, f.name) != f.default)
    ]
    return f"{type(value).__name__}({', '.join(shown)})"

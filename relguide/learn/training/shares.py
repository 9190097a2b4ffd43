"""Share: how often something holds, and what that says of how often it would in all situations."""

from dataclasses import dataclass
from math import sqrt
from typing import Any

Z = 1.959964
"""Of a 95 % interval."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Share:
    """How often something holds."""

    hits: int
    of: int

    @property
    def value(self) -> float:
        """The share itself; of nothing, 0."""
        return self.hits / self.of if self.of else 0.0

    @property
    def interval(self) -> tuple[float, float]:
        """Its 95 % interval (Wilson)."""
        if self.of == 0:
            return 0.0, 1.0
        p, n = self.hits / self.of, self.of
        middle = (p + Z * Z / (2.0 * n)) / (1.0 + Z * Z / n)
        half = Z / (1.0 + Z * Z / n) * sqrt(p * (1.0 - p) / n + Z * Z / (4.0 * n * n))
        return max(middle - half, 0.0), min(middle + half, 1.0)


def share_as_json(share: Share) -> dict[str, Any]:
    """A share as it is printed."""
    return {"hits": share.hits, "of": share.of, "interval_95": list(share.interval)}

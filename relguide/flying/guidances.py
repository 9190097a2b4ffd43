"""Ways to guide a pursuer, by name: relguide's, and baselines to hold it against."""

from collections.abc import Mapping
from typing import Literal, get_args

Guidance = Literal["relguide", "slot_pursuit", "pronav", "trail"]

GUIDANCES: Mapping[Guidance, str] = {
    "relguide": "by plans",
    "slot_pursuit": "towards the slot behind the leader's present place",
    "pronav": "the same by proportional navigation",
    "trail": "onto the leader's flown path and along it",
}
"""What each does. All but the first are baselines: they do not plan, and do not look at d_min."""


def expect_guidance(name: str) -> None:
    """Refuse a name that no guidance has."""
    if name not in GUIDANCES:
        names = ", ".join(get_args(Guidance))
        raise ValueError(f"guidance must be one of {names}, not {name!r}.")

"""The modes of guidance, and the one table that says which may follow which.

heading: no plan, a heading is held that keeps clear; converge: the committed path is tracked;
capture: onto the leader's flown path, the spacing being closed; follow: joined, along that path;
escape: away from the leader, as what was flown would lose d_min.
"""

from collections.abc import Mapping
from typing import Literal

from relguide.kernels.flight.guide import CAPTURE, CONVERGE, ESCAPE, FOLLOW, HOLD

Mode = Literal["heading", "converge", "capture", "follow", "escape"]

MAY_FOLLOW: Mapping[Mode, frozenset[Mode]] = {
    "heading": frozenset({"converge", "escape"}),
    "converge": frozenset({"capture", "follow", "heading", "escape"}),
    "capture": frozenset({"follow", "converge", "heading", "escape"}),
    "follow": frozenset({"capture", "converge", "heading", "escape"}),
    "escape": frozenset({"converge", "heading"}),
}
"""Where each mode may lead. The leader's gate is passed from converge where the path ends in it;
from follow the spacing is opened or closed anew where the crew asks for another D."""
NUMBERS: Mapping[Mode, int] = {
    "heading": HOLD,
    "converge": CONVERGE,
    "capture": CAPTURE,
    "follow": FOLLOW,
    "escape": ESCAPE,
}
"""Their numbers in kernels."""
NAMES: Mapping[int, Mode] = {number: mode for mode, number in NUMBERS.items()}
"""And back."""


def change(mode: Mode, to: Mode) -> Mode:
    """The mode entered.

    Raises:
        ValueError: if the table has no such transition.
    """
    if to != mode and to not in MAY_FOLLOW[mode]:
        raise ValueError(f"{to} may not follow {mode}.")
    return to

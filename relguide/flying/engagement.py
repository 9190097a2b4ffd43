"""How far a crew has engaged relative guidance, what flies the aircraft, and what may follow what.

off: nobody is to be joined; designated: the leader is chosen, and paths to its slot are proposed;
armed: the proposal is accepted, and waits for the order to be flown; engaged: guidance commands.
What guidance commands, the autopilot flies, or the crew by hand.
"""

from collections.abc import Mapping
from typing import Literal

from relguide.units import DEG, Radian

Engagement = Literal["off", "designated", "armed", "engaged"]

MAY_BECOME: Mapping[Engagement, frozenset[Engagement]] = {
    "off": frozenset({"designated"}),
    "designated": frozenset({"off", "armed"}),
    "armed": frozenset({"off", "designated", "engaged"}),
    "engaged": frozenset({"off"}),
}
"""What a crew may order after each. Nothing that was not accepted is ever flown."""


def refusal(now: Engagement, to: Engagement, *, proposed: bool) -> str:
    """Why an engagement may not follow the present one, in a sentence; empty if it may.

    Args:
        now: the present one.
        to: what is asked for.
        proposed: whether there is a path to accept.
    """
    if to == now:
        return f"Relative guidance is {_WORDS[now]} already."
    if to == "armed" and now == "designated" and not proposed:
        return "There is no proposal to accept."
    if to in MAY_BECOME[now]:
        return ""
    return f"Relative guidance is {_WORDS[now]}: {_NEXT[now]}"


AUTOPILOT_BANK: Radian = 40.0 * DEG
"""The autopilot takes an aircraft that banks no more than this [rad]."""


def autopilot_refusal(*, on: bool, to: bool, bank: Radian) -> str:
    """Why the crew may not take control, or give it back, in a sentence; empty if it may.

    Args:
        on: whether the autopilot flies.
        to: whether it is to.
        bank: of the aircraft now [rad].
    """
    if on == to:
        return "The autopilot flies already." if on else "The crew has control already."
    if to and abs(bank) > AUTOPILOT_BANK:
        most = AUTOPILOT_BANK / DEG
        return f"The bank is {abs(bank) / DEG:.0f}°: bring it below {most:.0f}° for the autopilot."
    return ""


_WORDS: Mapping[Engagement, str] = {
    "off": "off",
    "designated": "waiting for a proposal to be accepted",
    "armed": "armed",
    "engaged": "engaged",
}
_NEXT: Mapping[Engagement, str] = {
    "off": "designate the leader first.",
    "designated": "accept the proposal first.",
    "armed": "engage it, or cancel.",
    "engaged": "disconnect it first.",
}

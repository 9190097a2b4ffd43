"""The life of a clearance: its states, who may bring it from one to another, and what it is told.

    validating → accepted | unable | standby;  accepted → wilco → flying → flown

It may end as cancelled, expired, superseded or terminated. Automation advises by a validation; the
controller answers. The crew replies. The service counts time and watches what is flown.
"""

from collections.abc import Iterable, Mapping
from typing import Literal

State = Literal[
    "requested", "validating", "accepted", "unable", "standby", "wilco", "flying", "flown",
    "cancelled", "expired", "superseded", "deviated", "terminated",
]  # fmt: skip
Actor = Literal["crew", "controller", "service"]
OVER: frozenset[State] = frozenset(
    {"unable", "flown", "cancelled", "expired", "superseded", "terminated"}
)
"""Nothing follows these."""

_CREW: frozenset[Actor] = frozenset({"crew"})
_SERVICE: frozenset[Actor] = frozenset({"service"})
_ANSWER: frozenset[Actor] = frozenset({"controller", "service"})
_EITHER: frozenset[Actor] = frozenset({"crew", "controller"})
_WAITING: Mapping[State, frozenset[Actor]] = {
    "accepted": _ANSWER,
    "unable": _ANSWER,
    "cancelled": _EITHER,
    "expired": _SERVICE,
    "superseded": _SERVICE,
}

WHO_MAY: Mapping[State, Mapping[State, frozenset[Actor]]] = {
    "requested": {"validating": _SERVICE, "cancelled": _EITHER},
    "validating": {**_WAITING, "standby": _ANSWER},
    "standby": _WAITING,
    "accepted": {
        "wilco": _CREW,
        "unable": _ANSWER,
        "cancelled": _EITHER,
        "expired": _SERVICE,
        "superseded": _SERVICE,
    },
    "wilco": {
        "flying": _SERVICE,
        "cancelled": _EITHER,
        "expired": _SERVICE,
        "superseded": _SERVICE,
    },
    "flying": {
        "flown": _SERVICE,
        "deviated": _SERVICE,
        "cancelled": _EITHER,
        "superseded": _SERVICE,
    },
    "deviated": {
        "flying": _SERVICE,
        "terminated": _ANSWER,
        "cancelled": _EITHER,
        "superseded": _SERVICE,
    },
}
"""By the present state and the next one: who may bring it there. The service answers in the
controller's place only where it is told to, or where a second validation fails."""


def refusal(now: State, to: State, by: Actor) -> str:
    """Why a clearance may not be brought from one state to another, in a sentence; empty if it may.

    Args:
        now: the present state.
        to: the next one.
        by: who asks for it.
    """
    following = WHO_MAY.get(now, {})
    if to not in following:
        if now in OVER:
            return f"This clearance is over: it is {now}. Ask for another one."
        return f"A clearance that is {now} becomes {_listed(following)}, not {to}."
    if by not in following[to]:
        allowed = _listed(sorted(following[to]))
        return f"Only {allowed} may bring a clearance that is {now} to {to}, not {by}."
    return ""


def _listed(names: Iterable[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} or {last}" if first else last

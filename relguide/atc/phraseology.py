"""Requests and answers in the manner of controller-pilot data link. They claim no conformance."""

from collections.abc import Mapping, Sequence

from relguide.atc.documents import ReasonCode
from relguide.atc.request import Manoeuvre, SpacingType
from relguide.units import NM

WILCO = "WILCO"
STANDBY = "STANDBY"
UNABLE = "UNABLE"
_CAUSE: Mapping[ReasonCode, str] = {
    "separation": "DUE TO TRAFFIC",
    "traffic_without_intent": "DUE TO TRAFFIC",
    "slot_taken": "DUE TO TRAFFIC",
    "airspace": "DUE TO AIRSPACE RESTRICTION",
    "bank": "DUE TO AIRCRAFT PERFORMANCE",
    "speed": "DUE TO AIRCRAFT PERFORMANCE",
    "leader_disagrees": "DUE TO INTENT OF",
    "expired": "REQUEST EXPIRED",
    "horizon": "DUE TO PREDICTION TIME",
    "conformance": "DUE TO DEVIATION",
}


def spacing_text(spacing_type: SpacingType, spacing: float) -> str:
    """D or the time behind the leader: `5.0 NM`, `90 SEC`.

    Args:
        spacing_type: which of the two.
        spacing: [m], or [s].
    """
    return f"{spacing / NM:.1f} NM" if spacing_type == "distance" else f"{spacing:.0f} SEC"


def request_text(manoeuvre: Manoeuvre) -> str:
    """What a crew asks: `REQUEST CAPTURE AND MAINTAIN 5.0 NM BEHIND BAW12`."""
    return f"REQUEST {_words(manoeuvre)}"


def clearance_text(manoeuvre: Manoeuvre) -> str:
    """What a controller clears: `CLEARED CAPTURE AND MAINTAIN 5.0 NM BEHIND BAW12`."""
    return f"CLEARED {_words(manoeuvre)}"


def unable_text(reason: ReasonCode, idents: Sequence[str] = ()) -> str:
    """Why not: `UNABLE DUE TO TRAFFIC BAW12`.

    Args:
        reason: the reason; one that has no words of its own is left out.
        idents: of the aircraft or airspaces that it is about.
    """
    return " ".join([UNABLE, *filter(None, [_CAUSE.get(reason, "")]), *idents])


def _words(manoeuvre: Manoeuvre) -> str:
    spacing = spacing_text(manoeuvre.spacing_type, manoeuvre.spacing)
    return f"CAPTURE AND MAINTAIN {spacing} BEHIND {manoeuvre.leader}"

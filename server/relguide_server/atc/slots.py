"""Places behind one leader: who asks for one that another has, or asked for before, is queued."""

from dataclasses import replace
from math import hypot

from relguide.atc.documents import Finding, ValidationCard, Verdict
from relguide.atc.phraseology import STANDBY, spacing_text
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.units import Metre
from relguide_server.atc.cases import CLEARED, Case, Cases


def with_its_place(
    case: Case, found: ValidationCard, cases: Cases, settings: AtcSettings
) -> ValidationCard:
    """What automation finds of a request, its place behind the leader considered.

    A place that is taken makes it stand by until whoever has it is over, and says which one is
    free; that both would come too close there goes without saying. Places nearer than the minimum
    between aircraft are one place.

    Args:
        case: what was validated.
        found: what validation finds of it alone.
        cases: all.
        settings: the minimum.
    """
    taken = _holders(case, cases, settings)
    if not taken:
        return found
    request, first = case.clearance.request, taken[0].clearance.request
    free = _first_free(case, cases, settings)
    if request.spacing_type == "time":
        free = free / max(_leader_speed(request), 1.0)
    message = (
        f"{first.ident} has the place {spacing_text(first.spacing_type, first.spacing)} behind "
        f"{first.leader}, or asked for it before. It would help to wait until that is over, or to "
        f"ask for {spacing_text(request.spacing_type, free)}."
    )
    finding = Finding(
        reason="slot_taken",
        text=f"{STANDBY} DUE TO TRAFFIC {first.ident}",
        message=message,
        idents=(first.ident,),
    )
    holders = {one.clearance.request.ident for one in taken}
    others = tuple(one for one in found.findings if not one.idents or not holders >= {*one.idents})
    unable = found.verdict == "unable" and any(one.reason != "stale_picture" for one in others)
    verdict: Verdict = "unable" if unable else "standby"
    return replace(found, verdict=verdict, findings=(finding, *others))


def distance_behind(request: Manoeuvre) -> Metre:
    """How far behind its leader a request's place is [m]."""
    if request.spacing_type == "distance":
        return request.spacing
    return request.spacing * _leader_speed(request)


def _leader_speed(request: Manoeuvre) -> float:
    return hypot(*request.leader_path.velocity(request.joins))


def _holders(case: Case, cases: Cases, settings: AtcSettings) -> list[Case]:
    """Who has the place that is asked for, or asked for it before."""
    wanted = distance_behind(case.clearance.request)
    return [
        other
        for other in _beside(case, cases)
        if abs(distance_behind(other.clearance.request) - wanted) < settings.minimum
    ]


def _first_free(case: Case, cases: Cases, settings: AtcSettings) -> Metre:
    """The first place behind the one that is asked for that nobody has [m]."""
    free = distance_behind(case.clearance.request)
    for taken in sorted(distance_behind(one.clearance.request) for one in _beside(case, cases)):
        if abs(taken - free) < settings.minimum:
            free = taken + settings.minimum
    return free


def _beside(case: Case, cases: Cases) -> list[Case]:
    """All that are before a request in the queue behind its leader."""
    request = case.clearance.request
    return [
        other
        for other in cases.living(case.clearance.sky)
        if other is not case
        and other.clearance.request.leader == request.leader
        and other.clearance.request.ident != request.ident
        and (other.state in (*CLEARED, "deviated") or other.number < case.number)
    ]

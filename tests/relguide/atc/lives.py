"""Clearances in any state, for tests."""

import numpy as np

from relguide.atc.clearances import State
from relguide.atc.documents import Deviation, Finding, ValidationCard, Verdict
from relguide.atc.life import (
    Clearance,
    answer,
    ask,
    begin,
    cancel,
    deviate,
    finish,
    note_validation,
    reply,
    supersede,
    terminate,
    tick,
)
from relguide.atc.request import Manoeuvre
from relguide.atc.track import Track

AT = "2026-11-28T12:00:00Z"
STATES: tuple[State, ...] = (
    "requested", "validating", "accepted", "unable", "standby", "wilco", "flying", "flown",
    "cancelled", "expired", "superseded", "deviated", "terminated",
)  # fmt: skip


def straight_track(x: float = 0.0, y: float = 0.0, *, speed: float = 200.0) -> Track:
    """Eastward for 600 s, between FL300 and FL310."""
    t = np.array([0.0, 300.0, 600.0])
    return Track(
        t=t,
        x=x + speed * t,
        y=np.full(3, y),
        low=np.full(3, 9144.0),
        high=np.full(3, 9448.8),
        error=50.0,
    )


def manoeuvre() -> Manoeuvre:
    return Manoeuvre(
        ident="RG 06",
        leader="LDR 01",
        spacing_type="distance",
        spacing=10_000.0,
        min_separation=9_260.0,
        path=straight_track(),
        joins=400.0,
        leader_path=straight_track(10_000.0),
        word="LSR",
        bank=0.4,
        max_bank=0.45,
    )


def validation(verdict: Verdict = "acceptable", *, computed: float = 0.0) -> ValidationCard:
    found = Finding(
        reason="stale_picture" if verdict == "standby" else "separation",
        text="UNABLE DUE TO TRAFFIC BAW12",
        message="BAW12 comes within 4 NM.",
        idents=("BAW12",),
    )
    return ValidationCard(
        verdict=verdict,
        findings=() if verdict == "acceptable" else (found,),
        pairs=(),
        alternatives=(),
        valid_until=computed + 30.0,
        computed=computed,
        picture_as_of=computed,
        aircraft=1,
    )


def deviation(now: float = 10.0) -> Deviation:
    return Deviation(
        subject="across",
        level="alert",
        amount=2_000.0,
        unit="m",
        since=now,
        message="1.08 NM to the left of its path.",
    )


def asked(*, auto_answer: bool = False, now: float = 0.0) -> Clearance:
    return ask(
        manoeuvre(),
        id="C1",
        sky="",
        flight_id="f1",
        text="REQUEST IM BEHIND LDR 01",
        auto_answer=auto_answer,
        now=now,
        at=AT,
    )


def in_state(state: State, *, auto_answer: bool = False, now: float = 0.0) -> Clearance:
    """A clearance that came to a state by its shortest way, all at one time."""
    new = asked(auto_answer=auto_answer, now=now)
    accepted = answer(new, "accepted", "controller", now=now, at=AT)
    wilco = reply(accepted, "WILCO", validation(computed=now), now=now, at=AT)
    flying = begin(wilco, now=now, at=AT)
    deviated = deviate(flying, (deviation(now),), now=now, at=AT)
    match state:
        case "requested":
            return Clearance(
                id="C1",
                sky="",
                flight_id="f1",
                request=new.request,
                text=new.text,
                auto_answer=auto_answer,
                state="requested",
                history=new.history[:1],
            )
        case "validating":
            return new
        case "accepted":
            return accepted
        case "unable" | "standby":
            return answer(new, state, "controller", now=now, at=AT)
        case "wilco":
            return wilco
        case "flying":
            return flying
        case "flown":
            return finish(flying, now=now, at=AT)
        case "cancelled":
            return cancel(new, "crew", now=now, at=AT)
        case "expired":
            return tick(new, now + 60.0, AT)
        case "superseded":
            return supersede(new, "C2", now=now, at=AT)
        case "deviated":
            return deviated
        case "terminated":
            return terminate(deviated, "controller", now=now, at=AT)


def validated(state: State, verdict: Verdict, *, auto_answer: bool = False) -> Clearance:
    return note_validation(in_state(state, auto_answer=auto_answer), validation(verdict))

"""A clearance from the request to its end: each step gives a new record, or says why it may not be.

Nothing here reads a clock: `now` is the time of the clearance's sky [s], `at` the wall clock, UTC,
ISO 8601. A step that its actor may not take raises `ValueError`, with a sentence.
"""

from dataclasses import dataclass, replace
from typing import Literal

from relguide.atc.clearances import OVER, Actor, State, refusal
from relguide.atc.documents import Deviation, ReasonCode, StateChange, ValidationCard
from relguide.atc.phraseology import clearance_text
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.units import Second

Answer = Literal["accepted", "unable", "standby"]
Reply = Literal["WILCO", "UNABLE", "CANCEL"]
DEFAULTS = AtcSettings()


@dataclass(frozen=True, slots=True, kw_only=True)
class Clearance:
    """All that is known of a clearance."""

    id: str
    sky: str
    """Empty: the one on the earth; else the flight whose sky it is."""
    flight_id: str
    """The flight that flies it; empty if it is none of this service."""
    request: Manoeuvre
    text: str
    """The request in the words of data link."""
    auto_answer: bool
    """Whether the automation answers in the controller's place."""
    state: State
    history: tuple[StateChange, ...]
    """Oldest first."""
    due: Second = 0.0
    """When `tick` ends it if nothing happens [s]; 0 where nothing does."""
    validation: ValidationCard | None = None
    """The last one."""
    deviations: tuple[Deviation, ...] = ()
    """Those that stand now."""

    @property
    def over(self) -> bool:
        """Whether nothing follows its state."""
        return self.state in OVER


def ask(
    request: Manoeuvre,
    *,
    id: str,
    sky: str,
    flight_id: str,
    text: str,
    auto_answer: bool,
    now: Second,
    at: str,
    settings: AtcSettings = DEFAULTS,
) -> Clearance:
    """A crew asks for a manoeuvre: it is validating from then on.

    Args:
        request: what it wants to fly.
        id: the clearance's.
        sky: empty for the one on the earth, else the flight whose sky it is.
        flight_id: the flight that asks; empty if it is none of this service.
        text: the request in the words of data link.
        auto_answer: whether the automation answers in the controller's place.
        now: time of the sky [s].
        at: wall clock, UTC, ISO 8601.
        settings: how long a request waits for its answer.
    """
    asked = Clearance(
        id=id,
        sky=sky,
        flight_id=flight_id,
        request=request,
        text=text,
        auto_answer=auto_answer,
        state="requested",
        history=(StateChange(state="requested", t=now, at=at, by="crew", message=text),),
    )
    due = now + settings.answer_within
    return _step(asked, "validating", "service", "", "It is validated.", now, at, due=due)


def note_validation(clearance: Clearance, validation: ValidationCard) -> Clearance:
    """What automation finds of it now. It changes no state.

    Raises:
        ValueError: if the clearance is over.
    """
    _expect_alive(clearance)
    return replace(clearance, validation=validation)


def note_deviations(clearance: Clearance, deviations: tuple[Deviation, ...]) -> Clearance:
    """The deviations that stand now. They change no state: `deviate` and `back` do.

    Raises:
        ValueError: if the clearance is over.
    """
    _expect_alive(clearance)
    return replace(clearance, deviations=deviations)


def answer(
    clearance: Clearance,
    to: Answer,
    by: Actor,
    reason: ReasonCode | Literal[""] = "",
    message: str = "",
    *,
    now: Second,
    at: str,
    settings: AtcSettings = DEFAULTS,
) -> Clearance:
    """The controller answers a request, whatever automation found of it.

    Args:
        clearance: which.
        to: the answer.
        by: the controller, or the service in its place.
        reason: of an `unable`; empty: the controller's own.
        message: in words; empty: a sentence of ours.
        now: time of the sky [s].
        at: wall clock, UTC, ISO 8601.
        settings: how long an acceptance and a standby hold.

    Raises:
        ValueError: if it may not be answered so, or the service was not told to answer.
    """
    if by == "service" and not clearance.auto_answer:
        raise ValueError("The controller answers this clearance, not the service.")
    _expect_in_time(clearance, now)
    why: str = reason
    if to == "unable" and not why:
        why = "controller"
    due = {"accepted": now + settings.valid_for, "standby": now + settings.standby_within}
    words = clearance_text(clearance.request) if to == "accepted" else to.upper()
    return _step(clearance, to, by, why, message or words, now, at, due=due.get(to, 0.0))


def answer_as_advised(
    clearance: Clearance, *, now: Second, at: str, settings: AtcSettings = DEFAULTS
) -> Clearance:
    """The service answers in the controller's place by the last validation, as in a demonstration.

    A request that stands by goes on doing so while the verdict is `standby`.

    Raises:
        ValueError: as `answer`, or if it was not validated.
    """
    validation = clearance.validation
    if validation is None:
        raise ValueError("This clearance was not validated: there is nothing to answer it by.")
    if validation.verdict == "acceptable":
        return answer(clearance, "accepted", "service", now=now, at=at, settings=settings)
    if validation.verdict == clearance.state:
        return clearance
    reason, message = _findings(validation)
    return answer(
        clearance,
        validation.verdict,
        "service",
        reason,
        message,
        now=now,
        at=at,
        settings=settings,
    )


def reply(
    clearance: Clearance,
    word: Reply,
    validation: ValidationCard | None = None,
    *,
    message: str = "",
    now: Second,
    at: str,
) -> Clearance:
    """The crew replies.

    WILCO needs a validation on the present picture: what is acceptable no more is answered
    `unable`, by the service. UNABLE and CANCEL withdraw the request; UNABLE replies to an accepted
    one only.

    Args:
        clearance: which.
        word: the reply.
        validation: the second one, made for WILCO.
        message: in words; empty: a sentence of ours.
        now: time of the sky [s].
        at: wall clock, UTC, ISO 8601.

    Raises:
        ValueError: if it may not be replied so, or WILCO comes without a validation.
    """
    _expect_in_time(clearance, now)
    if word == "WILCO":
        _expect_may(clearance, "wilco", "crew")
        if validation is None:
            raise ValueError("WILCO needs a validation on the present picture.")
        return _comply(clearance, validation, message, now, at)
    if word == "UNABLE" and clearance.state != "accepted":
        _expect_alive(clearance)
        raise ValueError(
            f"UNABLE replies to a clearance that is accepted; this one is {clearance.state}. "
            "CANCEL withdraws it."
        )
    said = message or _WITHDRAWN[word]
    return cancel(clearance, "crew", said, now=now, at=at)


def _comply(
    clearance: Clearance, validation: ValidationCard, message: str, now: Second, at: str
) -> Clearance:
    clearance = replace(clearance, validation=validation)
    if validation.verdict != "acceptable":
        reason, found = _findings(validation)
        return _step(clearance, "unable", "service", reason, found, now, at)
    said = message or "The crew will comply."
    return _step(clearance, "wilco", "crew", "", said, now, at, due=clearance.due)


def cancel(
    clearance: Clearance, by: Actor, message: str = "", *, now: Second, at: str
) -> Clearance:
    """The crew withdraws its request, or the controller takes its clearance back.

    Raises:
        ValueError: if it is over, or another asks for it.
    """
    said = message or f"Cancelled by the {by}."
    return _step(clearance, "cancelled", by, by, said, now, at)


def tick(clearance: Clearance, now: Second, at: str) -> Clearance:
    """What time does to a clearance: the same record, or one that has ended.

    A request that is not answered, and a clearance that is not begun, expire when they are due. One
    whose aircraft does not come back is terminated.
    """
    if not 0.0 < clearance.due <= now:
        return clearance
    if clearance.state == "deviated":
        said = "The aircraft did not come back to its cleared path in time."
        return terminate(clearance, "service", said, now=now, at=at)
    return _step(clearance, "expired", "service", "expired", _EXPIRED[clearance.state], now, at)


def begin(clearance: Clearance, *, now: Second, at: str) -> Clearance:
    """The aircraft begins what it is cleared to fly.

    Raises:
        ValueError: if the crew has not said WILCO, or too late.
    """
    _expect_in_time(clearance, now)
    return _step(clearance, "flying", "service", "", "The manoeuvre has begun.", now, at)


def finish(clearance: Clearance, message: str = "", *, now: Second, at: str) -> Clearance:
    """It is flown to its end.

    Raises:
        ValueError: if it is not flying: who deviates has flown nothing to its end.
    """
    said = message or "The manoeuvre is flown."
    return _step(clearance, "flown", "service", "", said, now, at)


def deviate(
    clearance: Clearance,
    deviations: tuple[Deviation, ...],
    *,
    now: Second,
    at: str,
    settings: AtcSettings = DEFAULTS,
) -> Clearance:
    """The aircraft has left what conformance allows: it has `back_within` to come back.

    Args:
        clearance: which.
        deviations: those that stand now.
        now: time of the sky [s].
        at: wall clock, UTC, ISO 8601.
        settings: how long it has.

    Raises:
        ValueError: if it is not flying.
    """
    said = " ".join(one.message for one in deviations if one.level == "alert")
    said = said or "The aircraft deviates from its cleared path."
    due = now + settings.back_within
    deviated = _step(clearance, "deviated", "service", "conformance", said, now, at, due=due)
    return replace(deviated, deviations=deviations)


def back(
    clearance: Clearance, deviations: tuple[Deviation, ...] = (), *, now: Second, at: str
) -> Clearance:
    """The aircraft is back within what conformance allows.

    Args:
        clearance: which.
        deviations: those that still stand, none of them an alert.
        now: time of the sky [s].
        at: wall clock, UTC, ISO 8601.

    Raises:
        ValueError: if it has not deviated, or not come back in time.
    """
    _expect_in_time(clearance, now)
    said = "The aircraft is back on its cleared path."
    flying = _step(clearance, "flying", "service", "", said, now, at)
    return replace(flying, deviations=deviations)


def terminate(
    clearance: Clearance, by: Actor, message: str = "", *, now: Second, at: str
) -> Clearance:
    """An aircraft that deviates is cleared no more.

    Raises:
        ValueError: if it does not deviate, or another than the controller or the service asks.
    """
    said = message or f"Terminated by the {by}."
    return _step(clearance, "terminated", by, "conformance", said, now, at)


def supersede(clearance: Clearance, by_id: str, *, now: Second, at: str) -> Clearance:
    """Another clearance takes its place.

    Args:
        clearance: which.
        by_id: the other's id.
        now: time of the sky [s].
        at: wall clock, UTC, ISO 8601.

    Raises:
        ValueError: if it is over.
    """
    said = f"The request {by_id} takes its place."
    return _step(clearance, "superseded", "service", "", said, now, at)


def _step(
    clearance: Clearance,
    to: State,
    by: Actor,
    reason: str,
    message: str,
    now: Second,
    at: str,
    due: Second = 0.0,
) -> Clearance:
    _expect_may(clearance, to, by)
    step = StateChange(state=to, t=now, at=at, by=by, reason=reason, message=message)
    return replace(clearance, state=to, due=due, history=(*clearance.history, step))


def _expect_may(clearance: Clearance, to: State, by: Actor) -> None:
    fault = refusal(clearance.state, to, by)
    if fault:
        raise ValueError(fault)


def _expect_alive(clearance: Clearance) -> None:
    if clearance.over:
        raise ValueError(refusal(clearance.state, "validating", "service"))


def _expect_in_time(clearance: Clearance, now: Second) -> None:
    """What is due is over, whether or not `tick` has said so."""
    if 0.0 < clearance.due <= now:
        ended: State = "terminated" if clearance.state == "deviated" else "expired"
        raise ValueError(refusal(ended, "validating", "service"))


def _findings(validation: ValidationCard) -> tuple[ReasonCode, str]:
    """The first reason, and all of them in sentences."""
    first = validation.findings[0]
    return first.reason, " ".join(found.message for found in validation.findings)


_WITHDRAWN: dict[Reply, str] = {
    "UNABLE": "The crew is unable to comply.",
    "CANCEL": "The crew has withdrawn its request.",
}
_EXPIRED: dict[State, str] = {
    "validating": "The request was not answered in time.",
    "standby": "The request was told to stand by, and not answered in time.",
    "accepted": "The crew did not reply to the clearance in time.",
    "wilco": "The manoeuvre was not begun in time.",
}

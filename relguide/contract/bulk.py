"""answer_all(records): answers to many situations, each by itself: a bad one spoils no other."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import orjson

from relguide.contract.answers import Include, answer
from relguide.contract.bodies import MAX_ID, MAX_INTEGER, NamedSituationBody, situation_from_body
from relguide.contract.columns import Row, columns_of, row_of, take
from relguide.contract.refusal import ContractError, loads, make_printable, parse
from relguide.planning.acceptance import ask
from relguide.planning.batch import VERDICTS, Times, plan_arrays
from relguide.planning.outcome import AS_FAST, NoPlan, Plan, Planner, Proof, Reason
from relguide.planning.plan import plan as exact_plan
from relguide.planning.turning_batch import TurningTimes, turning_times
from relguide.units import Second

Fields = Literal["times", "plan", "full"]
"""How much of each plan is wanted: its time alone, the plan, or that with all that may be included.
"""
Record = tuple[int, object]
"""The number of a line, and its JSON text, or what that holds, or the `ContractError` that says why
it holds nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wanted:
    """What is wanted of each situation."""

    planner: Planner
    fields: Fields = "plan"
    include: Collection[Include] = ()
    """What is added to plans."""
    deadline: Second | None = None
    """How long each may take [s]."""

    @property
    def in_columns(self) -> bool:
        """Whether times are wanted that many situations can be given at once."""
        return self.fields == "times" and self.planner is exact_plan and self.deadline is None


class _Read(NamedTuple):
    """A record that holds a situation."""

    at: int
    """Which of the answers is its."""
    line: int
    named: dict[str, Any]
    """Its `id` alone, if it has one."""
    body: NamedSituationBody


def answer_all(records: Iterable[Record], wanted: Wanted) -> list[dict[str, Any]]:
    """An answer for each record, in order, with the situation's `id` if it has one.

    What is no situation is answered by `{"status": "invalid", "line": …, "message": …}`.
    """
    answers: list[dict[str, Any]] = []
    together: list[tuple[_Read, Row]] = []
    for line, content in records:
        named: dict[str, Any] = {}
        try:
            if isinstance(content, bytes):
                content = loads(content)
            named = _name(content)
            read = _Read(len(answers), line, named, _read(content))
        except ContractError as error:
            answers.append(_invalid(line, named, error))
            continue
        row = row_of(read.body) if wanted.in_columns else None
        if row is None:
            answers.append(_answer_one(read, wanted))
        else:
            together.append((read, row))
            answers.append({})
    for at, reply in _answer_together(together, wanted):
        answers[at] = reply
    return answers


def answer_line(
    line: bytes,
    planner: Planner,
    *,
    include: Collection[Include] = (),
    deadline: Second | None = None,
) -> dict[str, Any]:
    """The answer to a situation in JSON text, as to one of many.

    Args:
        line: the text; what is no situation is answered by `{"status": "invalid", "message": …}`.
        planner: who plans.
        include: as in `answer`.
        deadline: as in `answer` [s].
    """
    wanted = Wanted(planner=planner, include=include, deadline=deadline)
    (reply,) = answer_all([(1, line)], wanted)
    reply.pop("line", None)
    return reply


def refused_line(line: bytes, message: str) -> bytes:
    """The answer to a situation in JSON text that was not planned, through no fault of its own.

    Args:
        line: the text.
        message: why not, and when to ask again.
    """
    try:
        content = loads(line)
    except ContractError:
        content = None
    named = {"id": content["id"]} if isinstance(content, dict) and "id" in content else {}
    return orjson.dumps({**named, "status": "refused", "message": message})


def _answer_one(read: _Read, wanted: Wanted) -> dict[str, Any]:
    try:
        situation, anchor = situation_from_body(read.body)
    except ContractError as error:
        return _invalid(read.line, read.named, error)
    if wanted.fields == "times":
        return read.named | _time_of(ask(wanted.planner, situation, deadline=wanted.deadline).plan)
    return read.named | answer(
        situation, anchor, wanted.planner, include=wanted.include, deadline=wanted.deadline
    )


def _invalid(line: int, named: dict[str, Any], error: ContractError) -> dict[str, Any]:
    return {**named, "status": "invalid", "line": line, "message": str(error)}


def _read(content: object) -> NamedSituationBody:
    if isinstance(content, ContractError):
        raise content
    if not isinstance(content, dict):
        raise ContractError([("", "A line must be an object with fields: a situation.")])
    return parse(NamedSituationBody, content)


def _name(content: object) -> dict[str, Any]:
    """The `id` alone, if it is one that can be written back."""
    match content.get("id") if isinstance(content, dict) else None:
        case bool():
            return {}
        case int(number) if abs(number) <= MAX_INTEGER:
            return {"id": number}
        case str(text) if len(text) <= MAX_ID and make_printable(text) == text:
            return {"id": text}
        case _:
            return {}


# --- times alone --------------------------------------------------------------------------------


def _answer_together(
    together: Sequence[tuple[_Read, Row]], wanted: Wanted
) -> Iterator[tuple[int, dict[str, Any]]]:
    """The times of situations, all at once; each with the place of its answer."""
    if not together:
        return
    situations, intents, sound = columns_of([row for _, row in together])
    turning = intents.counts > 0
    straight = _times(plan_arrays(take(situations, sound & ~turning), threads=1))
    turned = _turning(turning_times(take(situations, sound & turning), intents[sound & turning]))
    for (read, _), fine, turns in zip(together, sound.tolist(), turning.tolist(), strict=True):
        reply = None
        if fine:
            reply = next(turned if turns else straight)
        # one by one what is wrong is said, and searched where cheap tests do not decide
        yield read.at, _answer_one(read, wanted) if reply is None else read.named | reply


def _times(found: Times) -> Iterator[dict[str, Any]]:
    """Each time as an answer."""
    for verdict, time, bound in zip(
        found.verdicts.tolist(),
        found.time_to_converge.tolist(),
        found.lower_bound.tolist(),
        strict=True,
    ):
        match VERDICTS[verdict]:
            case "planned":
                proof: Proof = "relaxation" if time <= bound + AS_FAST else "bound"
                yield _planned(time, proof, min(bound, time))
            case Reason.BEYOND_HORIZON | Reason.SEPARATION_UNAVOIDABLE as reason:
                yield _unplanned(reason, bound)
            case reason:
                yield _unplanned(reason, 0.0)


def _turning(found: TurningTimes) -> Iterator[dict[str, Any] | None]:
    """The same behind leaders that turn; `None` where it takes a search."""
    for time, decided, lost in zip(*(column.tolist() for column in found), strict=True):
        if lost:
            yield _unplanned(Reason.SEPARATION_ALREADY_LOST, 0.0)
        else:
            yield _planned(time, "relaxation", time) if decided else None


def _time_of(planned: Plan | NoPlan) -> dict[str, Any]:
    if isinstance(planned, NoPlan):
        return _unplanned(planned.reason, planned.lower_bound)
    proved = planned.optimality
    return _planned(planned.time_to_converge, proved.proof, proved.lower_bound)


def _planned(time: Second, proof: Proof, bound: Second) -> dict[str, Any]:
    return {
        "status": "planned",
        "time_to_converge_s": time,
        "optimality": {"proof": proof, "lower_bound_s": bound},
    }


def _unplanned(reason: str, bound: Second) -> dict[str, Any]:
    return {"status": "no_plan", "reason": reason, "lower_bound_s": bound}

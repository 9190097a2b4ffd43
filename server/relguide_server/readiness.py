"""Readiness: kernels that are yet to be compiled, and what must wait for them.

The first start of an installation compiles in processes of its own. Meanwhile the page is shown,
and flies as soon as what flights need is compiled; the service is ready once it can plan at the
limit as well. Proofs, networks and the tree are compiled when the first request asks for them. A
request that needs more than there is is refused with 503 and the time to try again; a flight under
way waits.
"""

import gc
import threading
from collections.abc import Callable, Collection, Sequence
from math import ceil
from time import monotonic
from typing import Annotated, Literal

from fastapi import Depends
from pydantic import BaseModel, Field
from starlette.requests import HTTPConnection

from relguide.planning.acceptance import with_deadline
from relguide.planning.outcome import NoPlan, Plan, Planner
from relguide.planning.plan import plan_at_once
from relguide.planning.situation import Situation
from relguide.units import Second
from relguide.warm_up import (
    SETS,
    STEPS,
    Preparing,
    WarmUpError,
    missing,
    prepare,
    usual_jobs,
)
from relguide_server.http.errors import Refusal, ServiceStopping, log, run_logged
from relguide_server.records.service import RecordsReport
from relguide_server.settings import ServiceSettings

PLANNED_WITH = {
    "exact": ("limited",),
    "network": ("limited", "networks"),
    "regular_dp": ("limited", "tree"),
    "printed_network": ("limited",),
}
"""Steps a planner needs for any situation; without the limit "flying" is enough."""

AMID = "amid"
"""The step that situations with others need besides."""
ON_DEMAND = ("proofs", "networks", "tree")
"""Steps that are compiled when a request first needs them."""
STOP_FOLLOWS: Second = 1.0
"""A signal to all processes ends those that compile; the service is stopped within so long."""
USUAL_WAIT = 10
"""After so long a client may ask again while nothing is known of the pace [s]."""


def steps_for(settings: ServiceSettings) -> tuple[str, ...]:
    """The steps of `relguide.warm_up` that a service with these settings needs."""
    extra = (name for name in PLANNED_WITH[settings.planner] if name not in SETS["serve"])
    return (*SETS["serve"], *extra)


def needed_for(settings: ServiceSettings) -> tuple[str, ...]:
    """Those of them without which it is not ready."""
    return ("flying", *PLANNED_WITH[settings.planner])


def _needed_for(situation: Situation, name: str) -> tuple[str, ...]:
    """The steps that a planner of this name needs for a situation beside "flying"."""
    return (*PLANNED_WITH.get(name, ()), *((AMID,) if situation.others else ()))


class NowPreparing(BaseModel):
    """What is being compiled."""

    name: str = Field(description="A few words, e.g. `the limited search`.")
    share: float = Field(description="How much of it is done, from 0 to 1.")


class PlanningReport(BaseModel):
    """Whether what takes longer than a millisecond is answered."""

    answers: bool = Field(description="Whether a worker answers: one is asked.")
    processes: int = Field(description="How many run.")
    waiting: dict[str, int] = Field(description="Jobs that wait for one, by kind.")


class FeedReport(BaseModel):
    """A feed that says what else flies."""

    feed: str = Field(description="As the setting names it.")
    state: Literal["hears", "silent", "over"] = Field(
        description="silent: nothing usable has come for 10 s; over: a recording's end."
    )
    message: str = Field(description="How it stands, in a sentence.")
    messages: int = Field(description="Datagrams, answers or seconds of a recording that came.")
    taken: int = Field(description="Reports that were put into the picture.")
    malformed: int = Field(description="Messages that could not be read.")
    unusable: int = Field(
        description="Reports without a place, a time, a velocity and a name that can be."
    )
    untimely: int = Field(description="Reports of more than a minute ago, or of later than now.")
    lost: int = Field(description="Messages that came faster than they could be read.")


class Readiness(BaseModel):
    """What a service can answer already."""

    status: Literal["ready", "preparing"] = Field(description="Whether it flies and plans.")
    warm: dict[str, bool] = Field(description="Parts of the planner, and whether each is compiled.")
    preparing: NowPreparing | None = Field(description="What is compiled now; null if nothing is.")
    planning: PlanningReport = Field(description="The workers.")
    records: RecordsReport = Field(description="The database; what it says changes nothing here.")
    feeds: list[FeedReport] = Field(
        default_factory=list,
        description="Feeds, if there are any; that one is silent changes nothing here.",
    )


class Preparation:
    """What is compiled of some steps; compiles the rest, from `start` to `stop`.

    Without steps nothing waits: every kernel is compiled when it is used.
    """

    def __init__(
        self, steps: Sequence[str] = (), *, needed: Sequence[str] = ("flying", "limited")
    ) -> None:
        """Look at what is compiled.

        Args:
            steps: of `relguide.warm_up`, compiled from the start.
            needed: those of them without which the service is not ready.
        """
        self._steps = tuple(steps)
        self._needed = tuple(needed)
        self._on_demand = tuple(step for step in ON_DEMAND if step not in steps) if steps else ()
        self._missing = missing((*steps, *self._on_demand)) if steps else ()
        self._asked: tuple[str, ...] = ()
        """Steps to be compiled after those from the start."""
        self._state: Preparing | None = None
        self._began = monotonic()
        self._rehearsed = False
        self._changed = threading.Condition()
        self._stopped = threading.Event()
        self._thread: threading.Thread | None = None

    def start(self, rehearse: Callable[[], None]) -> None:
        """Begin to compile, and rehearse a flight as soon as it can be flown."""
        self._thread = threading.Thread(
            target=run_logged, args=("Preparing", lambda: self._run(rehearse)), name="prepare",
            daemon=True,
        )  # fmt: skip
        self._thread.start()

    def dismiss(self) -> None:
        """Compile no more, and let nothing wait for it."""
        self._stopped.set()
        with self._changed:
            self._changed.notify_all()

    def stop(self) -> None:
        """End it, with the processes that compile."""
        self.dismiss()
        if self._thread is not None:
            self._thread.join(1.0)

    @property
    def ready(self) -> bool:
        """Whether it can fly and plan: a flight has been rehearsed."""
        return self._rehearsed and self.has(*self._needed)

    def report(self) -> dict[str, object]:
        """What is compiled and what is being compiled: a `Readiness`."""
        state = self._state
        now = {"name": state.title, "share": round(state.share, 2)} if state else None
        named = (*self._steps, *self._on_demand)
        return {
            "status": "ready" if self.ready else "preparing",
            "warm": {name: self.has(name) for name in named},
            "preparing": now,
        }

    def has(self, *steps: str) -> bool:
        """Whether the kernels of some steps are compiled, or nobody compiles them ahead."""
        return not any(step in self._missing for step in steps)

    def require(self, *steps: str) -> None:
        """Refuse what cannot be answered yet; what is compiled on demand is compiled from now on.

        Raises:
            Refusal: 503, with what is being prepared and when to try again.
        """
        if self.has(*steps):
            return
        first = next(step for step in steps if not self.has(step))
        if first in self._on_demand:
            self._ask_for(first)
        occasion = "Compiled at the first request" if first in self._on_demand else "First start"
        raise Refusal(
            503,
            f"{occasion}: {self._progress()}. What you ask for needs {STEPS[first].title}: "
            "try again in a moment.",
            kind="preparing",
            headers={"Retry-After": str(self.seconds_left(*steps))},
        )

    def seconds_left(self, *steps: str) -> int:
        """About how long it takes until steps, or those needed, are compiled; 1 to 30 [s]."""
        state = self._state
        if state is None or state.kernels == 0:
            return USUAL_WAIT
        left = 0.0
        for step in (STEPS[name] for name in steps or self._needed if not self.has(name)):
            left += step.kernels * (1.0 - state.share if step.title == state.title else 1.0)
        return max(1, min(30, ceil(left * (monotonic() - self._began) / state.kernels)))

    def wait(self, *steps: str) -> None:
        """Wait, in a thread of one's own, until the kernels of some steps are compiled.

        Raises:
            ServiceStopping: if the service stops first.
        """
        with self._changed:
            self._changed.wait_for(lambda: self.has(*steps) or self._stopped.is_set())
        if not self.has(*steps):
            raise ServiceStopping

    def can_plan_by(self, name: str) -> bool:
        """Whether all that a planner needs is compiled."""
        return not self._missing or self.has("flying", *PLANNED_WITH.get(name, ()))

    def require_planner(self, name: str) -> None:
        """Refuse a planner that is not compiled.

        Args:
            name: of the planner; empty for one that is not compiled ahead.

        Raises:
            Refusal: 503, as in `require`.
        """
        self.require("flying", *PLANNED_WITH.get(name, ()))

    def admit(self, situation: Situation, name: str) -> None:
        """Refuse a situation whose plan needs what is not compiled yet.

        Args:
            situation: what is to be planned.
            name: of the planner.

        Raises:
            Refusal: 503, as in `require`.
        """
        self.require("flying")
        steps = _needed_for(situation, name)
        if not self.has(*steps) and (situation.others or plan_at_once(situation) is None):
            self.require(*steps)

    def guard(self, planner: Planner, name: str, *, waiting: bool) -> Planner:
        """The same planner; while kernels are missing, plans that need none of them.

        Args:
            planner: the planner.
            name: its name; empty if it has none.
            waiting: whether all other plans wait, as in a flight, or are refused.
        """

        def guarded(situation: Situation, *, deadline: Second | None = None) -> Plan | NoPlan:
            steps = _needed_for(situation, name)
            if not self.has("flying", *steps):
                if waiting:
                    self.wait("flying")
                self.require("flying")
                found = None if situation.others else plan_at_once(situation)
                if found is not None:
                    return found
                if waiting:
                    self.wait(*steps)
                self.require(*steps)
            return with_deadline(planner, deadline)(situation)

        return guarded

    def _progress(self) -> str:
        state = self._state
        return f"preparing {state.title}, {state.share:.0%}" if state else "preparing"

    def _ask_for(self, step: str) -> None:
        with self._changed:
            if step not in self._asked:
                self._asked += (step,)
            self._changed.notify_all()

    def _run(self, rehearse: Callable[[], None]) -> None:
        if self.has("flying"):
            self._rehearse(rehearse)
        self._compile([name for name in self._steps if not self.has(name)], rehearse)
        if not self._rehearsed and not self._stopped.is_set():
            self._rehearse(rehearse)
        while not self._stopped.is_set():
            with self._changed:
                self._changed.wait_for(lambda: self._asked or self._stopped.is_set())
            self._compile(self._asked, rehearse)
            with self._changed:
                self._asked = tuple(name for name in self._asked if not self.has(name))

    def _compile(self, wanted: Sequence[str], rehearse: Callable[[], None]) -> None:
        self._began = monotonic()
        try:
            for state in prepare(wanted, jobs=usual_jobs(), stopped=self._stopped.is_set):
                self._note(state, state.done)
                if not self._rehearsed and self.has("flying"):
                    self._rehearse(rehearse)
        except WarmUpError as error:
            if not self._stopped.wait(STOP_FOLLOWS):
                log.error("%s Kernels are compiled when they are first used instead.", error)
        if not self._stopped.is_set():
            self._note(None, wanted)

    def _rehearse(self, rehearse: Callable[[], None]) -> None:
        self._rehearsed = run_logged("The rehearsal of a flight", rehearse)
        if self._steps:  # what is loaded by now stays: to look through it takes the loop 0.1 s
            gc.freeze()

    def _note(self, state: Preparing | None, done: Collection[str]) -> None:
        with self._changed:
            self._state = state
            self._missing = tuple(name for name in self._missing if name not in done)
            self._changed.notify_all()


async def preparation_of(connection: HTTPConnection) -> Preparation:
    """The preparation of the app that serves this connection."""
    preparation: Preparation = connection.app.state.preparation
    return preparation


PreparationOf = Annotated[Preparation, Depends(preparation_of)]
"""How a route asks for it."""

"""PlanService: answers situations, at once where that takes a millisecond, else by the workers.

Most situations are planned within 0.1 ms, which is less than it takes to ask another process. So
each is first tried here, on the event loop, without a search. What is proved by that is the answer.
Everything else goes to a worker, with what is left of the budget. If that is spent before a worker
has answered, the answer is what is found here in no time: it is certified as well, or says that no
plan was found by the deadline, with its bound.
"""

import asyncio
from collections.abc import AsyncIterator, Sequence
from dataclasses import dataclass
from functools import partial
from time import monotonic, thread_time
from typing import Any, get_args

import orjson

from relguide.contract.answers import Form, Include
from relguide.contract.wire import to_wire
from relguide.flying.verdicts import ComparedPlanner, PlannerVerdict
from relguide.planning.outcome import Planner
from relguide.units import Second
from relguide_server.http.bodies import SMALL
from relguide_server.http.errors import Refusal
from relguide_server.http.metrics import Metrics
from relguide_server.jobs.worker_pool import Kind, WorkerPool
from relguide_server.planning import tasks as jobs
from relguide_server.planning.client_budgets import SHORT, ClientBudgets, takes_long
from relguide_server.planning.tasks import PlanReply
from relguide_server.readiness import AMID, Preparation

AT_ONCE: Second = 1e-3
"""How long a situation is tried on the event loop; of 4,000 extreme ones none took 3 ms."""
FEW = 10
"""Amid more others a situation is not tried there: each takes a path up to 0.1 ms to be judged."""
GRACE: Second = 1.0
"""How much later than its deadline a worker may answer before it is taken to be stuck."""
PROOF: Second = 5.0
"""How much longer Pontryagin's conditions may take, which know no deadline."""
STARVED = 4.0
"""Up to so many times its time is what waits for a processor given to the worker for quick ones."""
FIRST: Second = 0.25
"""What a plan that takes long is given at first, when its turn comes."""
MORE = 4.0
"""By how much more time it is begun anew."""
HANDING_OVER: Second = 0.02
"""How long an answer takes from a worker at most."""
COMPARING: Second = 5.0
"""How much longer planners may take to be compared: a tree is grown in a quarter of a second, and a
process that has asked no network yet loads them."""
SLICE: Second = 0.05
"""A batch is planned in slices of this length, between which other jobs are begun."""
AT_A_TIME = 64
"""Most lines of a batch that are sent at a time."""
READING: Second = 30.0
"""How long the largest batch may take to be read."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wish:
    """How a situation is to be answered."""

    planner: str | None
    """By whom; the service's own planner if `None`."""
    include: tuple[Include, ...]
    budget: Second
    """How long planning may take, waiting included; for a batch, each situation."""
    form: Form = "json"
    """How a plan is written."""

    @property
    def patience(self) -> Second:
        """How long a job may take beyond what is left of the budget."""
        return GRACE + (PROOF if "optimality" in self.include else 0.0)


class PlanService:
    """Answers situations. Lives on the event loop."""

    def __init__(
        self,
        name: str,
        planner: Planner,
        *,
        quick: bool,
        preparation: Preparation,
        workers: WorkerPool,
        metrics: Metrics,
    ) -> None:
        """Open it.

        Args:
            name: of the service's own planner; empty for one that has none, which other processes
                cannot be given.
            planner: the same, to be asked here.
            quick: whether it takes a deadline.
            preparation: says which kernels are compiled.
            workers: do what takes longer.
            metrics: count the answers.
        """
        self.name = name
        """Of the service's own planner; empty if it has none."""
        self._planner, self._guarded = planner, preparation.guard(planner, name, waiting=False)
        self._preparation = preparation
        self._workers = workers
        self._metrics = metrics
        self._quick = quick
        self._budgets = ClientBudgets()

    def answer_at_once(self, body: bytes, wish: Wish, *, client: str) -> PlanReply | None:
        """The answer to a situation in JSON; `None` where that may take too long.

        Raises:
            Refusal: if it is no situation.
        """
        if wish.include or wish.form != "json" or len(body) > SMALL:
            return None
        if not self._budgets.may_look(client):
            return None
        began = thread_time()
        found: PlanReply | None = None
        try:
            found = self._look(body, wish)
        finally:
            self._budgets.note_look(client, thread_time() - began, vain=found is None)
        return found

    def _look(self, body: bytes, wish: Wish) -> PlanReply | None:
        situation, anchor = jobs.read_situation(body)
        if not self._is_own(wish) or len(situation.others) > FEW:
            return None
        if situation.others:
            self._preparation.require(AMID)
        if not self._preparation.can_plan_by(self.name):
            found = jobs.plan_situation(situation, anchor, self._guarded, (), None)
        elif self.name != "exact":
            found = jobs.plan_situation(situation, anchor, self._planner, (), AT_ONCE)
        else:
            return jobs.plan_at_once(situation, anchor)
        return found if found.final else None

    async def answer_by_worker(
        self, body: bytes, wish: Wish, end: float, *, client: str
    ) -> PlanReply:
        """The answer to a situation in JSON.

        Args:
            body: the situation.
            wish: how it is to be answered.
            end: when the budget is spent, by `time.monotonic` [s].
            client: who asks.

        Raises:
            Refusal: if it is no situation, or too many wait.
        """
        self._require(wish)
        # it comes back some milliseconds after it was planned
        job = self._plan_in_turn(body, wish, end - min(HANDING_OVER, 0.1 * wish.budget), client)
        if wish.include or not self._is_own(wish):
            return await job
        try:
            async with asyncio.timeout(max(end - monotonic(), HANDING_OVER)):
                return await job
        except TimeoutError:
            situation, anchor = jobs.read_situation(body)
            return jobs.plan_situation(situation, anchor, self._planner, (), 0.0, wish.form)

    def _is_own(self, wish: Wish) -> bool:
        """Whether the service's own planner is wanted, and it takes a deadline."""
        return self._quick and wish.planner in (None, self.name)

    async def _plan_in_turn(self, body: bytes, wish: Wish, end: float, client: str) -> PlanReply:
        """What workers make of it: quickly if it can be, else after others that can be.

        How long one takes is known once it is planned, so each is first given a short time by the
        worker that is kept for quick ones, unless its client asked for long ones lately: such a
        client loses nothing while nobody else asks for them. What waited there for a processor is
        given twice the time.

        A long plan is begun anew with four times the time, so long as there is any. Most of it is
        spent on the last, a job ends soon after its client has left, and none keeps a worker from
        all others for the whole of a long budget.
        """
        most = wish.budget
        if (wish.planner or self._quick) and "optimality" not in wish.include:
            most = FIRST
            short, longer = self._budgets.time_for(client), 1.0
            while short and longer <= STARVED:
                kind: Kind = "plans" if short == SHORT else "trials"
                quick = await self._try(kind, body, wish, end, longer * short, client, short)
                if not quick.cut or end - monotonic() < longer * short:
                    return quick
                if takes_long(quick, short):
                    if not self._workers.has_room("long_plans", client):
                        return quick  # certified, with its bound: better than nothing
                    break
                longer *= 2.0
        while True:
            try:
                found = await self._try("long_plans", body, wish, end, most, client)
            except asyncio.CancelledError:
                self._budgets.note_impatient(client)
                raise
            if not found.cut or end - monotonic() < most:
                return found
            most *= MORE

    async def _try(
        self,
        kind: Kind,
        body: bytes,
        wish: Wish,
        end: float,
        most: Second,
        client: str,
        short: Second = SHORT,
    ) -> PlanReply:
        """What a worker makes of it in some time; whether it takes long is noted."""
        found: PlanReply = await self._workers.do(
            kind,
            jobs.plan_body,
            body,
            self.planner_for(wish.planner),
            wish.include,
            end,
            most,
            wish.form,
            patience=max(end - monotonic(), 0.0) + wish.patience,
            client=client,
            heard=partial(self._budgets.note_plan, client, short),
        )
        return found

    async def answer_batch(
        self, lines: Sequence[bytes], wish: Wish, *, client: str
    ) -> AsyncIterator[list[bytes]]:
        """The answers to the lines of a batch, in their order, as they come.

        Raises:
            Refusal: if too many batches wait.
        """
        self._require(wish)
        done = 0
        while done < len(lines):
            answers: list[PlanReply] = await self._workers.do(
                "batches",
                jobs.plan_lines,
                lines[done : done + AT_A_TIME],
                self.planner_for(wish.planner),
                wish.include,
                wish.budget,
                SLICE,
                patience=SLICE + wish.budget + wish.patience,
                client=client,
            )
            done += len(answers)
            yield [self.count(answered) for answered in answers]

    async def compare(self, body: bytes, budget: Second, *, client: str) -> bytes:
        """What each planner would fly; one that is not compiled yet says so.

        Raises:
            Refusal: if it is no situation, or the exact planner is not compiled yet.
        """
        self._preparation.require_planner("exact")
        waiting = dict[ComparedPlanner, str]()
        names: tuple[ComparedPlanner, ...] = get_args(ComparedPlanner)
        for name in names:
            try:
                self._preparation.require_planner(name)
            except Refusal as refusal:
                waiting[name] = refusal.detail
        found: list[dict[str, Any]] = await self._workers.do(
            "long_plans",
            jobs.compare_planners,
            body,
            [name for name in names if name not in waiting],
            budget,
            patience=budget + COMPARING,
            client=client,
        )
        by_name = {verdict["planner"]: verdict for verdict in found}
        for name, why in waiting.items():
            by_name[name] = to_wire(PlannerVerdict(planner=name, status="preparing", message=why))
        return orjson.dumps({"planners": [by_name[name] for name in names]})

    async def split(self, body: bytes, *, client: str) -> list[bytes]:
        """The situations of a batch as lines; refused as a whole if one is wrong."""
        lines: list[bytes] = await self._workers.do(
            "batches", jobs.split_batch, body, patience=READING, client=client
        )
        return lines

    def count(self, answered: PlanReply) -> bytes:
        """The text of an answer, which is counted."""
        self._metrics.count_plan(answered.status, answered.reason, answered.seconds)
        return answered.text

    def _require(self, wish: Wish) -> None:
        """Refuse what is not compiled yet."""
        self._preparation.require_planner(wish.planner or self.name)
        if "optimality" in wish.include:
            self._preparation.require("proofs")

    def planner_for(self, name: str | None) -> str | Planner:
        """A planner as a worker takes it: the service's own, or another by its name."""
        return name or self.name or self._planner

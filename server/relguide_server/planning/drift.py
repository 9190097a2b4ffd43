"""DriftCheck: compares some of the network's answers with the exact planner while the service runs.

A network is as good as its audit says only in situations like those of the audit. Whether the
situations of real requests are like them is seen here: every N-th answer of the network is planned
again exactly, on a separate thread, after it has been sent. The result goes to `/metrics`. No
request waits for it; when there is too much to do, answers are skipped and counted.
"""

from functools import partial
from queue import Empty, Full, Queue
from threading import Event, Lock, Thread

from relguide.planning.acceptance import with_deadline
from relguide.planning.outcome import NoPlan, Plan, Planner
from relguide.planning.plan import plan as exact_plan
from relguide.planning.situation import Situation
from relguide.units import Second
from relguide_server.http.errors import run_logged
from relguide_server.http.metrics import Metrics

WAITING = 32
"""Answers that may wait to be audited: where the limit binds, an exact plan takes some 10 ms."""
LOOK = 0.5
"""How often the thread checks whether it should end [s]."""
LONGEST = 1.0
"""How long the exact planner may take for an audit [s]."""
DIFFERENT = 1e-3
"""Times that differ by more are different answers [s]."""


class DriftCheck:
    """Audits one in N answers of a network, from `start` to `stop`."""

    def __init__(self, metrics: Metrics, *, every: int, exact: Planner = exact_plan) -> None:
        """Prepare it.

        Args:
            metrics: where the results go.
            every: N; with 0 nothing is audited, but answers are counted.
            exact: the planner that answers are compared with.
        """
        self._metrics = metrics
        self._every = every
        self._answers = 0
        self._exact = exact
        self._waiting: Queue[Plan] = Queue(WAITING)
        self._lock = Lock()
        self._over = Event()
        self._thread: Thread | None = None

    def watch(self, planner: Planner) -> Planner:
        """The same planner, with its answers counted and audited; usable from any thread."""

        def plan_and_note(situation: Situation, *, deadline: Second | None = None) -> Plan | NoPlan:
            answer = with_deadline(planner, deadline)(situation)
            if isinstance(answer, Plan):
                self._note(answer)
            return answer

        return plan_and_note

    def start(self) -> None:
        """Begin to audit."""
        if self._every > 0:
            self._over.clear()
            self._thread = Thread(target=self._run, name="drift check", daemon=True)
            self._thread.start()

    def stop(self) -> None:
        """End after the present audit; those that wait are skipped."""
        self._over.set()
        if self._thread is not None:
            self._thread.join(LOOK + LONGEST)
            self._thread = None

    def _note(self, answer: Plan) -> None:
        with self._lock:
            if answer.fell_back:
                self._metrics.network_fallbacks.inc()
                return
            if answer.planner != "network":
                return
            self._metrics.network_answers.inc()
            self._answers += 1
            if self._every == 0 or self._answers % self._every:
                return
            try:
                self._waiting.put_nowait(answer)
            except Full:
                self._metrics.drift_dropped.inc()

    def _run(self) -> None:
        while not self._over.is_set():
            try:
                answer = self._waiting.get(timeout=LOOK)
            except Empty:
                continue
            # a mistake in here goes to the log, and the next answer is audited all the same
            run_logged("An audit of the drift check", partial(self._audit, answer))

    def _audit(self, answer: Plan) -> None:
        exact = with_deadline(self._exact, LONGEST)(answer.situation)
        # the network's answer is certified: if the exact planner has no plan, nothing is lost
        loss = 0.0 if isinstance(exact, NoPlan) else _loss(answer, exact)
        differs = isinstance(exact, NoPlan) or abs(loss) > DIFFERENT
        with self._lock:
            self._metrics.count_audit(differs=differs, loss=loss)


def _loss(answer: Plan, exact: Plan) -> float:
    """How much later the answer arrives than the exact one [s]; below 0 if it is sooner."""
    return answer.time_to_converge - exact.time_to_converge

"""DriftCheck: holds some of the network's answers against the exact planner while the service runs.

A network is as good as its audit said in the situations of that audit. Whether those that are
really asked are like them shows only here: every N-th answer of the network is planned again
exactly, on a thread of its own, after it has been given. What is found is a matter for `/metrics`;
nobody waits for it, and with too much to do answers are left out, and counted.
"""

from functools import partial
from queue import Empty, Full, Queue
from threading import Event, Lock, Thread

from relguide.planning.plan import NoPlan, Plan, Planner
from relguide.planning.plan import plan as exact_plan
from relguide.planning.situation import Situation
from relguide_server.errors import run_logged
from relguide_server.metrics import Metrics

WAITING = 32
"""Answers that may wait to be audited: where the limit binds, an exact plan takes some 10 ms."""
LOOK = 0.5
"""How often the thread looks whether it should end [s]."""
DIFFERENT = 1e-3
"""Times that differ by more are different answers [s]."""


class DriftCheck:
    """Audits one in N answers of a network, from `start` to `stop`."""

    def __init__(self, metrics: Metrics, *, every: int, exact: Planner = exact_plan) -> None:
        """Prepare it.

        Args:
            metrics: takes what is found.
            every: N; 0 audits nothing, and answers are still counted.
            exact: what an answer is held against.
        """
        self._metrics = metrics
        self._every = every
        self._exact = exact
        self._waiting: Queue[Plan] = Queue(WAITING)
        self._lock = Lock()
        self._over = Event()
        self._thread: Thread | None = None

    def watching(self, planner: Planner) -> Planner:
        """The same planner, whose answers are seen here; may be asked from any thread."""

        def watched(situation: Situation) -> Plan | NoPlan:
            answer = planner(situation)
            if isinstance(answer, Plan):
                self._see(answer)
            return answer

        return watched

    def start(self) -> None:
        """Begin to audit."""
        if self._every > 0:
            self._over.clear()
            self._thread = Thread(target=self._run, name="drift check", daemon=True)
            self._thread.start()

    def stop(self) -> None:
        """End once the present audit is done; what waits is left out."""
        self._over.set()
        if self._thread is not None:
            self._thread.join()
            self._thread = None

    def _see(self, answer: Plan) -> None:
        with self._lock:
            if answer.fell_back:
                self._metrics.network_fallbacks += 1
                return
            if answer.planner != "network":
                return
            self._metrics.network_answers += 1
            if self._every == 0 or self._metrics.network_answers % self._every:
                return
            try:
                self._waiting.put_nowait(answer)
            except Full:
                self._metrics.drift_dropped += 1

    def _run(self) -> None:
        while not self._over.is_set():
            try:
                answer = self._waiting.get(timeout=LOOK)
            except Empty:
                continue
            # a mistake here is in the log, and the next answer is audited all the same
            run_logged("An audit of the drift check", partial(self._audit, answer))

    def _audit(self, answer: Plan) -> None:
        exact = self._exact(answer.situation)
        # the network's answer is certified: where the exact planner has none, nothing is lost
        loss = 0.0 if isinstance(exact, NoPlan) else _loss(answer, exact)
        differs = isinstance(exact, NoPlan) or abs(loss) > DIFFERENT
        with self._lock:
            self._metrics.drift_audited(differs=differs, loss=loss)


def _loss(answer: Plan, exact: Plan) -> float:
    """How much later the answer arrives [s]; below 0 if it is the exact planner that does."""
    return answer.time_to_converge - exact.time_to_converge

"""What the service counts of itself, for Prometheus."""

from collections.abc import Callable, Iterable
from importlib.metadata import version

import prometheus_client
from prometheus_client import (
    CollectorRegistry,
    Counter,
    Gauge,
    GCCollector,
    Histogram,
    Info,
    ProcessCollector,
)
from prometheus_client.core import Metric
from prometheus_client.exposition import choose_encoder
from prometheus_client.registry import Collector

PLAN_BUCKETS = (0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.1, 1.0)
"""Upper ends of the histogram of planning times [s]: a plan takes about 0.1 ms, or some 10 ms where
the separation limit binds."""
REQUEST_BUCKETS = (0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 5.0, 30.0)
"""The same of requests."""

prometheus_client.disable_created_metrics()  # type: ignore[no-untyped-call]  # a gauge a counter


class Metrics:
    """Counters of one running service; what is measured only when asked for, `watch` gives."""

    def __init__(self) -> None:
        self.registry = CollectorRegistry()

        def counter(name: str, text: str, *labels: str) -> Counter:
            return Counter(name, text, labels, registry=self.registry)

        self.plans = counter("relguide_plans", "Plans answered.", "status")
        self.no_plans = counter("relguide_no_plans", "Answers without a plan.", "reason")
        self.plan_seconds = Histogram(
            "relguide_plan_seconds",
            "Time to make and write one plan.",
            buckets=PLAN_BUCKETS,
            registry=self.registry,
        )
        self.requests = counter(
            "relguide_requests", "Requests answered.", "route", "method", "status"
        )
        self.request_seconds = Histogram(
            "relguide_request_seconds",
            "Time to answer a request.",
            ("route", "method"),
            buckets=REQUEST_BUCKETS,
            registry=self.registry,
        )
        self.job_waits = Histogram(
            "relguide_job_wait_seconds",
            "Time that a job waited for a worker.",
            ("kind",),
            buckets=REQUEST_BUCKETS,
            registry=self.registry,
        )
        self.frames_refused = counter(
            "relguide_frames_refused", "Frames that closed the socket they came on.", "why"
        )
        self.flights_ended = counter("relguide_flights_ended", "Flights ended.", "outcome")
        self.flights_started = counter("relguide_flights_started", "Flights started.")
        self.flight_seconds = counter("relguide_flight_seconds", "Flight time flown.")
        self.flight_seconds_asked = counter(
            "relguide_flight_seconds_asked", "Flight time that the rates of flights asked for."
        )
        self.least_rate = Gauge(
            "relguide_flights_least_rate",
            "Of the flights in the air, the least share of its rate flown in the last second.",
            registry=self.registry,
        )
        self.least_rate.set(1.0)
        self.ticks_sent = counter("relguide_stream_ticks_sent", "Ticks sent to clients.")
        self.ticks_dropped = counter(
            "relguide_stream_ticks_dropped", "Ticks that slow clients missed."
        )
        self.network_answers = counter("relguide_network_plans", "Plans by network.")
        self.network_fallbacks = counter(
            "relguide_network_fallbacks", "Plans by the exact planner in place of the network."
        )
        self.drift_audits = counter(
            "relguide_drift_audits", "Plans by network that were planned again exactly.", "answer"
        )
        self.drift_dropped = counter(
            "relguide_drift_dropped", "Plans by network not audited because too many waited."
        )
        self.drift_loss = counter(
            "relguide_drift_loss_seconds", "Sum of the losses of audited plans by network."
        )
        self.drift_largest_loss = Gauge(
            "relguide_drift_largest_loss_seconds",
            "Largest loss of an audited plan by network.",
            registry=self.registry,
        )
        build = Info("relguide_build", "What runs here.", registry=self.registry)
        build.info({"version": version("relguide")})
        self._largest_loss = 0.0
        self._plans: dict[str, Counter] = {}
        self._requests: dict[tuple[str, str, int], tuple[Counter, Histogram]] = {}
        for status in ("planned", "no_plan", "invalid"):
            self.plans.labels(status)
        for why in ("not_understood", "too_fast", "not_passed_on"):
            self.frames_refused.labels(why)
        for answer in ("same", "different"):
            self.drift_audits.labels(answer)

    def serve_process(self) -> None:
        """Measure this process too: its memory, processor time and descriptors."""
        ProcessCollector(registry=self.registry)
        GCCollector(registry=self.registry)

    def watch(self, measure: Callable[[], Iterable[Metric]]) -> None:
        """Let a function give what is measured each time the page is read."""
        self.registry.register(_Measured(measure))

    def count_plan(self, status: str, reason: str, seconds: float) -> None:
        """Count one plan.

        Args:
            status: of the answer; `invalid` for lines of a batch.
            reason: why there is no plan; empty if there is one.
            seconds: how long it took.
        """
        if (counted := self._plans.get(status)) is None:
            counted = self._plans[status] = self.plans.labels(status)
        counted.inc()
        if reason:
            self.no_plans.labels(reason).inc()
        self.plan_seconds.observe(seconds)

    def count_request(self, route: str, method: str, status: int, seconds: float) -> None:
        """Count one request of HTTP."""
        key = (route, method, status)
        if (known := self._requests.get(key)) is None:
            counted, timed = self.requests.labels(*key), self.request_seconds.labels(route, method)
            known = self._requests[key] = counted, timed  # to look them up takes 10 µs
        known[0].inc()
        known[1].observe(seconds)

    def note_wait(self, kind: str, seconds: float) -> None:
        """Note how long a job of a kind waited for a worker [s]."""
        self.job_waits.labels(kind).observe(seconds)

    def count_audit(self, *, differs: bool, loss: float) -> None:
        """Count one plan by network that was planned again exactly.

        Args:
            differs: whether the two arrive at different times.
            loss: how much later the network's arrives [s]; below 0 if it arrives sooner.
        """
        self.drift_audits.labels("different" if differs else "same").inc()
        self.drift_loss.inc(max(loss, 0.0))
        self._largest_loss = max(loss, self._largest_loss)
        self.drift_largest_loss.set(self._largest_loss)

    def value(self, name: str, **labels: str) -> float:
        """A number of the page; 0 for one that has not been counted yet."""
        return self.registry.get_sample_value(name, labels) or 0.0

    def page(self, accept: str) -> tuple[bytes, str]:
        """The whole page, and its media type.

        Args:
            accept: the header of the request: Prometheus asks for OpenMetrics, people for text.
        """
        encode, media_type = choose_encoder(accept)
        return encode(self.registry), media_type


class _Measured(Collector):
    def __init__(self, measure: Callable[[], Iterable[Metric]]) -> None:
        self._measure = measure

    def collect(self) -> Iterable[Metric]:
        """What is measured now."""
        return self._measure()

    def describe(self) -> Iterable[Metric]:
        """Nothing, so that nothing is measured before the page is read."""
        return ()

"""Counters of the service in the text format of Prometheus."""

from bisect import bisect_left
from dataclasses import dataclass, field

BUCKETS = (0.0001, 0.00025, 0.0005, 0.001, 0.0025, 0.005, 0.01, 0.1, 1.0)
"""Upper ends of the histogram of planning times [s]: a plan takes about 0.1 ms, or some 10 ms where
the separation limit binds."""


@dataclass(slots=True, kw_only=True)
class Metrics:
    """Counters of one running service, and one largest value; they only grow."""

    plans: dict[str, int] = field(
        default_factory=lambda: {"planned": 0, "no_plan": 0, "invalid": 0}
    )
    """Plans answered, by status; `invalid` for lines of a batch."""
    plan_counts: list[int] = field(default_factory=lambda: [0] * (len(BUCKETS) + 1))
    """Plans in each bucket; the last is for all above."""
    plan_seconds: float = 0.0
    """Sum of all planning times [s]."""
    flights_started: int = 0
    """Flights started since the service is up."""
    ticks_sent: int = 0
    """Messages put on the streams."""
    ticks_dropped: int = 0
    """Messages that a slow client did not get because newer ones took their place."""
    network_answers: int = 0
    """Plans by network, for REST and for flights."""
    network_fallbacks: int = 0
    """Plans by the exact planner where the network was not sure."""
    drift_answers: dict[str, int] = field(default_factory=lambda: {"same": 0, "different": 0})
    """Plans by network that were planned again exactly, by result."""
    drift_dropped: int = 0
    """Plans by network that were due for an audit while too many waited."""
    drift_loss: float = 0.0
    """Sum of the losses of audited plans [s]."""
    drift_largest_loss: float = 0.0
    """The largest of those losses [s]."""

    def count_plan(self, status: str, seconds: float) -> None:
        """Count one plan."""
        self.plans[status] += 1
        self.plan_seconds += seconds
        self.plan_counts[bisect_left(BUCKETS, seconds)] += 1

    def count_audit(self, *, differs: bool, loss: float) -> None:
        """Count one plan by network that was planned again exactly.

        Args:
            differs: whether the two arrive at different times.
            loss: how much later the network's arrives [s]; below 0 if it arrives sooner.
        """
        self.drift_answers["different" if differs else "same"] += 1
        self.drift_loss += max(loss, 0.0)
        self.drift_largest_loss = max(loss, self.drift_largest_loss)

    def text(self, *, flights_running: int, stream_clients: int, scene_clients: int) -> str:
        """The whole page in the text format 0.0.4; the caller gives the gauges."""
        total = sum(self.plan_counts)
        lines = [
            *_header("relguide_plans_total", "counter", "Plans answered."),
            *(f'relguide_plans_total{{status="{k}"}} {n}' for k, n in self.plans.items()),
            *_header("relguide_plan_seconds", "histogram", "Time to make and write one plan."),
            *(
                f'relguide_plan_seconds_bucket{{le="{end:g}"}} {sum(self.plan_counts[: i + 1])}'
                for i, end in enumerate(BUCKETS)
            ),
            f'relguide_plan_seconds_bucket{{le="+Inf"}} {total}',
            f"relguide_plan_seconds_sum {self.plan_seconds:.6f}",
            f"relguide_plan_seconds_count {total}",
            *_metric("relguide_network_plans_total", "counter", "Plans by network.",
                     self.network_answers),
            *_metric("relguide_network_fallbacks_total", "counter",
                     "Plans by the exact planner in place of the network.", self.network_fallbacks),
            *_header("relguide_drift_audits_total", "counter",
                     "Plans by network that were planned again exactly."),
            *(f'relguide_drift_audits_total{{answer="{k}"}} {n}'
              for k, n in self.drift_answers.items()),
            *_metric("relguide_drift_dropped_total", "counter",
                     "Plans by network not audited because too many waited.", self.drift_dropped),
            *_metric("relguide_drift_loss_seconds_total", "counter",
                     "Sum of the losses of audited plans by network.", f"{self.drift_loss:.6f}"),
            *_metric("relguide_drift_largest_loss_seconds", "gauge",
                     "Largest loss of an audited plan by network.",
                     f"{self.drift_largest_loss:.6f}"),
            *_metric("relguide_flights_started_total", "counter", "Flights started.",
                     self.flights_started),
            *_metric("relguide_stream_ticks_sent_total", "counter", "Ticks sent to clients.",
                     self.ticks_sent),
            *_metric("relguide_stream_ticks_dropped_total", "counter",
                     "Ticks that slow clients missed.", self.ticks_dropped),
            *_metric("relguide_flights_running", "gauge", "Flights in the air.", flights_running),
            *_metric("relguide_stream_clients", "gauge", "Browsers on a stream.", stream_clients),
            *_metric("relguide_scene_clients", "gauge", "Browsers on a 3D scene.", scene_clients),
        ]  # fmt: skip
        return "\n".join(lines) + "\n"


def _header(name: str, kind: str, text: str) -> tuple[str, str]:
    return f"# HELP {name} {text}", f"# TYPE {name} {kind}"


def _metric(name: str, kind: str, text: str, value: int | str) -> tuple[str, str, str]:
    return *_header(name, kind, text), f"{name} {value}"

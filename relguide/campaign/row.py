"""The figures of one flight, and those of them that tables show."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Loss:
    """A time below d_min."""

    t_s: float
    separation_m: float
    """The least."""
    seconds: float
    mode: str
    """Of guidance, as it began."""
    cause: str
    """As a document gives it; empty if none does."""
    announced_s: float | None
    """How long before it something was announced; `None` if nothing was."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One flight."""

    family: str
    number: int
    planned: bool
    """Whether a plan stood at engagement."""
    intent_known: bool
    joined: bool
    flown_s: float
    join_s: float | None
    planned_s: float | None
    """The plan's time at engagement."""
    promised_s: float | None
    """The same with braking, where a document gives it."""
    join_over_plan: float | None
    join_over_promise: float | None
    least_share: float
    """Least separation [d_min]."""
    start_share: float
    """Separation at the start [d_min]."""
    below_s: float
    """Seconds below d_min."""
    losses: tuple[Loss, ...]
    silent_losses: int
    """Those that nothing announced."""
    shown_replans: int
    all_replans: int
    reversals: int
    """Of bank, until joined."""
    extra_reversals: int | None
    """Beyond those of the plan at engagement; `None` if there was none."""
    unplanned_reversals: int | None
    """Beyond those of all plans, each as far as it was flown; `None` if there was none."""
    swing_deg: float
    """All that the heading turned until joined."""
    loops: int
    """Full circles that neither the plans, as far as they were flown, nor the leader had."""
    lone_loops: int
    """Those of them during which the leader turned less than half a circle."""
    heading_jump_deg: float
    """Largest between held headings of two seconds without an announcement."""
    cross_track_m: float
    """Largest distance from the path of the last plan, while it is flown."""
    along_error_m: float = 0.0
    """Largest distance along the route from where it should be, while it followed."""
    across_error_m: float = 0.0
    """The same beside the route."""
    optimum_s: float | None = None
    """Of the fastest plan to the final leg, all known; `None` without, or with orders."""
    over_optimum_s: float | None = None
    """How much later it joined; `None` where it joined before the leader's last turn."""
    why_not_joined: str = ""
    join_over_last_promise: float | None = None
    """Over the promise from the plan last announced, and by its promise."""
    off_announced_m: float = 0.0
    """The same from the path last announced to the crew."""
    off_forecast_m: float | None = None
    """Largest distance from where the last forecast had the pursuer; `None` without one."""
    fastest_mps: float
    alerts: int
    cpu_s: float
    best_turn_share: float | None = None
    """What any turn begun at once keeps of d_min, for a flight that had no plan and lost it."""
    autopilot_join_s: float | None = None
    """When the autopilot joins in the same flight; `None` if it does not, or if it flew this one.
    So are the next."""
    autopilot_least_share: float | None = None
    """Least separation of that flight [d_min]."""
    within_bar_share: float | None = None
    """Share of the time by hand in which the bank was within 2° of the commanded one."""
    tube_m: float | None = None
    """Largest distance by hand beside the path of the plan that was flown."""
    off_autopilot_m: float | None = None
    """The same, until joined, from the path that the autopilot flew."""
    error: str = ""
    """What it ended with, if not with its last document."""

    @property
    def name(self) -> str:
        """As the command line takes it."""
        return f"{self.family} {self.number}"

    @property
    def late_share(self) -> float | None:
        """How much later than the autopilot it joined, over the autopilot's time."""
        if self.join_s is None or self.autopilot_join_s is None:
            return None
        return self.join_s / self.autopilot_join_s - 1.0

    @property
    def nearer_share(self) -> float | None:
        """How much nearer than the autopilot it came to the leader [d_min]."""
        least = self.autopilot_least_share
        return None if least is None else least - self.least_share

    @property
    def avoidable(self) -> bool:
        """Whether d_min was lost and need not have been."""
        return bool(self.losses) and (self.best_turn_share is None or self.best_turn_share >= 1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """A figure of rows that tables show."""

    name: str
    """Of the field or property of `Row`."""
    heading: str
    decimals: int = 0
    low_is_worse: bool = False
    scale: float = 1.0
    offset: float = 0.0

    def values(self, rows: Sequence[Row]) -> list[tuple[float, Row]]:
        """What rows have of it, with the row; what has none is left out."""
        found = [(getattr(row, self.name), row) for row in rows if not row.error]
        return [
            ((float(value) + self.offset) * self.scale, row)
            for value, row in found
            if value is not None
        ]


FIGURES = (
    Figure(
        name="join_over_plan", heading="join over plan, %", decimals=1, scale=100.0, offset=-1.0
    ),
    Figure(
        name="join_over_promise",
        heading="join over promise, %",
        decimals=1,
        scale=100.0,
        offset=-1.0,
    ),
    Figure(
        name="join_over_last_promise",
        heading="join over last promise, %",
        decimals=1,
        scale=100.0,
        offset=-1.0,
    ),
    Figure(name="over_optimum_s", heading="join over optimum, s"),
    Figure(name="least_share", heading="least separation, d_min", decimals=4, low_is_worse=True),
    Figure(name="below_s", heading="below d_min, s"),
    Figure(name="silent_losses", heading="losses without a word"),
    Figure(name="shown_replans", heading="replans shown"),
    Figure(name="all_replans", heading="replans in all"),
    Figure(name="swing_deg", heading="heading turned, °"),
    Figure(name="extra_reversals", heading="bank reversals beyond the first plan's"),
    Figure(name="unplanned_reversals", heading="bank reversals beyond all plans'"),
    Figure(name="loops", heading="circles not planned"),
    Figure(name="lone_loops", heading="of these, leader turned < 180°"),
    Figure(name="heading_jump_deg", heading="jump of the held heading, °", decimals=1),
    Figure(name="cross_track_m", heading="off the plan's path, m"),
    Figure(name="off_announced_m", heading="off the announced path, m"),
    Figure(name="off_forecast_m", heading="off the forecast, m"),
    Figure(name="along_error_m", heading="off along the route, following, m"),
    Figure(name="across_error_m", heading="off beside the route, following, m"),
    Figure(name="late_share", heading="join after the autopilot's, %", decimals=2, scale=100.0),
    Figure(name="nearer_share", heading="nearer than the autopilot, d_min", decimals=4),
    Figure(
        name="within_bar_share",
        heading="within 2° of the bar, %",
        decimals=1,
        low_is_worse=True,
        scale=100.0,
    ),
    Figure(name="tube_m", heading="beside the path by hand, m"),
    Figure(name="off_autopilot_m", heading="off the autopilot's path, m"),
    Figure(name="fastest_mps", heading="fastest, m/s", decimals=1),
    Figure(name="cpu_s", heading="CPU, s", decimals=2),
)
"""In the order of the tables."""

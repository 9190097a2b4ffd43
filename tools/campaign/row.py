"""The figures of one flight, a line of JSON each, and the files that keep them."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from hashlib import sha256
from json import JSONDecodeError, dumps, loads
from pathlib import Path

import relguide


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
    shown_replans: int
    all_replans: int
    reversals: int
    """Of bank, until joined."""
    extra_reversals: int | None
    """Beyond those of the plan at engagement; `None` if there was none."""
    unplanned_reversals: int | None
    """Beyond those of all plans, each as far as it was flown; `None` if there was none."""
    loops: int
    """Full circles that neither the plans, as far as they were flown, nor the leader had."""
    lone_loops: int
    """Those of them during which the leader turned less than half a circle."""
    heading_jump_deg: float
    """Largest between held headings of two seconds without an announcement."""
    cross_track_m: float
    """Largest distance from the path of the last plan, while it is flown."""
    join_over_last_promise: float | None = None
    """The same from the plan last announced, and by its promise."""
    off_announced_m: float = 0.0
    """The same from the path last announced to the crew."""
    off_forecast_m: float | None = None
    """Largest distance from where the last forecast had the pursuer; `None` without one."""
    fastest_mps: float
    alerts: int
    cpu_s: float
    best_turn_share: float | None = None
    """What any turn begun at once keeps of d_min, for a flight that had no plan and lost it."""
    error: str = ""
    """What it ended with, if not with its last document."""

    @property
    def name(self) -> str:
        """As the command line takes it."""
        return f"{self.family} {self.number}"

    @property
    def silent_losses(self) -> int:
        """Losses that nothing announced."""
        return sum(loss.announced_s is None for loss in self.losses)

    @property
    def avoidable(self) -> bool:
        """Whether d_min was lost and need not have been."""
        return bool(self.losses) and (self.best_turn_share is None or self.best_turn_share >= 1.0)


def row_from(line: str) -> Row:
    """A row from its line.

    Raises:
        ValueError: if it is none.
    """
    try:
        content = loads(line)
        losses = tuple(Loss(**loss) for loss in content.pop("losses"))
        return Row(**content, losses=losses)
    except (JSONDecodeError, KeyError, TypeError) as broken:
        raise ValueError(f"This is no line of a campaign: {line[:60]}") from broken


def begin_file(file: Path) -> None:
    """Begin a file of rows, or make sure that it was begun by this version of the library.

    Raises:
        ValueError: if it was begun by another, whose flights are not the same.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists():
        file.write_text(dumps({"code": code_digest()}) + "\n")
        return
    read_rows(file)
    begun = loads(file.read_text().partition("\n")[0]).get("code")
    if begun != code_digest():
        raise ValueError(
            f"{file} was begun by another version of relguide: delete it, or name another."
        )


def read_rows(file: Path) -> list[Row]:
    """The rows of a file.

    A last line that was cut short, when the run was stopped, is taken off the file.

    Raises:
        ValueError: if it is a file of something else.
        OSError: if it cannot be read.
    """
    text = file.read_text()
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        file.write_text(whole)
    first, *lines = whole.splitlines() or [""]
    if not first.startswith('{"code"'):
        raise ValueError(f"{file} is no file of a campaign: it begins with {first[:60]!r}.")
    return [row_from(line) for line in lines]


def code_digest() -> str:
    """A digest of what decides how flights are flown and judged."""
    digest = sha256()
    for folder in (Path(relguide.__file__).parent, Path(__file__).parent):
        for source in sorted(folder.rglob("*.py")):
            digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def append_row(file: Path, row: Row) -> None:
    """Keep a row."""
    with file.open("a") as lines:
        lines.write(dumps(asdict(row)) + "\n")


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """A figure of rows that tables show."""

    name: str
    """Of the field or property of `Row`."""
    heading: str
    decimals: int = 0
    low_is_worse: bool = False
    scale: float = field(default=1.0)
    offset: float = field(default=0.0)

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
    Figure(name="least_share", heading="least separation, d_min", decimals=4, low_is_worse=True),
    Figure(name="below_s", heading="below d_min, s"),
    Figure(name="silent_losses", heading="losses without a word"),
    Figure(name="shown_replans", heading="replans shown"),
    Figure(name="all_replans", heading="replans in all"),
    Figure(name="extra_reversals", heading="bank reversals beyond the first plan's"),
    Figure(name="unplanned_reversals", heading="bank reversals beyond all plans'"),
    Figure(name="loops", heading="circles not planned"),
    Figure(name="lone_loops", heading="of these, leader turned < 180°"),
    Figure(name="heading_jump_deg", heading="jump of the held heading, °", decimals=1),
    Figure(name="cross_track_m", heading="off the plan's path, m"),
    Figure(name="off_announced_m", heading="off the announced path, m"),
    Figure(name="off_forecast_m", heading="off the forecast, m"),
    Figure(name="fastest_mps", heading="fastest, m/s", decimals=1),
    Figure(name="cpu_s", heading="CPU, s", decimals=2),
)
"""In the order of the tables."""

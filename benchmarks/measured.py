"""All that `make bench` measures, in one run."""

from dataclasses import dataclass, field

from benchmarks import detours, files, inference, network, network_batch, throughput, unlimited
from benchmarks.cases import Case, equal_cases, limited_cases, turning_cases, unlimited_cases
from benchmarks.detours import Contest
from benchmarks.inference import Rate
from benchmarks.network import Pair
from benchmarks.network_batch import Batch
from benchmarks.throughput import Throughput
from benchmarks.unlimited import Row


def _count(default: int, told: str) -> int:
    """A field of `Counts`, and what the command line tells of it."""
    count: int = field(default=default, metadata={"help": told})
    return count


@dataclass(frozen=True, slots=True, kw_only=True)
class Counts:
    """How much is measured."""

    fresh: int = _count(240, "situations drawn beside the golden ones, the limit left out")
    limited: int = _count(40, "drawn of each kind beside the golden ones, the limit active")
    batch: int = _count(500_000, "situations of a batch, the limit left out")
    limited_batch: int = _count(2048, "situations of a batch, the limit active")
    asked: int = _count(150, "situations of each kind that networks and plan() are asked")
    questions: int = _count(20_000, "questions for the network of branches alone")
    lines: int = _count(50_000, "situations of a file")


@dataclass(frozen=True, slots=True, kw_only=True)
class Results:
    """What was measured."""

    cases: list[Case]
    rows: dict[str, Row]
    """Without the limit, by contender."""
    groups: dict[str, list[Contest]]
    """Where it binds, by kind of situation."""
    batches: list[Throughput]
    pairs: dict[str, list[Pair]]
    """Networks beside plan(), by kind of situation."""
    network_batches: list[Batch]
    """The same situations at once."""
    rates: list[Rate]
    """The network of branches alone."""
    file_runs: list[files.Run]
    """From file to file, by the command."""

    @property
    def beaten(self) -> list[Contest]:
        """Where IPOPT found something better, the worst first."""
        return detours.won_by_ipopt([one for group in self.groups.values() for one in group])


def measure(counts: Counts) -> Results:
    """Some minutes; bars on standard error."""
    cases = unlimited_cases(counts.fresh)
    rows = unlimited.measure(cases)
    groups = {
        name: detours.measure(limited_cases(counts.limited, tight=tight), title=f"Limit, {name}")
        for name, tight in (("R > d_min", False), ("R < d_min", True))
    }
    groups["D = d_min"] = detours.measure(equal_cases(counts.limited), title="Limit, D = d_min")
    active = [contest.case for group in groups.values() for contest in group]
    groups["turning leader"] = detours.measure(
        turning_cases(counts.limited), title="Limit, turning leader"
    )
    batches = throughput.measure(counts.batch, counts.limited_batch, active)
    asked = network.draw_situations(counts.asked)
    return Results(
        cases=cases,
        rows=rows,
        groups=groups,
        batches=batches,
        pairs=network.measure(asked),
        network_batches=network_batch.measure(asked),
        rates=inference.measure(counts.questions),
        file_runs=files.measure(counts.lines),
    )

"""What became of every fault tried, kept as it happens, and the table made of it."""

import json
import tomllib
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from rich.table import Table

from tools.mutation.sampling import Mutant
from tools.mutation.workshop import Verdict, Workshop

EQUIVALENT = Path(__file__).with_name("equivalent.toml")
"""Faults looked at by hand that change nothing that matters, each with its reason."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """One fault and its verdict."""

    file: str
    line: int
    changed: tuple[str, ...]
    result: str
    """`"killed"`, `"timeout"`, `"survived"`, or `"equivalent"`: it survived, and may."""
    by: str


@dataclass(frozen=True, slots=True)
class Journal:
    """A file with a line of JSON for each fault tried, and for each module of tests timed."""

    file: Path

    def lines(self) -> list[dict[str, object]]:
        """What it holds so far."""
        text = self.file.read_text() if self.file.exists() else ""
        return [json.loads(line) for line in text.splitlines()]

    def judged(self) -> dict[str, Outcome]:
        """By the key of the mutant."""
        allowed = equivalent_faults()
        found: dict[str, Outcome] = {}
        for line in self.lines():
            if line["kind"] == "mutant":
                changed = tuple(map(str, line["changed"]))  # type: ignore[call-overload]
                survived = line["result"] == "survived"
                may = survived and (str(line["file"]), changed) in allowed
                found[str(line["key"])] = Outcome(
                    file=str(line["file"]),
                    line=int(str(line["line"])),
                    changed=changed,
                    result="equivalent" if may else str(line["result"]),
                    by=str(line["by"]),
                )
        return found

    def note(self, mutant: Mutant, verdict: Verdict) -> None:
        """Add a verdict."""
        self._add(
            kind="mutant",
            key=mutant.key,
            file=str(mutant.file),
            line=mutant.line,
            operator=mutant.operator,
            changed=mutant.changed,
            result=verdict.result,
            by=verdict.by,
            seconds=round(verdict.seconds, 1),
        )

    def note_times(self, workshop: Workshop) -> None:
        """Add the times that are new."""
        known = self.times()
        for (test, compiled), seconds in workshop.times.items():
            if (test, compiled) not in known:
                self._add(kind="time", test=str(test), compiled=compiled, seconds=seconds)

    def times(self) -> dict[tuple[Path, bool], float]:
        """How long tests take, as `Workshop` wants it."""
        return {
            (Path(str(line["test"])), bool(line["compiled"])): float(str(line["seconds"]))
            for line in self.lines()
            if line["kind"] == "time"
        }

    def _add(self, **line: object) -> None:
        self.file.parent.mkdir(parents=True, exist_ok=True)
        with self.file.open("a") as out:
            out.write(json.dumps(line, ensure_ascii=False) + "\n")


def equivalent_faults() -> set[tuple[str, tuple[str, ...]]]:
    """The faults that may survive: file and changed lines."""
    listed = tomllib.loads(EQUIVALENT.read_text()).get("equivalent", [])
    return {(one["file"], tuple(one["changed"])) for one in listed}


def score(outcomes: Iterable[Outcome]) -> tuple[int, int]:
    """How many were noticed, of how many that are no equivalents."""
    counted = [outcome for outcome in outcomes if outcome.result != "equivalent"]
    return sum(outcome.result != "survived" for outcome in counted), len(counted)


def table(outcomes: Iterable[Outcome]) -> Table:
    """The score of each file and of all."""
    by_file: defaultdict[str, list[Outcome]] = defaultdict(list)
    for outcome in outcomes:
        by_file[outcome.file].append(outcome)
    result = Table("file", "noticed", "tried", "equivalent", title="Faults put in, and noticed")
    everything = [one for some in by_file.values() for one in some]
    for name, some in [*sorted(by_file.items()), ("all", everything)]:
        noticed, counted = score(some)
        result.add_row(name, str(noticed), str(counted), str(len(some) - counted))
    return result


def survivors(outcomes: Iterable[Outcome]) -> list[str]:
    """Each fault nobody noticed: where, and what changed."""
    alive = sorted(
        (outcome for outcome in outcomes if outcome.result == "survived"),
        key=lambda outcome: (outcome.file, outcome.line),
    )
    return ["\n  ".join([f"{one.file}:{one.line}", *one.changed]) for one in alive]

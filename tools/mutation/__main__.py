"""Put small faults into the code, one at a time, and see whether the tests notice."""

import argparse
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

from rich.console import Console

from tools.mutation.chosen_tests import judges_of
from tools.mutation.named import NAMED
from tools.mutation.outcomes import Journal, survivors, table
from tools.mutation.sampling import Mutant, sample
from tools.mutation.workshop import Workshop

ROOT = Path(__file__).parents[2]
PLACES = [Path("relguide/planning"), Path("relguide/kernels")]


def main(arguments: list[str] | None = None) -> int:
    """Try a sample, or the named faults; 1 if a named one survives."""
    given = _parser().parse_args(arguments)
    console = Console(width=118, highlight=False)
    if given.named:
        mutants = [fault.mutant(ROOT) for fault in NAMED]
    else:
        mutants = sample(ROOT, given.place or PLACES, given.sample, given.seed)
    journal = Journal(given.journal)
    known = journal.judged()
    again = given.named or given.survivors
    waiting = [
        (mutant, [*judges_of(ROOT, mutant.file), *given.more_tests])
        for mutant in mutants
        if mutant.key not in known or (again and known[mutant.key].result == "survived")
    ]
    with tempfile.TemporaryDirectory(prefix="mutation-") as folder:
        workshop = Workshop(root=ROOT, folder=Path(folder), times=journal.times())
        workshop.open()
        try:
            _try(waiting, workshop, journal, console)
        except KeyboardInterrupt:
            console.print("Stopped; the same command goes on from here.")
    judged = journal.judged()
    outcomes = [judged[mutant.key] for mutant in mutants if mutant.key in judged]
    console.print(table(outcomes))
    for text in survivors(outcomes):
        console.print(text, markup=False, soft_wrap=True)
    return int(given.named and any(one.result == "survived" for one in outcomes))


def _try(
    mutants: Iterable[tuple[Mutant, Iterable[Path]]],
    workshop: Workshop,
    journal: Journal,
    console: Console,
) -> None:
    for mutant, tests in mutants:
        verdict = workshop.judge(mutant, list(tests))
        journal.note(mutant, verdict)
        journal.note_times(workshop)
        line = f"{mutant.file}:{mutant.line} {verdict.result} in {verdict.seconds:.0f} s"
        console.print(f"{line} {verdict.by}", markup=False, soft_wrap=True)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tools.mutation", description=__doc__)
    parser.add_argument("place", nargs="*", type=Path, help="folders or files (planning, kernels)")
    parser.add_argument("--sample", type=int, default=200, metavar="N", help="how many (200)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="which sample (1)")
    parser.add_argument("--named", action="store_true", help="try the faults that have a name")
    parser.add_argument(
        "--survivors", action="store_true", help="try those again that survived, as tests improve"
    )
    parser.add_argument(
        "--more-tests",
        nargs="+",
        type=Path,
        default=[],
        metavar="FILE",
        help="tests to run besides",
    )
    parser.add_argument(
        "--journal",
        type=Path,
        default=ROOT / ".make/mutation.jsonl",
        metavar="FILE",
        help="where outcomes are kept, and looked up (.make/mutation.jsonl)",
    )
    return parser


if __name__ == "__main__":
    sys.exit(main())

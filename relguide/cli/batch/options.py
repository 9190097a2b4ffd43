"""The options of `relguide plan --batch`, and the order that they make."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.cli.batch.order import FORMS, BatchOrder, form_of
from relguide.cli.shared_options import add_workers
from relguide.parallel.pool import count_cores
from relguide.planning.extras import need

if TYPE_CHECKING:
    from relguide.contract.answers import Include
    from relguide.contract.bulk import Fields

ALL: "tuple[Include, ...]" = ("alternatives", "optimality")
"""What `--fields full` includes."""
ONLY_HERE = {
    "out": "--out",
    "source_form": "--from",
    "out_form": "--to",
    "fields": "--fields",
    "processes": "--processes",
    "dask": "--dask",
    "resume": "--resume",
}
"""Options that a single situation does not have."""


def add_batch_options(parser: argparse.ArgumentParser) -> None:
    """What `relguide plan` may be given with `--batch`."""
    options = parser.add_argument_group("with --batch")
    options.add_argument(
        "--out",
        metavar="FILE",
        type=Path,
        help="write the answers there: .jsonl, .csv or .parquet; default: standard output",
    )
    options.add_argument(
        "--from",
        dest="source_form",
        choices=FORMS,
        help="how FILE is written; default: by its ending, JSON lines for any other",
    )
    options.add_argument("--to", dest="out_form", choices=FORMS, help="the same of the answers")
    options.add_argument(
        "--fields",
        choices=("times", "plan", "full"),
        help="times: status, time and bound of each; plan, the default: all of the plan; full: "
        "with alternatives and optimality, as --include adds them",
    )
    options.add_argument(
        "--resume",
        action="store_true",
        help="go on from FILE.part, which a stopped run leaves beside --out; the result is the "
        "same",
    )
    add_workers(options, "processes")


def refuse_batch_options(chosen: argparse.Namespace) -> None:
    """Refuse for a single situation what only a batch can be given.

    Raises:
        ValueError: naming it.
    """
    for name, option in ONLY_HERE.items():
        if getattr(chosen, name):
            raise ValueError(f"{option} is for a file of situations: add --batch.")


def order_of(chosen: argparse.Namespace) -> BatchOrder:
    """What is asked of a batch.

    Raises:
        ValueError: if the options contradict each other.
        MissingExtra: if pyarrow is not installed and needed.
    """
    source, to = (
        form_of(str(file or ""), form)
        for file, form in ((chosen.file, chosen.source_form), (chosen.out, chosen.out_form))
    )
    fields: Fields = chosen.fields or "plan"
    if "parquet" in (source, to):
        need("pyarrow")
    if chosen.table:
        raise ValueError("A batch is answered in rows: leave out --table.")
    if chosen.out is None and to == "parquet":
        raise ValueError("Parquet is not written to standard output: name a file by --out.")
    if chosen.out is None and chosen.resume:
        raise ValueError("Only a run with --out FILE leaves something to resume.")
    if chosen.out is not None and Path(chosen.file).resolve() == chosen.out.resolve():
        raise ValueError("The answers would take the place of the situations: change --out.")
    if fields == "times" and (chosen.include or chosen.prove):
        raise ValueError("Times have nothing that --include or --prove adds: leave these out.")
    return BatchOrder(
        source=source,
        to=to,
        fields=fields,
        include=ALL if fields == "full" else chosen.include,
        planner=chosen.planner,
        prove=chosen.prove,
        deadline=chosen.deadline,
    )


def cores_of(chosen: argparse.Namespace) -> int:
    """How many processes are to answer."""
    return int(chosen.processes or count_cores())

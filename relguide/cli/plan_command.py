"""`relguide plan`: the plan of a situation, or of each in a file."""

import argparse
import gc
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

from relguide.cli.batch.options import (
    add_batch_options,
    cores_of,
    order_of,
    refuse_batch_options,
)
from relguide.cli.output import DONE, FAILED, add_form, for_people, write_json
from relguide.cli.proving import compile_proofs, prove_after
from relguide.cli.shared_options import add_planner, seconds
from relguide.cli.situation_file import read_situation
from relguide.learn.planners import make_planner
from relguide.planning.extras import need

if TYPE_CHECKING:
    from relguide.contract.answers import Include
    from relguide.planning.outcome import Planner

PURPOSE = "plan a situation, or a file of them"
EXAMPLES = """
    relguide plan situation.json              a table; JSON off a terminal
    relguide plan situation.json --json       JSON wherever it goes
    cat situation.json | relguide plan -      from standard input
    relguide plan --batch situations.jsonl    one plan a line, in order
    relguide plan --batch all.csv --out answers.parquet --fields times
                                              from file to file, on all cores
    relguide plan --batch all.csv --out answers.parquet --fields times --resume
                                              going on after a stop
    relguide plan situation.json --include alternatives,optimality
                                              with what else there was, H and λ
    relguide plan situation.json --prove 10   with a better lower bound of its time
    relguide plan situation.json --compare    what four planners would fly, and what it costs
    relguide plan --batch all.jsonl --deadline 0.25
                                              the best found in 0.25 s each
    """


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide plan`."""
    parser.add_argument("file", metavar="FILE", help="a situation in JSON; - for standard input")
    parser.add_argument(
        "--batch",
        action="store_true",
        help="FILE has one situation a line: JSON lines, CSV or Parquet",
    )
    add_form(parser)
    parser.add_argument(
        "--prove",
        metavar="SECONDS",
        type=_proof_time,
        default=0.0,
        help="where d_min makes the plan longer, look this long for a better lower bound of its "
        "time, or for a faster plan",
    )
    parser.add_argument(
        "--deadline",
        metavar="SECONDS",
        type=_deadline,
        help="answer by then, with the best plan found and its bound, or with no_plan and the "
        "reason deadline; of a batch, each line; what --prove and --include ask for has what is "
        "left; the planners exact and network",
    )
    parser.add_argument(
        "--include",
        metavar="WHAT",
        type=_parse_include,
        default=(),
        help="alternatives: every other path to the slot and why it is not flown; optimality: how "
        "the plan meets Pontryagin's conditions, with H and λ along it; flown: when it joins if an "
        "aircraft flies it, and where; or some of them, with commas",
    )
    parser.add_argument(
        "--compare",
        action="store_true",
        help="the exact planner beside the networks, the paper's tree and the paper's network as "
        "printed: word, time, verdict and cost of each",
    )
    add_planner(parser)
    add_batch_options(parser)


def run(chosen: argparse.Namespace) -> int:
    """Plan, and print the answers."""
    if chosen.compare:
        if chosen.batch or chosen.prove or chosen.include or chosen.planner != "exact":
            raise ValueError(
                "--compare asks all planners about one situation: leave out --batch, --prove, "
                "--include and --planner."
            )
        refuse_batch_options(chosen)
        return _compare(chosen.file, chosen.deadline, table=for_people(chosen, "rich"))
    if chosen.batch:
        need("orjson")
        return _run(chosen)
    refuse_batch_options(chosen)
    with _no_collection():
        return _run(chosen)


@contextmanager
def _no_collection() -> Iterator[None]:
    """Look for no garbage: one plan leaves little, and what it loads would be searched in vain."""
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def _run(chosen: argparse.Namespace) -> int:
    planner = make_planner(chosen.planner)
    asked = AskedBeside(chosen.prove, chosen.include, chosen.deadline)
    if asked.prove:
        compile_proofs()
    if asked.deadline is not None:
        from relguide.planning.acceptance import takes_deadline

        if not takes_deadline(planner):
            raise ValueError(
                f"The planner {chosen.planner} keeps no deadline: choose exact or network."
            )
    if chosen.batch:
        order = order_of(chosen)
        from relguide.cli.batch.run import BatchWorkers, answer_file

        workers = BatchWorkers(cores_of(chosen), chosen.dask)
        return answer_file(chosen.file, chosen.out, order, workers, resume=chosen.resume)
    return _plan_one(chosen.file, planner, asked, table=for_people(chosen, "rich"))


class AskedBeside(NamedTuple):
    """What is asked for beside the plan, and by when."""

    prove: float
    """How long to look for a better lower bound [s]."""
    include: "Collection[Include]"
    deadline: float | None
    """Of each answer [s]."""


def _plan_one(file: str, planner: "Planner", asked: AskedBeside, *, table: bool) -> int:
    from relguide.contract.answers import answer, check_optimality, fly_plan
    from relguide.flying.cards import no_plan_card, plan_card
    from relguide.planning.outcome import NoPlan, Plan

    situation, anchor, body = read_situation(file)
    if asked.deadline is None:
        # loads the compiled kernels: that takes seconds, planning a tenth of a millisecond, and the
        # time measured is that of planning
        planner(situation)
    proving = prove_after(planner, asked.prove)
    if table:
        from relguide.cli.plan_tables import (
            print_flown,
            print_no_plan,
            print_optimality,
            print_plan,
        )
        from relguide.planning.acceptance import ask
        from relguide.planning.alternatives import alternatives
        from relguide.planning.cells import Cell
        from relguide.planning.deadline import end_of, left_until

        until = end_of(asked.deadline)
        match planned := ask(proving, situation, deadline=left_until(until)).plan:
            case NoPlan():
                print_no_plan(no_plan_card(planned))
            case Plan():
                wanted, left = "alternatives" in asked.include, left_until(until)
                others = alternatives(planned, deadline=left) if wanted else ()
                print_plan(plan_card(planned, others), min_separation=situation.min_separation)
                if "flown" in asked.include:
                    print_flown(fly_plan(planned, proving, until))
                if "optimality" in asked.include:
                    cells = any(isinstance(other, Cell) for other in situation.others)
                    print_optimality(check_optimality(planned), cells=cells)
        return DONE if isinstance(planned, Plan) else FAILED
    reply = answer(situation, anchor, proving, include=asked.include, deadline=asked.deadline)
    name = {"id": body.id} if "id" in body.model_fields_set else {}
    write_json(name | reply)
    return DONE if reply["status"] == "planned" else FAILED


def _compare(file: str, deadline: float | None, *, table: bool) -> int:
    from relguide.contract.bodies import path_to_wire
    from relguide.learn.comparison import compare

    situation, anchor, body = read_situation(file)
    found = compare(situation, deadline=deadline)
    if table:
        from relguide.cli.plan_tables import print_verdicts

        print_verdicts(found)
    else:
        name = {"id": body.id} if "id" in body.model_fields_set else {}
        write_json(name | {"planners": [path_to_wire(verdict, anchor) for verdict in found]})
    return DONE if found[0].status == "planned" else FAILED


def _parse_include(text: str) -> "tuple[Include, ...]":
    from relguide.contract.answers import read_include

    try:
        return read_include(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _proof_time(text: str) -> float:
    from relguide.planning.prove import MAX_SECONDS

    return seconds(text, 0.0, MAX_SECONDS)


def _deadline(text: str) -> float:
    from relguide.planning.deadline import MAX_DEADLINE

    return seconds(text, 0.0, MAX_DEADLINE)

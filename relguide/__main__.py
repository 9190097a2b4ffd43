"""The command line: `relguide plan`, `fly`, `serve`, `dataset`, `train`, `audit` and others.

What a command needs is loaded when it runs, so that `--help` answers at once.
"""

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from functools import partial
from textwrap import dedent
from typing import TYPE_CHECKING

from relguide import __version__
from relguide.cli.learning_options import add_learning
from relguide.cli.output import say
from relguide.planning.extras import MissingExtra, with_command

DONE, FAILED, MISUSE, STOPPED = 0, 1, 2, 130
"""Exit codes: done; no plan or a failed check; misuse; stopped by Ctrl-C, as shells number it."""
PLANNERS = ("exact", "network", "regular_dp")
"""Planners of the contract."""

if TYPE_CHECKING:
    from relguide.contract.answers import Include

Run = Callable[[argparse.Namespace], int]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Args:
        arguments: what follows the program's name; those of this process if left out.

    Returns:
        the exit code.
    """
    chosen = _parser().parse_args(arguments)
    run: Run = chosen.run
    try:
        code = run(chosen)
        sys.stdout.flush()
    except BrokenPipeError:  # whoever read our output has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except OSError as error:
        where = error.filename if isinstance(error.filename, str) else "Reading or writing"
        return _refuse(f"{where}: {error.strerror or error}.")
    except ValueError as error:  # every refusal of the library is one, with a sentence
        return _refuse(str(error))
    except ModuleNotFoundError as error:
        missing = with_command(error)
        if missing is error and not isinstance(error, MissingExtra):
            raise
        return _refuse(str(missing))
    except KeyboardInterrupt:
        sys.stderr.write("\nrelguide: stopped.\n")
        return STOPPED
    return code


def _refuse(sentence: str) -> int:
    say(sentence)
    return MISUSE


def _plan(chosen: argparse.Namespace) -> int:
    from relguide.cli.running import plan_batch, plan_one

    _compile_first()
    if chosen.batch and chosen.table:
        raise ValueError("A batch is answered in JSON, a plan a line: leave out --table.")
    if chosen.batch:
        invalid = plan_batch(
            chosen.file,
            planner_name=chosen.planner,
            include=chosen.include,
            prove_for=chosen.prove,
        )
        return FAILED if invalid else DONE
    planned = plan_one(
        chosen.file,
        planner_name=chosen.planner,
        table=chosen.table,
        include=chosen.include,
        prove_for=chosen.prove,
    )
    return DONE if planned else FAILED


def _check(chosen: argparse.Namespace) -> int:
    from relguide.cli.running import check_one

    if chosen.situation == chosen.triplets == "-":
        raise ValueError("Only one of the two files can come from standard input.")
    passed = check_one(chosen.situation, chosen.triplets, table=chosen.table, figure=chosen.figure)
    return DONE if passed else FAILED


def _fly(chosen: argparse.Namespace) -> int:
    from relguide.cli.running import fly_one

    _compile_first()
    passed = fly_one(
        chosen.scenario,
        planner_name=chosen.planner,
        record_to=chosen.record,
        seed=chosen.seed,
        as_json=chosen.json,
    )
    return DONE if passed else FAILED


def _replay(chosen: argparse.Namespace) -> int:
    from relguide.cli.running import replay_one

    return DONE if replay_one(chosen.file, as_json=chosen.json) else FAILED


def _serve(chosen: argparse.Namespace) -> int:
    from relguide.cli.running import serve

    serve(host=chosen.host, port=chosen.port)
    return DONE


def _compile_first() -> None:
    """Where installation has not compiled the kernels, who waits for them sees a bar."""
    if sys.stderr.isatty():
        from relguide.warm_up import warm_up

        warm_up()


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdigit() and int(text[:12]) < 2**32):
        raise argparse.ArgumentTypeError(f"must be a whole number from 0 to 2³² − 1, not {text}")
    return int(text)


def _included(text: str) -> "tuple[Include, ...]":
    from relguide.contract.answers import read_include

    try:
        return read_include(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _proof_time(text: str) -> float:
    from relguide.planning.prove import check_seconds

    try:
        seconds = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a number of seconds, not {text}") from None
    try:
        check_seconds(seconds)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    return seconds


def _port(text: str) -> int:
    if not (text.isascii() and text.isdigit() and 0 < int(text[:12]) < 2**16):
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 to 65535, not {text}")
    return int(text)


def _recording(text: str) -> str:
    from relguide.contract.recorder import check_name

    try:
        check_name(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
    return text


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="relguide",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Minimum-time relative guidance: join a leader's track, never too close.",
        epilog="exit codes: 0 done, 1 no plan or a failed check, 2 misuse\n\n"
        "relguide COMMAND --help shows examples.",
    )
    parser.add_argument("--version", action="version", version=f"relguide {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    plan = _command(
        commands,
        "plan",
        _plan,
        "plan a situation, or a file of them",
        """
        relguide plan situation.json              the plan as JSON
        relguide plan situation.json --table      the same for people
        cat situation.json | relguide plan -      from standard input
        relguide plan --batch situations.jsonl    one plan a line, in order
        relguide plan situation.json --include alternatives,optimality
                                                  with what else there was, H and λ
        relguide plan situation.json --prove 10   with a better lower bound of its time
        """,
    )
    plan.add_argument("file", metavar="FILE", help="a situation in JSON; - for standard input")
    plan.add_argument("--batch", action="store_true", help="FILE has a situation a line")
    plan.add_argument("--table", action="store_true", help="print tables for people")
    plan.add_argument(
        "--prove",
        metavar="SECONDS",
        type=_proof_time,
        default=0.0,
        help="look so long for a better lower bound of the time, where the limit costs some",
    )
    plan.add_argument(
        "--include",
        metavar="WHAT",
        type=_included,
        default=(),
        help="alternatives: every other way to the slot and why it is not flown; optimality: how "
        "the plan meets Pontryagin's conditions, with H and λ along it; or both, with a comma",
    )
    _add_planner(plan)

    check = _command(
        commands,
        "check",
        _check,
        "judge a regular trajectory, given as the paper's triplets (ε, θ, l)",
        """
        relguide check situation.json triplets.json          what holds of it, as JSON
        relguide check situation.json triplets.json --table  the same for people
        relguide check situation.json --figure plan.svg      the fastest plan's own, drawn

        Triplets are numbered backward from the slot, the one flown last comes first:
        {"triplets": [{"epsilon": 1, "theta_deg": 3.2, "l_m": 0},
                      {"epsilon": -1, "theta_deg": 43.4, "l_m": 267000}]}
        epsilon 1 turns left, -1 right; l_m is the straight after the turn.
        """,
    )
    check.add_argument(
        "situation", metavar="SITUATION", help="a situation in JSON; - for standard input"
    )
    check.add_argument(
        "triplets",
        metavar="TRIPLETS",
        nargs="?",
        default="",
        help="triplets in JSON; left out: those of the fastest plan",
    )
    check.add_argument("--table", action="store_true", help="print tables for people")
    check.add_argument("--figure", metavar="FILE.svg", default="", help="draw both tracks")

    fly = _command(
        commands,
        "fly",
        _fly,
        "fly a scenario, a situation or behind a recorded track",
        """
        relguide fly fig_6b                          the paper's figure with intent
        relguide fly fig_6a --json                   without; the figures as JSON
        relguide fly situation.json --record a.jsonl your own situation, recorded
        relguide fly track.csv                       behind a recorded ADS-B track
        """,
    )
    fly.add_argument(
        "scenario", metavar="SCENARIO|FILE", help="a scenario's name, a .json or a .csv file"
    )
    fly.add_argument(
        "--record", metavar="FILE", type=_recording, help="write a .jsonl or .jsonl.gz recording"
    )
    fly.add_argument("--seed", metavar="N", type=_seed, default=0, help="default: 0")
    fly.add_argument("--json", action="store_true", help="print one JSON object")
    _add_planner(fly)

    replay = _command(
        commands,
        "replay",
        _replay,
        "tell what a recording holds",
        """
        relguide replay flight.jsonl           what happened, when and why
        relguide replay flight.jsonl --json    the figures as JSON
        """,
    )
    replay.add_argument("file", metavar="FILE", help="made by relguide fly --record")
    replay.add_argument("--json", action="store_true", help="print one JSON object")

    serve = _command(
        commands,
        "serve",
        _serve,
        "start the service and the cockpit",
        """
        relguide serve                            on http://127.0.0.1:8000
        relguide serve --host 0.0.0.0 --port 80   for other machines too
        """,
    )
    serve.add_argument("--host", default="127.0.0.1", help="default: %(default)s")
    serve.add_argument("--port", type=_port, default=8000, help="default: %(default)s")

    add_learning(partial(_command, commands))
    return parser


def _command(
    commands: "argparse._SubParsersAction[argparse.ArgumentParser]",
    name: str,
    run: Run,
    purpose: str,
    examples: str,
) -> argparse.ArgumentParser:
    parser = commands.add_parser(
        name,
        help=purpose,
        description=f"{purpose[0].upper()}{purpose[1:]}.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="examples:" + dedent(examples).replace("\n", "\n  ").rstrip(),
    )
    parser.set_defaults(run=run)
    return parser


def _add_planner(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--planner",
        choices=PLANNERS,
        default="exact",
        help="network: it picks the words to solve; regular_dp: the paper's tree does; "
        "default: exact",
    )


if __name__ == "__main__":
    sys.exit(main())

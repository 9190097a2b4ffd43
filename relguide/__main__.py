"""The command line: `relguide plan`, `fly`, `serve`, `dataset`, `train`, `audit` and others.

Each command is a file of `relguide/cli`; here they are given their names, run and ended.
"""

import argparse
import atexit
import gc
import os
import re
import sys
from collections.abc import Sequence
from difflib import get_close_matches
from textwrap import dedent
from typing import Protocol

from relguide import __version__
from relguide.cli import (
    area_command,
    audit_command,
    campaign_command,
    check_command,
    claims_command,
    dataset_command,
    figures_command,
    fly_command,
    picture_command,
    plan_command,
    replay_command,
    serve_command,
    train_command,
    warm_up_command,
)
from relguide.cli.output import FAILED, MISUSE, STOPPED, command_for, say


class CommandFile(Protocol):
    """A file of `relguide/cli` that is a command."""

    PURPOSE: str
    EXAMPLES: str

    def add_options(self, parser: argparse.ArgumentParser) -> None:
        """Add what it may be given."""

    def run(self, chosen: argparse.Namespace) -> int:
        """Do it; the exit status."""


COMMANDS: dict[str, CommandFile] = {
    "plan": plan_command,
    "check": check_command,
    "fly": fly_command,
    "replay": replay_command,
    "picture": picture_command,
    "campaign": campaign_command,
    "serve": serve_command,
    "dataset": dataset_command,
    "train": train_command,
    "audit": audit_command,
    "area": area_command,
    "figures": figures_command,
    "claims": claims_command,
    "warm-up": warm_up_command,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command.

    Args:
        arguments: what follows the program's name; those of this process if left out.

    Returns:
        the exit status.
    """
    given = sys.argv[1:] if arguments is None else arguments
    for stream in ("stdout", "stderr"):
        if getattr(sys, stream) is None:  # it was closed: what is written goes nowhere
            setattr(sys, stream, open(os.devnull, "w"))
    atexit.register(gc.freeze)  # what is loaded is not searched for garbage as it ends: 0.2 s
    try:
        chosen = _parse(given)
        status = COMMANDS[chosen.command].run(chosen)
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
        sentence = command_for(error)
        if sentence is None:
            raise
        return _refuse(sentence)
    except KeyboardInterrupt:
        sys.stderr.write("\nrelguide: stopped.\n")
        return STOPPED
    return status


def _refuse(sentence: str) -> int:
    say(sentence)
    return MISUSE


def _parse(given: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="relguide",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Minimum-time relative guidance: join a leader's track, never too close.",
        epilog="exit status: 0 done, 1 no plan or a failed check, 2 misuse\n\n"
        "relguide COMMAND --help shows examples.",
    )
    parser.add_argument("--version", action="version", version=f"relguide {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", dest="command")
    for name, command in COMMANDS.items():
        purpose = command.PURPOSE
        added = commands.add_parser(
            name,
            help=purpose,
            description=f"{purpose[0].upper()}{purpose[1:]}.",
            formatter_class=argparse.RawDescriptionHelpFormatter,
            epilog="examples:" + dedent(command.EXAMPLES).replace("\n", "\n  ").rstrip(),
        )
        if name in given:  # the options of some take a quarter of a second to be known
            command.add_options(added)
    chosen, unknown = parser.parse_known_args(given)
    for option in unknown:
        known = re.findall(r"--[a-z][a-z-]*", commands.choices[chosen.command].format_help())
        near = get_close_matches(option.partition("=")[0], known, n=1)
        meant = f": is {near[0]} meant?" if near else "."
        parser.error(f"relguide {chosen.command} does not know {option}{meant}")
    return chosen


if __name__ == "__main__":
    sys.exit(main())

"""What commands print, their exit statuses, and what the files they make say of their origin."""

import argparse
import sys
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

from relguide.planning.extras import MissingExtra, add_command, is_installed, need

DONE, FAILED, MISUSE, STOPPED = 0, 1, 2, 130
"""Exit statuses: done; no plan or a failed check; misuse; stopped by Ctrl-C, as shells number it.
"""


def add_form(parser: argparse.ArgumentParser) -> None:
    """Let it be chosen how the result is printed: `for_people` takes what is chosen."""
    form = parser.add_mutually_exclusive_group()
    form.add_argument(
        "--json", action="store_true", help="print one JSON object, as off a terminal"
    )
    form.add_argument("--table", action="store_true", help="print it for people, as on a terminal")


def for_people(chosen: argparse.Namespace, *packages: str) -> bool:
    """Whether to print for people: as asked, else on a terminal, where it can be.

    Args:
        chosen: what was chosen of the options of `add_form`.
        packages: that the tables are drawn with.

    Raises:
        MissingExtra: if tables are asked for and one of the packages is not installed.
    """
    if chosen.table:
        need(*packages)
        return True
    return not chosen.json and sys.stdout.isatty() and all(map(is_installed, packages))


def write(text: str) -> None:
    """Write to standard output, and at once: whoever reads it may wait for a line."""
    sys.stdout.write(text)
    sys.stdout.flush()


def write_json(content: Mapping[str, Any]) -> None:
    """Write an object, indented, to standard output."""
    from pydantic_core import to_json

    write(to_json(content, indent=2, inf_nan_mode="null").decode() + "\n")


def say(sentence: str) -> None:
    """Give people a sentence beside the result: on standard error."""
    sys.stderr.write(f"relguide: {sentence}\n")
    sys.stderr.flush()


def command_for(error: ModuleNotFoundError) -> str | None:
    """The sentence with the command that brings a missing package, if an extra of ours does."""
    missing = add_command(error)
    return str(missing) if isinstance(missing, MissingExtra) else None


def program_name() -> str:
    """What makes a file: our name and version."""
    from importlib.metadata import version  # half of the time that `--help` would take

    return f"relguide {version('relguide')}"


def provenance(method: str, **more: str) -> dict[str, str]:
    """Who makes a data set, how and when.

    Args:
        method: of `relguide dataset`.
        more: what else to record, for example the command.
    """
    from importlib.metadata import version  # half of the time that `--help` would take

    return {
        "program": program_name(),
        "method": method,
        **more,
        "made": datetime.now(UTC).isoformat(timespec="seconds"),
        "numpy": version("numpy"),
    }

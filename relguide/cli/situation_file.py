"""Situations as commands are given them: in a file, or on standard input."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING

if TYPE_CHECKING:
    from relguide.contract.bodies import NamedSituationBody
    from relguide.contract.places import Anchor
    from relguide.flying.flight import Scenario
    from relguide.planning.situation import Situation


@contextmanager
def open_input(file: str) -> Iterator[IO[bytes]]:
    """Open a file to read; `-` is standard input, which stays open."""
    if file == "-":
        if sys.stdin is None:
            raise ValueError("Standard input is closed: name a file, or pipe the situation in.")
        yield sys.stdin.buffer
    else:
        with Path(file).open("rb") as stream:
            yield stream


def read_situation(file: str) -> tuple["Situation", "Anchor", "NamedSituationBody"]:
    """Read one situation.

    Args:
        file: its path; - for standard input.

    Returns:
        the situation, where on the earth it is, and what was read.

    Raises:
        ValueError: if it is no situation, saying what would be right.
    """
    from relguide.contract.bodies import NamedSituationBody, situation_from_body
    from relguide.contract.refusal import parse

    with open_input(file) as stream:
        body = parse(NamedSituationBody, stream.read())
    return *situation_from_body(body), body


def read_flight(file: str) -> "Scenario":
    """Read a situation, and in what air and how well seen it is flown.

    Args:
        file: its path; - for standard input.

    Raises:
        ValueError: if it is none, or cannot be flown, saying what would be right.
    """
    from relguide.contract.flown_bodies import FlownSituationBody, scenario_from_body
    from relguide.contract.refusal import parse

    with open_input(file) as stream:
        body = parse(FlownSituationBody, stream.read())
    return scenario_from_body(body)[0]

"""Situations as commands are given them: in a file, or on standard input."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING

from relguide.cli.output import say
from relguide.units import NM

if TYPE_CHECKING:
    from relguide.contract.bodies import NamedSituationBody, SituationBody
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
        content = stream.read()
    _refuse_lines(content, file)
    body = parse(NamedSituationBody, content)
    _ask_about_miles(body)
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
        content = stream.read()
    _refuse_lines(content, file)
    body = parse(FlownSituationBody, content)
    _ask_about_miles(body)
    return scenario_from_body(body)[0]


def _refuse_lines(content: bytes, file: str) -> None:
    """Refuse a file of several situations, each of which is JSON by itself."""
    lines = content.split(b"\n", 2)
    if len(lines) > 1 and all(line.strip()[:1] + line.strip()[-1:] == b"{}" for line in lines[:2]):
        raise ValueError(
            f"{file} has a situation a line: relguide plan --batch plans them all; here, give one."
        )


def _ask_about_miles(body: "SituationBody") -> None:
    """Say which distances are as few metres as they would be nautical miles."""
    from relguide.planning.limits import MOST_MILES

    for name in ("slot_distance_m", "min_separation_m"):
        distance: float = getattr(body, name)
        if 0.0 < distance <= MOST_MILES:
            say(f"{name} is {distance:g} m. If {distance:g} NM are meant: {distance * NM:g}.")

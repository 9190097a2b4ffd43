"""Labels are asked for by a request, and made in chunks: each a function of it and its number."""

from typing import Protocol

import numpy as np


class Request(Protocol):
    """What every request says, whatever it asks for."""

    @property
    def count(self) -> int:
        """Labels in all."""

    @property
    def seed(self) -> int:
        """The same request gives the same labels."""

    @property
    def shares(self) -> tuple[float, ...]:
        """Of the sources, in their order."""

    @property
    def chunk(self) -> int:
        """Labels made at a time."""


def check_request(request: Request) -> None:
    """Refuse what is no request.

    Raises:
        ValueError: saying what it must be.
    """
    if request.count < 1 or request.chunk < 1 or request.seed < 0:
        raise ValueError(
            "count and chunk must be whole numbers of 1 or more, and seed of 0 or more; not "
            f"{request.count}, {request.chunk} and {request.seed}."
        )
    if not (min(request.shares) >= 0.0 and abs(sum(request.shares) - 1.0) < 1e-9):
        raise ValueError(f"shares must be 0 or more and sum up to 1, not {request.shares}.")


def check_ratios(least: float, largest: float) -> None:
    """Refuse speed ratios that hold nothing, or with which the slot may be out of reach.

    Raises:
        ValueError: saying what they must be.
    """
    if not 0.0 <= least <= largest < 1.0:
        raise ValueError(
            f"Speed ratios must rise from 0 and stay below 1, not {least:g} … {largest:g}."
        )


def chunks_of(request: Request) -> int:
    """How many chunks there are."""
    return -(-request.count // request.chunk)


def begin_chunk(request: Request, number: int) -> tuple[np.random.Generator, list[int]]:
    """What a chunk draws from, and how many of its labels are of each source."""
    rng = np.random.default_rng(np.random.SeedSequence(request.seed, spawn_key=(number,)))
    size = min(request.chunk, request.count - number * request.chunk)
    rest = [round(size * share) for share in request.shares[1:]]
    return rng, [size - sum(rest), *rest]

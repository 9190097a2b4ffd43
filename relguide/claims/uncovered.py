"""Numbers of README and docs that no claim checks: the rows of `uncovered.toml`."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files


@dataclass(frozen=True, kw_only=True)
class Uncovered:
    """Words that tell numbers and are no claim, for one reason.

    Attributes:
        reason: why no command checks them.
        measured: whether the numbers were measured, and no test holds them either.
        words: by the page that tells them, from the folder of the project.
    """

    reason: str
    measured: bool
    words: Mapping[str, tuple[str, ...]]


@cache
def all_uncovered() -> tuple[Uncovered, ...]:
    """Every row of `uncovered.toml`, in its order."""
    content = tomllib.loads(files(__package__).joinpath("uncovered.toml").read_text("utf-8"))
    return tuple(
        Uncovered(
            reason=row["reason"],
            measured=row["measured"],
            words={page: tuple(words) for page, words in row["words"].items()},
        )
        for row in content["uncovered"]
    )

"""Which faults are tried: drawn at random, from every file as many as its length deserves."""

import random
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import unified_diff
from hashlib import sha256
from pathlib import Path

from tools.mutation.operators import Edit, edits


@dataclass(frozen=True, slots=True, kw_only=True)
class Mutant:
    """One file with one fault in it."""

    file: Path
    """From the repository's root."""
    line: int
    operator: str
    text: bytes
    """The whole file."""
    changed: tuple[str, ...]
    """The lines that go, each after a minus, and those that come, after a plus."""

    @property
    def key(self) -> str:
        """The same for the same fault in the same text."""
        return sha256(str(self.file).encode() + b"\0" + self.text).hexdigest()[:16]


def mutant(root: Path, file: Path, edit: Edit) -> Mutant:
    """The file with this edit made."""
    source = (root / file).read_bytes()
    text = edit.apply(source)
    old, new = source.decode().splitlines(), text.decode().splitlines()
    diff = list(unified_diff(old, new, n=0, lineterm=""))[3:]
    return Mutant(
        file=file,
        line=source.count(b"\n", 0, edit.start) + 1,
        operator=edit.operator,
        text=text,
        changed=tuple(f"{line[0]} {line[1:].strip()}" for line in diff),
    )


def sample(root: Path, places: Iterable[Path], count: int, seed: int) -> list[Mutant]:
    """The first so many of all faults in a random order in which each file's are spread evenly.

    So the first part of a sample is a smaller sample, and a larger one goes on from it.
    """
    order: list[tuple[float, Path, Edit]] = []
    for file in sources(root, places):
        # a file's draw does not depend on what other files hold
        rng = random.Random(f"{seed} {file}")
        found = edits((root / file).read_bytes())
        rng.shuffle(found)
        order += [((i + rng.random()) / len(found), file, edit) for i, edit in enumerate(found)]
    order.sort(key=lambda one: one[0])
    return [mutant(root, file, edit) for _, file, edit in order[:count]]


def sources(root: Path, places: Iterable[Path]) -> list[Path]:
    """All source files under these folders, or these files, from the root."""
    found: set[Path] = set()
    for place in places:
        if not (root / place).exists():
            raise FileNotFoundError(f"there is no {place} to put faults into")
        found.update([place] if (root / place).is_file() else _below(root, place))
    return sorted(found)


def _below(root: Path, place: Path) -> list[Path]:
    return [file.relative_to(root) for file in (root / place).rglob("*.py")]

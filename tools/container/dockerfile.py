"""The Dockerfile as it is written: its instructions, and what `COPY . .` takes."""

import re
import subprocess
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path

ROOT = Path(__file__).parents[2]


def steps() -> Iterator[tuple[str, str]]:
    """Its instructions in order, one of several lines as one: name, and what follows it."""
    text = re.sub(r"^#.*\n", "", (ROOT / "Dockerfile").read_text(), flags=re.MULTILINE)
    for line in text.replace("\\\n", " ").splitlines():
        if line.strip():
            name, _, rest = line.partition(" ")
            yield name, " ".join(rest.split())


def ignored() -> list[str]:
    """The patterns of `.dockerignore`."""
    lines = (ROOT / ".dockerignore").read_text().splitlines()
    return [line for line in lines if line[:1] not in ("", "#")]


def copied() -> list[Path]:
    """The files that `COPY . .` takes, by `.dockerignore`; of those that git would take."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, capture_output=True, text=True, check=True,
    ).stdout.splitlines()  # fmt: skip
    return [Path(name) for name in listed if _is_copied(name) and (ROOT / name).is_file()]


def _is_copied(name: str) -> bool:
    parts = name.split("/")
    prefixes = ["/".join(parts[: k + 1]) for k in range(len(parts))]
    left_out = False
    for pattern in ignored():
        said = pattern.removeprefix("!")
        deep = said.removeprefix("**/")
        if any(fnmatch(p, said) for p in prefixes) or (deep != said and deep in parts):
            left_out = not pattern.startswith("!")
    return not left_out

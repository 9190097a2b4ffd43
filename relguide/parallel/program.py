"""program(): what tells one version of the program from another."""

from functools import cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path

PACKAGES = ("relguide", "numpy", "numba")
"""What the last digits of a result depend on."""
PARTS_OF_IT = ("campaign", "cli/batch", "contract", "flying", "kernels", "learn", "planning")
"""The folders whose code makes parts."""


@cache
def program() -> tuple[tuple[str, str], ...]:
    """The program here: packages with their versions, and a fingerprint of our own code."""
    found = sha256()
    here = Path(__file__).parents[1]
    for folder in PARTS_OF_IT:
        for file in sorted((here / folder).rglob("*.py")):
            found.update(file.relative_to(here).as_posix().encode() + file.read_bytes())
    versions = {name: version(name) for name in PACKAGES}
    return (*versions.items(), ("its code", found.hexdigest()[:12]))

"""Which test modules judge a source file: those nearest to it, and the golden answers."""

import ast
from functools import cache
from pathlib import Path

LIBRARY, TESTS = Path("relguide"), Path("tests")
GOLDEN = TESTS / "relguide/planning/test_golden.py"
APART = {"test_warm_up.py", "test_readme.py"}
"""They compile everything, or start processes that do."""
ENOUGH, MOST = 3, 4
"""Importers are followed upward until so many modules are found, and at most so many are taken."""


@cache
def judges_of(root: Path, source: Path) -> tuple[Path, ...]:
    """The test modules for one file, nearest first: its own, those of what imports it, golden.

    Nearest is the test of the same name, then tests that import the file, then the tests of the
    same names as the files that import it, then those of what imports these, and so on; those of
    planning and kernels come before the rest.
    """
    found = list(_own(root, source))
    found += [test for test, names in _imports(root, TESTS).items() if _module(source) in names]
    reached = {source}
    level = [source]
    while level and len(set(found)) < ENOUGH:
        wanted = {_module(file) for file in level}
        level = [
            file
            for file, names in _imports(root, LIBRARY).items()
            if file not in reached and wanted & names
        ]
        reached.update(level)
        found += [test for file in level for test in _own(root, file)]
    nearest = [test for test in dict.fromkeys(found) if test.name not in APART]
    nearest[1:] = sorted(nearest[1:], key=lambda test: test.parts[2] not in ("planning", "kernels"))
    return tuple(dict.fromkeys([*nearest[:MOST], GOLDEN]))


def _own(root: Path, source: Path) -> list[Path]:
    test = TESTS / source.parent / f"test_{source.name}"
    return [test] if (root / test).exists() else []


def _module(file: Path) -> str:
    return ".".join(file.with_suffix("").parts)


@cache
def _imports(root: Path, place: Path) -> dict[Path, set[str]]:
    """What each file of a folder imports; of tests those of the library."""
    inside = place / "relguide" if place == TESTS else place
    pattern = "test_*.py" if place == TESTS else "*.py"
    files = [file.relative_to(root) for file in sorted((root / inside).rglob(pattern))]
    return {file: _names(root / file) for file in files}


def _names(file: Path) -> set[str]:
    found: set[str] = set()
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{name.name}" for name in node.names)}
        elif isinstance(node, ast.Import):
            found |= {name.name for name in node.names}
    return found

"""Run the examples as a user would: from a wheel, in an empty environment.

python -m tests.examples --python python3.12 --python python3.13
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.examples.test_examples import EXAMPLES, FOLDER, SAYS

EXTRAS = "figures,serve"


def main() -> int:
    """Build the wheel, then install and run in a fresh environment of each interpreter.

    Returns:
        0, or 1 if an example failed.
    """
    parser = argparse.ArgumentParser(prog="python -m tests.examples", description=__doc__)
    parser.add_argument("--python", action="append", help="an interpreter; default: this one")
    chosen = parser.parse_args()
    failed = False
    with TemporaryDirectory() as folder:
        wheel = _build(Path(folder))
        for python in chosen.python or [sys.executable]:
            failed |= not _run(python, wheel, Path(folder) / Path(python).name)
    return int(failed)


def _build(folder: Path) -> Path:
    subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "--no-deps", "-q", "-w", folder, FOLDER.parent],
        env=os.environ | {"RELGUIDE_SKIP_WEB": "1"},
        check=True,
    )
    (wheel,) = folder.glob("*.whl")
    return wheel


def _run(python: str, wheel: Path, place: Path) -> bool:
    subprocess.run([python, "-m", "venv", place], check=True)
    own = place / "bin" / "python"
    subprocess.run([own, "-m", "pip", "install", "-q", f"{wheel}[{EXTRAS}]"], check=True)
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    passed = True
    for example in EXAMPLES:
        file, said = SAYS[example.stem]
        done = subprocess.run(
            [own, example], cwd=place, env=clean, capture_output=True, text=True, check=False
        )
        good = done.returncode == 0 and said in done.stdout and (place / file).exists()
        sys.stdout.write(f"{python} {example.stem}: {'done' if good else 'FAILED'}\n")
        if not good:
            sys.stdout.write(done.stdout + done.stderr)
        passed &= good
    return passed


if __name__ == "__main__":
    sys.exit(main())

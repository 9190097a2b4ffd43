"""The command line in tests: files to give it, and running it as a process of its own."""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.bodies import BODY, change

Run = Callable[..., tuple[int, str, str]]
"""What the fixture `run` gives: exit code, standard output, standard error of a command."""
NEAR = {
    "pursuer": {**BODY["pursuer"], "x_m": -20000, "y_m": 3000},
    "leader": {**BODY["leader"], "intent": []},
    "slot_distance_m": 10000,
    "min_separation_m": 9260,
}
UNREACHABLE = change("leader.tas_mps", 300)


def write(content: Any, name: str = "situation.json") -> str:
    Path(name).write_text(content if isinstance(content, str) else json.dumps(content), "utf-8")
    return name


def process(*arguments: str, input: str = "") -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "relguide", *arguments],
        input=input,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )

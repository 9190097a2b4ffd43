"""An image from the Dockerfile, step by step, each in a root of its own."""

import json
import re
import shlex
import shutil
import subprocess
import sys
from dataclasses import asdict, dataclass, field
from pathlib import Path

import yaml

from tools.container.debian import layer, lift, run_in
from tools.container.dockerfile import ROOT, copied, steps


@dataclass(slots=True)
class Stage:
    """What one `FROM` begins."""

    root: Path
    """Where its files are."""
    environment: dict[str, str] = field(default_factory=dict)
    folder: str = "/"
    said: dict[str, str] = field(default_factory=dict)
    """Instructions that change no file, by name."""

    def list_of(self, name: str) -> list[str]:
        """A command in the form of a list."""
        given: list[str] = yaml.safe_load(self.said[name].partition("CMD ")[2] or self.said[name])
        return given


def write_stage(stage: Stage, folder: Path) -> None:
    """Note a stage in a folder, for `read_stage`."""
    noted = {**asdict(stage), "root": str(stage.root)}
    (folder / "image.json").write_text(json.dumps(noted, indent=1))


def read_stage(folder: Path) -> Stage:
    """A stage as it was noted."""
    noted = json.loads((folder / "image.json").read_text())
    return Stage(**{**noted, "root": Path(noted["root"])})


def build(base: Path, folder: Path) -> Stage:
    """Take every step of the Dockerfile.

    Args:
        base: the root that each stage begins with.
        folder: an empty one, for its stages.

    Returns:
        the last stage, whose layer is not mounted.
    """
    stages: dict[str, Stage] = {}
    try:
        last = _take_steps(base, folder, stages)
    finally:
        for stage in stages.values():
            lift(stage.root)
    return last


def _take_steps(base: Path, folder: Path, stages: dict[str, Stage]) -> Stage:
    last = Stage(base)
    for name, given in steps():
        sys.stdout.write(f"{name} {given}\n")
        sys.stdout.flush()
        match name:
            case "ARG":
                pass
            case "FROM":
                number = str(len(stages))
                last = Stage(layer(base, folder / number))
                stages[given.partition(" AS ")[2] or number] = last
            case "RUN":
                run_in(last.root, given, environment=last.environment, folder=last.folder)
            case "COPY":
                _copy(last, stages, shlex.split(given))
            case "ENV":
                for key, value in re.findall(r"(\w+)=(\S+)", given):
                    known = last.environment.get("PATH", PATH)
                    last.environment[key] = value.replace("$PATH", known)
            case "WORKDIR":
                last.folder = given
                _inside(last.root, given).mkdir(parents=True, exist_ok=True)
            case "LABEL" | "VOLUME" | "USER" | "EXPOSE" | "STOPSIGNAL" | "HEALTHCHECK":
                last.said[name] = given
            case "ENTRYPOINT" | "CMD":
                last.said[name] = given
            case _:
                raise ValueError(f"An instruction that is not known here: {name}.")
    return last


PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"


def _inside(root: Path, place: str) -> Path:
    return root / place.lstrip("/")


def _copy(stage: Stage, stages: dict[str, Stage], given: list[str]) -> None:
    if given[0].startswith("--from="):
        origin = stages[given[0].removeprefix("--from=")]
        source, target = (
            _inside(s.root, p) for s, p in zip((origin, stage), given[1:], strict=True)
        )
        subprocess.run(["cp", "--archive", source, target], check=True)
        return
    *names, into = given
    place = _inside(stage.root, str(Path(stage.folder) / into))
    files = copied()
    if names != ["."]:
        files = [file for file in files if str(file) in names]
        assert len(files) == len(names), f".dockerignore leaves out some of {names}"
    for file in files:
        target = place / file
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / file, target)

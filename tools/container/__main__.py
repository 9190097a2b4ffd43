"""Is the container what the Dockerfile says, and does the composition work? Without an engine:

    python -m tools.container FOLDER

as root on Linux, with debootstrap and a network; minutes, and 3 GB in the folder, which is to be
empty or of an earlier run. Debian with Python stands in for the base image; each step is run in it
as it is written; the image is started as `docker run --read-only` starts it; then the services of
`compose.yaml`, with PostgreSQL and nginx from Debian, on a network of their own.
"""

import argparse
import shutil
import sys
from pathlib import Path

from tools.container import composed, debian, image
from tools.container.network import alone


def main(arguments: list[str] | None = None) -> int:
    """Build, start and look; 1 if something is not as it should be."""
    parser = argparse.ArgumentParser(
        prog="python -m tools.container",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--built", action="store_true", help="it is built there: start it")
    given = parser.parse_args(arguments)
    folder: Path = given.folder.resolve()
    missing = [name for name in ("debootstrap", "unshare", "ip") if shutil.which(name) is None]
    if missing:
        parser.error(f"This needs {' and '.join(missing)}.")
    if given.built:
        return look(folder)
    base = folder / "base"
    if not (base / "usr/bin/python").exists():
        sys.stdout.write(f"Debian {debian.SUITE} with Python, in {base}\n")
        debian.install_base(base)
    shutil.rmtree(folder / "stages", ignore_errors=True)
    image.write_stage(image.build(base, folder / "stages"), folder)
    return look(folder)


def look(folder: Path) -> int:
    """Start what was built there."""
    stage = image.read_stage(folder)
    debian.layer(folder / "base", stage.root.parent)
    shutil.rmtree(folder / "services", ignore_errors=True)
    services = debian.layer(folder / "base", folder / "services")
    try:
        composed.install_services(services)
        return alone("tools.container.composed", str(folder))
    finally:
        for root in (services, stage.root):
            debian.lift(root)


if __name__ == "__main__":
    sys.exit(main())

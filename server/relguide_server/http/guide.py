"""The guide at /guide/: the site that `make guide` builds of docs/."""

import re
from base64 import b64encode
from functools import lru_cache
from hashlib import sha256
from pathlib import Path

from fastapi import APIRouter, Request
from starlette.responses import RedirectResponse, Response

from relguide_server.http.built_files import BuiltFile, answer, read
from relguide_server.http.errors import Refusal
from relguide_server.http.proxy import root_of

PACKAGE = Path(__file__).parents[1]
GUIDE_FOLDERS = (PACKAGE / "guide", PACKAGE.parents[1] / "build" / "guide")
"""Where the built guide is: in the package if a wheel carries it, else in the source tree."""
KEPT_FILES = 64
"""How many files of the guide are kept packed in memory."""
OWN_SCRIPT = re.compile(rb"<script(?: id=[^> ]*)?>(.*?)</script>", re.DOTALL)
"""A script within a page, which a policy names by its hash."""
CSP = (
    "default-src 'self'; script-src 'self'{scripts}; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:; frame-ancestors 'self'; base-uri 'self'; object-src 'none'"
)

router = APIRouter(include_in_schema=False)


@router.get("/guide")
def guide(request: Request) -> Response:
    """What the pages name is below the address, so it ends in a stroke."""
    return RedirectResponse(f"{root_of(request.scope)}/guide/")


@router.get("/guide/{name:path}")
def guide_file(request: Request, name: str) -> Response:
    """A page of the guide, or what it shows."""
    folder = built_guide()
    if folder is None:
        raise Refusal(404, "The guide has not been built: run make guide in the source tree.")
    path = _found(folder.resolve(), name)
    if path is None:
        raise Refusal(404, f"There is nothing at /guide/{name}. The guide begins at /guide/.")
    if path.is_dir():
        return RedirectResponse(f"{root_of(request.scope)}/guide/{name}/")
    file, policy = _read(path, path.stat().st_mtime_ns)
    return answer(file, request.headers, more={"Content-Security-Policy": policy})


def built_guide() -> Path | None:
    """The folder of the guide; `None` while none is built."""
    return next((one for one in GUIDE_FOLDERS if (one / "index.html").is_file()), None)


def _found(folder: Path, name: str) -> Path | None:
    """The file of a name, or the folder if its name lacks the stroke; `None` for neither."""
    try:
        path = (folder / name).resolve()
        if path.is_dir() and (name == "" or name.endswith("/")):
            path /= "index.html"
        there = path.is_relative_to(folder) and path.exists()
    except (OSError, ValueError):  # no name of a file: too long, or with a null in it
        return None
    return path if there else None


@lru_cache(KEPT_FILES)
def _read(path: Path, changed: int) -> tuple[BuiltFile, str]:
    """A file as it was built at a time [ns], and the policy that lets its own scripts run."""
    file = read(path)
    scripts = OWN_SCRIPT.findall(file.body) if path.suffix == ".html" else []
    known = sorted({b64encode(sha256(script).digest()).decode() for script in scripts})
    return file, CSP.format(scripts="".join(f" 'sha256-{one}'" for one in known))

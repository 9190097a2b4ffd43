"""The built pages of cockpit and controller, and the API's page, without any other machine."""

import gzip
import re
from base64 import b64encode
from collections.abc import Sequence
from functools import cache
from hashlib import sha256
from html import escape
from importlib.resources import files
from pathlib import Path

from fastapi import APIRouter, Request
from fastapi.openapi.docs import get_swagger_ui_html
from starlette.datastructures import Headers
from starlette.responses import HTMLResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from relguide_server.http.built_files import BuiltFile, answer, read
from relguide_server.http.errors import Refusal
from relguide_server.http.guide import built_guide
from relguide_server.http.proxy import path_of, root_of

PACKAGE = Path(__file__).parents[1]
PAGE_FOLDERS = (PACKAGE / "page", PACKAGE.parents[1] / "web" / "dist")
"""Where the built page is: in the package when installed, in the source tree otherwise."""
PAGES = {"/": "/index.html", "/atc": "/atc.html"}
"""The cockpit and the controller's page, by their addresses."""
HELP = {"Link": '<guide/>; rel="help"'}
"""Said with a page while the guide is built, so that the page links to it."""

SCRIPT = re.compile(rb"<script>(.*?)</script>", re.DOTALL)
DOCS_CSP = (
    "default-src 'self'; script-src 'self' 'sha256-{script}'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data:; frame-ancestors 'self'; base-uri 'self'; object-src 'none'"
)
NOT_BUILT = """<!doctype html><html lang="en"><title>relguide</title>
<body style="background:#040405;color:#e5dfd6;font:18px/1.5 sans-serif;margin:3em">
<h1>The cockpit has not been built</h1>
<p>The service itself is running: its API is described at
<a style="color:#17e9f2" href="docs">/docs</a>.
<p>To build the page, run <code>python web/build_page.py</code> in the source tree, then reload
this page.
<p style="color:#888">Looked in: {folders}"""


class Page:
    """ASGI middleware: answers with files of the built pages; everything else goes on to the app.

    They are kept in memory, and read again when the page has been built again.
    """

    def __init__(self, app: ASGIApp, *, folders: Sequence[Path] = PAGE_FOLDERS) -> None:
        self.app = app
        self.folders = folders
        self._files: dict[str, BuiltFile] = {}
        self._read_from: tuple[Path, int] | None = None

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if scope["type"] != "http" or scope["method"] not in ("GET", "HEAD"):
            await self.app(scope, receive, send)
            return
        path = path_of(scope)
        if path in PAGES or self._read_from is None:
            self._refresh()
        found = self._files.get(PAGES.get(path, path))
        if path == "/atc/":  # what the page names is beside it, not below it
            await RedirectResponse(f"{root_of(scope)}/atc")(scope, receive, send)
        elif found is not None:
            more = HELP if path in PAGES and built_guide() is not None else {}
            await answer(found, Headers(scope=scope), more=more)(scope, receive, send)
        elif path in PAGES:
            folders = escape(", ".join(map(str, self.folders)))
            await HTMLResponse(NOT_BUILT.format(folders=folders), 503)(scope, receive, send)
        else:
            await self.app(scope, receive, send)

    def _refresh(self) -> None:
        for folder in self.folders:
            index = folder / "index.html"
            if not index.is_file():
                continue
            stamp = (folder, index.stat().st_mtime_ns)
            if stamp != self._read_from:
                self._files = {
                    f"/{path.relative_to(folder).as_posix()}": read(path)
                    for path in sorted(folder.rglob("*"))
                    if path.is_file() and not path.name.startswith(".")
                }
                self._read_from = stamp
            return
        self._files, self._read_from = {}, None


router = APIRouter(include_in_schema=False)
_SWAGGER = files("fastapi_swagger") / "resources"
_SWAGGER_FILES = {"swagger-ui-bundle.js": "text/javascript", "swagger-ui.css": "text/css"}


@router.get("/docs")
async def docs(request: Request) -> HTMLResponse:
    """The API, to read and to try."""
    root = root_of(request.scope)
    page = get_swagger_ui_html(
        openapi_url=f"{root}/openapi.json",
        title="relguide API",
        swagger_js_url=f"{root}/docs/swagger-ui-bundle.js",
        swagger_css_url=f"{root}/docs/swagger-ui.css",
        swagger_favicon_url=f"{root}/favicon.svg",
    )
    # the page's own script is known by its hash; no other may be put into it
    (script,) = SCRIPT.findall(bytes(page.body))
    known = b64encode(sha256(script).digest()).decode()
    page.headers["Content-Security-Policy"] = DOCS_CSP.format(script=known)
    return page


@router.get("/docs/{name}")
async def docs_file(name: str) -> Response:
    """Script and style of the API's page."""
    if name not in _SWAGGER_FILES:
        raise Refusal(404, f"There is nothing at /docs/{name}. The API is described at /docs.")
    headers = {"Content-Encoding": "gzip", "Cache-Control": "public, max-age=86400"}
    return Response(_pack_swagger(name), headers=headers, media_type=_SWAGGER_FILES[name])


@cache
def _pack_swagger(name: str) -> bytes:
    return gzip.compress((_SWAGGER / name).read_bytes(), 6)

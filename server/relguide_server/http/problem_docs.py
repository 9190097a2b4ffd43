"""The page to which the `type` of every problem document leads."""

from html import escape

from fastapi import APIRouter, Request
from starlette.responses import HTMLResponse

from relguide_server.http.page_style import STYLE, prose
from relguide_server.http.problem_kinds import KINDS, PAGE
from relguide_server.http.proxy import root_of

INTRODUCTION = (
    "What is refused is answered by a problem document (RFC 9457, `application/problem+json`). Its "
    "`type` leads to one of these, `detail` says in a sentence what is wrong and what would be "
    "right, `errors` has the path of each field that is wrong, and `instance` is what was asked."
)

router = APIRouter(include_in_schema=False)


@router.get(PAGE)
async def problem_page(request: Request) -> HTMLResponse:
    """All kinds of problems."""
    rows = "".join(
        f'<tr id="{name}"><td><code>{name}</code><td>{kind.status}<td>{escape(kind.title)}'
        f"<td>{prose(kind.advice)}"
        for name, kind in KINDS.items()
    )
    return HTMLResponse(
        '<!doctype html><html lang="en"><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width"><title>relguide problems</title>'
        f"<style>{STYLE}tr:target{{background:#223}}</style><body><main><h1>Problems</h1>"
        f'<p>{prose(INTRODUCTION)}<p><a href="{root_of(request.scope)}/docs">REST</a>'
        f"<table>{rows}</table></main>"
    )

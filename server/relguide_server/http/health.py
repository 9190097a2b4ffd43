"""Whether a service on this machine plans: `python -m relguide_server.http.health`, for containers.

It asks for a plan, by a token of `RELGUIDE_TOKENS` if there are any, and reads `/readyz`, for which
a worker has to answer. Standard library alone, as it is run every few seconds.
"""

import json
import os
import sys
from typing import Any
from urllib.error import HTTPError, URLError
from urllib.request import ProxyHandler, Request, build_opener

PATIENCE = 4.0
"""How long each of both answers may take to come [s]."""
SITUATION = {
    "pursuer": {"x_m": -40000, "y_m": 40000, "heading_deg": 90, "tas_mps": 240, "max_bank_deg": 25},
    "leader": {"x_m": 0, "y_m": 0, "heading_deg": 90, "tas_mps": 200},
    "slot_distance_m": 10000,
    "min_separation_m": 0,
}


def ask(url: str, token: str) -> str:
    """Ask for a plan, and whether a worker answers; while it compiles there may be none yet.

    Args:
        url: of the service, without a slash at its end.
        token: that may plan; empty if none is needed.

    Returns:
        Why it does not plan; empty if it does.
    """
    headers = {"Content-Type": "application/json"}
    if token:
        headers["Authorization"] = f"Bearer {token}"
    request = Request(f"{url}/api/v1/plans", json.dumps(SITUATION).encode(), headers)
    try:
        status = _open(request)["status"]
        ready = _open(Request(f"{url}/readyz"))
        answers = ready["planning"]["answers"] or ready["preparing"] is not None
    except (URLError, OSError, ValueError, KeyError) as error:
        return f"{url} does not plan: {error}"
    if status != "planned":
        return f"{url} answers {status}"
    return "" if answers else f"{url} does not plan: none of its workers answers"


def main(arguments: list[str]) -> int:
    """Ask the service at an address, or at port 8000 of this machine; 0 if it plans."""
    url = arguments[0] if arguments else "http://127.0.0.1:8000"
    token = os.environ.get("RELGUIDE_TOKENS", "").partition(",")[0].partition(":")[2]
    trouble = ask(url.rstrip("/"), token)
    if trouble:
        sys.stderr.write(f"{trouble}\n")
    return bool(trouble)


def _open(request: Request) -> dict[str, Any]:
    """A JSON object that is answered; that of 503 says what is lacking."""
    try:
        answer = build_opener(ProxyHandler({})).open(request, timeout=PATIENCE)
    except HTTPError as refused:
        if refused.code != 503:
            raise
        answer = refused
    with answer:
        read: dict[str, Any] = json.load(answer)
    return read


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Whether a service on this machine plans: `python -m relguide_server.http.health`, for containers.

It asks for a plan, by a token of `RELGUIDE_TOKENS` if there are any. Standard library alone, as it
is run every few seconds.
"""

import json
import os
import sys
from urllib.error import URLError
from urllib.request import ProxyHandler, Request, build_opener

PATIENCE = 4.0
"""How long the plan may take to come [s]."""
SITUATION = {
    "pursuer": {"x_m": -40000, "y_m": 40000, "heading_deg": 90, "tas_mps": 240, "max_bank_deg": 25},
    "leader": {"x_m": 0, "y_m": 0, "heading_deg": 90, "tas_mps": 200},
    "slot_distance_m": 10000,
    "min_separation_m": 0,
}


def ask(url: str, token: str) -> str:
    """Ask for a plan.

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
        with build_opener(ProxyHandler({})).open(request, timeout=PATIENCE) as response:
            status = json.load(response)["status"]
    except (URLError, OSError, ValueError, KeyError) as error:
        return f"{url} does not plan: {error}"
    return "" if status == "planned" else f"{url} answers {status}"


def main(arguments: list[str]) -> int:
    """Ask the service at an address, or at port 8000 of this machine; 0 if it plans."""
    url = arguments[0] if arguments else "http://127.0.0.1:8000"
    token = os.environ.get("RELGUIDE_TOKENS", "").partition(",")[0].partition(":")[2]
    trouble = ask(url.rstrip("/"), token)
    if trouble:
        sys.stderr.write(f"{trouble}\n")
    return bool(trouble)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

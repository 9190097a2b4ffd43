"""The other processes that fly behind the same address, and the flights of all of them."""

import asyncio
import json
from collections.abc import Mapping
from http.client import HTTPException
from urllib.request import ProxyHandler, Request, build_opener

from starlette.requests import HTTPConnection

from relguide.contract.messages import FlightList, FlightStatus
from relguide.contract.refusal import parse
from relguide_server.settings import read_peers

PATIENCE = 2.0
"""How long a process may take to list its flights [s]."""
ALONE = "relguide-process"
"""The header that asks one process for its own flights; a proxy sends such a request there."""
PASSED_ON = ("host", "authorization", "cookie", "x-forwarded-prefix")
"""Headers of who asks, by which the others judge it as this process does."""


class Peers:
    """Asks the others for their flights."""

    def __init__(self, peers: str, *, process: str) -> None:
        """Take the settings of the same names."""
        self._others = {name: url for name, url in read_peers(peers).items() if name != process}

    async def flights(self, request: HTTPConnection) -> tuple[list[FlightStatus], list[str]]:
        """The flights of the others, and which of them did not answer.

        Args:
            request: who asks, on whose behalf they are asked.
        """
        if ALONE in request.headers:
            return [], []
        passed = {name: request.headers[name] for name in PASSED_ON if name in request.headers}
        answers = await asyncio.gather(
            *(
                asyncio.to_thread(_list_flights, url, passed | {ALONE: name})
                for name, url in self._others.items()
            )
        )
        listed = [flight for found in answers for flight in found or ()]
        return listed, [
            name for name, found in zip(self._others, answers, strict=True) if found is None
        ]


def _list_flights(url: str, headers: Mapping[str, str]) -> list[FlightStatus] | None:
    asked = Request(f"{url}/api/v1/flights", headers=dict(headers))
    try:
        with build_opener(ProxyHandler({})).open(asked, timeout=PATIENCE) as answer:
            return parse(FlightList, json.load(answer)).flights
    except (OSError, HTTPException, ValueError):
        return None

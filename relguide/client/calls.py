"""What a program asks of the service, before it is sent, and what it gets: for both clients."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, Generic, Literal, TypeVar

import httpx2
import orjson
from websockets.exceptions import ConnectionClosedError, InvalidStatus

from relguide.client.bodies import Asked, body_of
from relguide.contract.area_bodies import AreaAnswer
from relguide.contract.document_models import from_wire, knows, plan_from_wire
from relguide.contract.messages import FlightStatus
from relguide.contract.pilot_bodies import pilot_to_body
from relguide.contract.simulation_bodies import SimulationAnswer
from relguide.flying.documents import Document
from relguide.flying.engagement import Engagement
from relguide.flying.pilot_model import PilotModel
from relguide.flying.plan_documents import NoPlanCard, PlanCard
from relguide.planning.situation import Situation
from relguide.units import Second

T = TypeVar("T")
JSON, LINES = "application/json", "application/x-ndjson"
AT_A_TIME = 1000
"""Most situations in one request."""
Include = Literal["alternatives", "optimality"]
IncludeDrawn = Literal["alternatives", "optimality", "paths", "flown"]
Line = Mapping[str, Any]
"""An order, a member for each field, as a line of `--orders` or `--crew` has it."""
PlannerName = Literal["exact", "network"]


@dataclass(frozen=True, slots=True)
class Invalid:
    """What was asked is no situation."""

    message: str
    """What is wrong, and what would be right."""


Answer = PlanCard | NoPlanCard
"""A plan, or why there is none."""


class Refused(Exception):
    """The service understood a request and did not serve it, or made a mistake."""

    def __init__(self, status: int, detail: str, retry_after: Second | None) -> None:
        super().__init__(detail)
        self.status = status
        """Of HTTP, e.g. 503; or what a stream was closed with, e.g. 4404."""
        self.retry_after = retry_after
        """When to ask again, if the service says so [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Call(Generic[T]):
    """A request, and how its answer is read."""

    method: str
    path: str
    read: Callable[[bytes], T]
    params: Mapping[str, str | int | float] = field(default_factory=dict)
    content: bytes = b""
    content_type: str = JSON

    def options(self) -> dict[str, Any]:
        """What httpx takes beside method and path."""
        headers = {"content-type": self.content_type} if self.content else {}
        params = {name: value for name, value in self.params.items() if value not in ("", None)}
        return {"params": params, "content": self.content or None, "headers": headers}


class Lines:
    """The lines of an answer that comes in parts. They end at a line feed and nowhere else."""

    def __init__(self) -> None:
        self._begun = b""

    def add(self, part: bytes) -> list[bytes]:
        """The lines that end in the next part."""
        *lines, self._begun = (self._begun + part).split(b"\n")
        return lines


def expect_served(response: httpx2.Response) -> None:
    """Go on with what was served; its body has been read.

    Raises:
        Refused: otherwise, with the sentence of the problem document.
    """
    if response.is_success:
        return
    detail = _detail_of(response.content) or f"{response.status_code} {response.reason_phrase}"
    after = response.headers.get("retry-after", "")
    raise Refused(response.status_code, detail, float(after) if after.isdecimal() else None)


def _detail_of(body: bytes) -> str:
    """The sentence of a problem document; empty if this is none: a proxy's answer, perhaps."""
    try:
        return str(orjson.loads(body)["detail"])
    except (ValueError, KeyError, TypeError):
        return ""


@contextmanager
def streaming() -> Iterator[None]:
    """Say what a stream refuses as requests do.

    Raises:
        Refused: if it is not opened, or closed before the flight is over.
    """
    try:
        yield
    except InvalidStatus as error:
        sent = error.response
        said = _detail_of(bytes(sent.body)) or f"{sent.status_code} {sent.reason_phrase}"
        raise Refused(sent.status_code, said, None) from None
    except ConnectionClosedError as error:
        if error.rcvd is None:
            raise
        raise Refused(error.rcvd.code, error.rcvd.reason, None) from None


def plan(
    asked: Asked,
    *,
    max_ms: float | None,
    include: Sequence[Include],
    planner: PlannerName | None,
) -> Call[Answer]:
    """Plan a situation."""
    return Call(
        method="POST",
        path="api/v1/plans",
        params=_wish(max_ms, include, planner),
        content=orjson.dumps(body_of(asked)),
        read=_read_plan,
    )


def plan_geojson(
    asked: Asked,
    *,
    max_ms: float | None,
    include: Sequence[IncludeDrawn],
    planner: PlannerName | None,
) -> Call[dict[str, Any]]:
    """Plan a situation that lies on the earth, to be drawn."""
    return Call(
        method="POST",
        path="api/v1/plans",
        params={**_wish(max_ms, include, planner), "format": "geojson"},
        content=orjson.dumps(body_of(asked)),
        read=orjson.loads,
    )


def simulate(
    flights: Iterable[str | Asked | Mapping[str, Any]], *, planner: PlannerName | None
) -> Call[list[SimulationAnswer]]:
    """Fly to the end at once."""
    return Call(
        method="POST",
        path="api/v1/simulations",
        params={"planner": planner or ""},
        content=orjson.dumps([_flight(one) for one in flights]),
        read=_read_figures,
    )


def _flight(asked: str | Asked | Mapping[str, Any]) -> Mapping[str, Any]:
    if isinstance(asked, str):
        return {"scenario": asked}
    if isinstance(asked, Situation):
        return {"situation": body_of(asked)}
    return asked


def plan_batch(
    asked: Iterable[Asked], *, max_ms: float | None, planner: PlannerName | None
) -> Iterator[Call[Answer | Invalid]]:
    """Plan situations, a thousand a request; each line of an answer is read by itself."""
    rest = iter(asked)
    while some := list(islice(rest, AT_A_TIME)):
        yield Call(
            method="POST",
            path="api/v1/plans/batch",
            params=_wish(max_ms, (), planner),
            content=b"\n".join(orjson.dumps(body_of(one)) for one in some),
            content_type=LINES,
            read=_read_line,
        )


def area(asked: Asked, **wanted: Any) -> Call[AreaAnswer]:
    """Draw a convergence area."""
    body = {"situation": body_of(asked), **wanted}
    return Call(
        method="POST",
        path="api/v1/areas",
        content=orjson.dumps(body),
        read=lambda said: AreaAnswer.model_validate_json(said, extra="ignore"),
    )


def fly(
    what: str | Asked,
    *,
    rate: float,
    paused: bool,
    seed: int,
    engagement: Engagement | None,
    by_hand: bool | PilotModel,
    orders: Sequence[Line],
    crew: Sequence[Line] | None,
) -> Call[FlightStatus]:
    """Start a flight of a scenario by its name, or of a situation."""
    first = {"scenario": what} if isinstance(what, str) else {"situation": body_of(what)}
    wanted = {
        "engagement": engagement,
        "by_hand": pilot_to_body(by_hand) if isinstance(by_hand, PilotModel) else by_hand,
        "orders": [dict(line) for line in orders],
        "crew": None if crew is None else [dict(line) for line in crew],
    }
    body = {**first, "rate": rate, "paused": paused, "seed": seed}
    body |= {name: value for name, value in wanted.items() if value not in (None, False)}
    return Call(method="POST", path="api/v1/flights", content=orjson.dumps(body), read=_read_status)


def status(flight_id: str) -> Call[FlightStatus]:
    """Where a flight stands."""
    return Call(method="GET", path=f"api/v1/flights/{flight_id}", read=_read_status)


def command(flight_id: str, name: str, **members: Any) -> Call[FlightStatus]:
    """Tell a flight something."""
    return Call(
        method="POST",
        path=f"api/v1/flights/{flight_id}/commands",
        content=orjson.dumps({"command": name, **members}),
        read=_read_status,
    )


def end(flight_id: str) -> Call[None]:
    """End a flight."""
    return Call(method="DELETE", path=f"api/v1/flights/{flight_id}", read=_read_nothing)


def some_records(cursor: str, **sought: str | int) -> Call[tuple[list[dict[str, Any]], str]]:
    """Flights on record from a cursor on, and the next cursor; both empty at an end."""
    return Call(
        method="GET",
        path="api/v1/records/flights",
        params={**sought, "cursor": cursor} if cursor else sought,
        read=_read_records,
    )


def recorded(flight_id: str, first: int) -> Call[list[tuple[int, Document]]]:
    """Documents of a flight on record, from a number on, as many as one answer holds."""
    return Call(
        method="GET",
        path=f"api/v1/records/flights/{flight_id}/documents",
        params={"first": first},
        read=lambda content: [
            (one["number"], from_wire(one["document"], extra="ignore"))
            for one in orjson.loads(content)["documents"]
            if knows(one["document"])
        ],
    )


def documents_of(text: str | bytes) -> tuple[list[Document], bool]:
    """What a message of the stream holds, and whether the flight is over."""
    tick = orjson.loads(text)
    known = [document for document in tick["documents"] if knows(document)]
    return [from_wire(document, extra="ignore") for document in known], tick["ended"]


def base_url(url: str) -> str:
    """Where a service is, with a slash at the end.

    Raises:
        ValueError: for what is no such address.
    """
    base = url.rstrip("/")
    if not base.startswith(("http://", "https://")):
        raise ValueError(f"url must begin with http:// or https://, not be {url!r}.")
    if base.endswith("/api/v1"):
        raise ValueError(f"url must be where the service is, without /api/v1, not {url!r}.")
    return f"{base}/"


def stream_url(base: str, flight_id: str) -> str:
    """Where a flight is watched.

    Args:
        base: of the service, http:// or https://, with a slash at its end.
        flight_id: of the flight.
    """
    return f"ws{base.removeprefix('http')}api/v1/flights/{flight_id}/stream"


def _wish(
    max_ms: float | None, include: Sequence[str], planner: PlannerName | None
) -> dict[str, str | float]:
    wish: dict[str, str | float] = {"include": ",".join(include), "planner": planner or ""}
    return wish if max_ms is None else {**wish, "max_ms": max_ms}


def _read_line(line: bytes) -> Answer | Invalid:
    content = orjson.loads(line)
    match content.get("status"):
        case "invalid":
            return Invalid(str(content["message"]))
        case "refused":
            raise Refused(503, str(content["message"]), None)
    content.pop("id", None)
    return plan_from_wire(content, extra="ignore")


def _read_plan(content: bytes) -> Answer:
    return plan_from_wire(content, extra="ignore")


def _read_status(content: bytes) -> FlightStatus:
    return FlightStatus.model_validate_json(content, extra="ignore")


def _read_figures(content: bytes) -> list[SimulationAnswer]:
    return [
        SimulationAnswer.model_validate_json(orjson.dumps(figures), extra="ignore")
        for figures in orjson.loads(content)
    ]


def _read_records(content: bytes) -> tuple[list[dict[str, Any]], str]:
    answer = orjson.loads(content)
    return list(answer["flights"]), answer["next"] or ""


def _read_nothing(content: bytes) -> None:
    del content

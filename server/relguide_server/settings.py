"""The settings of an operator, each with its reason.

Each is an option of `relguide serve` and a variable of its environment. An option wins over the
environment, and the environment over the default.
"""

import json
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from ipaddress import ip_network
from os import cpu_count
from typing import Annotated, Literal

from pydantic import Field, ValidationError, field_validator
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails
from pydantic_settings import BaseSettings, SettingsConfigDict

from relguide.learn.planners import SERVING
from relguide_server.feed_settings import feeds_of

PREFIX = "RELGUIDE_"
NOT_OURS = re.compile(r"SKIP_WEB|KERNELS|SERVICE_(HOST|PORT\w*)|PORT(_\w+)?")
"""Variables that are read when a wheel is built, and those that Kubernetes sets for a service of
this name."""
DATABASES = ("sqlite:///", "postgresql://", "postgresql+psycopg://")
"""What the address of a database may begin with."""
SECRET = ("tokens", "database_url")
"""Read from the environment alone: options are seen by everybody on the machine."""
OWN_PATHS = ("api", "asyncapi.json", "assets", "docs", "healthz", "metrics", "openapi.json",
             "readyz", "scene")  # fmt: skip
"""First parts of the service's own paths: below a path of the same name they would be ambiguous."""
PATH = re.compile(r"(/[\w.~-]+)*", re.ASCII)
"""A path on a host, without a slash at its end."""

PEER = re.compile(r"([a-z])=(https?://[^/,\s?#@]+)", re.ASCII)
"""A process by its letter, and where it is."""


def read_peers(text: str) -> dict[str, str]:
    """The addresses of processes by their letters, from the setting."""
    return dict(PEER.findall(text))


@dataclass(frozen=True, slots=True)
class Unit:
    """What a setting counts, as `--help` shows it."""

    name: str


Count = Annotated[int, Field(ge=1)]
CountOrNone = Annotated[int, Field(ge=0)]
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]


class ServiceSettings(BaseSettings):
    """Limits of the service. Each can be set by an environment variable `RELGUIDE_<NAME>`."""

    model_config = SettingsConfigDict(
        env_prefix=PREFIX, frozen=True, extra="forbid", use_attribute_docstrings=True
    )

    workers: Annotated[CountOrNone, Unit("PROCESSES")] = Field(
        default_factory=lambda: min(4, max(2, cpu_count() or 1))
    )
    """Processes that plan what takes longer than a millisecond, draw areas and answer batches; each
    holds 200 MB. With 0, threads of the service itself do that, and nothing ends one that is stuck.
    """
    queue: Annotated[Count, Unit("JOBS")] = 64
    """Jobs of a kind that may wait for a worker."""
    hosts: Annotated[str, Unit("NAMES")] = ""
    """Names this server is reached by, with commas between; it always answers to localhost and to
    addresses. `*`: any name, which lets pages of other sites reach it."""
    tokens: Annotated[str, Unit("ROLE:TOKEN,…")] = ""
    """Who may do what, e.g. `view:TOKEN,fly:TOKEN,atc:TOKEN,control:TOKEN`; if empty, everybody on
    this machine may do all, and others command and end their own flights."""
    open_control: Annotated[Literal["on", "off"], Unit("on|off")] = "off"
    """Without tokens, whether others too may command all flights, say what traffic and airspace
    there is, and remove records."""
    root_path: Annotated[str, Unit("PATH")] = ""
    """The path below which a proxy serves it, e.g. `/relguide`, whether or not the proxy strips it.
    A trusted proxy may say it as well (`X-Forwarded-Prefix`)."""
    proxies: Annotated[str, Unit("ADDRESSES")] = "127.0.0.1"
    """Addresses and networks of proxies, with commas between, whose `X-Forwarded-…` are believed.
    `*`: any."""
    max_watchers: Annotated[Count, Unit("BROWSERS")] = 64
    """Browsers that may watch one flight."""
    max_connections: Annotated[Count, Unit("CONNECTIONS")] = 512
    """Connections that are served at once; others get 503."""
    max_flights: Annotated[Count, Unit("FLIGHTS")] = 16
    """Flights that may be in the air at once: each is a thread that shares one interpreter."""
    process: Annotated[str, Unit("LETTER")] = ""
    """Letter of this process, where several fly behind one address: ids of its flights begin with
    it, as `a-3f2a9c0d71be`, and the proxy finds them by that."""
    peers: Annotated[str, Unit("LETTER=URL,…")] = ""
    """All processes that fly behind that address, e.g. `a=http://flights-a:8000`: each of them then
    lists the flights of all."""
    keep_unseen: Annotated[Positive, Unit("SECONDS")] = 600.0
    """A flight that nobody has watched or asked for in this time is removed."""
    spare_after: Annotated[Positive, Unit("SECONDS")] = 15.0
    """When no more flights fit, one unseen for this long makes room for a new one."""
    max_body: Annotated[Count, Unit("BYTES")] = 8 * 1024 * 1024
    """Largest request body: 1,000 situations with 20 pieces of intent each fit in 3 MB."""
    stream_rate: Annotated[Positive, Unit("TICKS/S")] = 20.0
    """Ticks a wall-clock second."""
    planner: Annotated[str, Unit("|".join(SERVING))] = "exact"
    """Who plans, for REST and for flights."""
    drift_check: Annotated[CountOrNone, Unit("PLANS")] = 100
    """One in so many plans by network is planned again exactly, for `/metrics`; 0: none. Where the
    limit binds that takes tens of milliseconds, on a thread of its own."""
    log_format: Annotated[Literal["text", "json"], Unit("text|json")] = "text"
    """How the log is written: as text, or as JSON lines."""
    log_level: Annotated[Literal["debug", "info", "warning"], Unit("debug|info|warning")] = "info"
    """What the log holds at least; `debug` adds a line for every request."""

    feed: Annotated[str, Unit("FEED,…")] = ""
    """Who says what else flies: `asterix://ADDRESS:PORT` (UDP, categories 062 and 021),
    `readsb:ADDRESS` or `readsb:FILE` (aircraft.json), `replay:FILE` (a recording)."""
    atc_auto_answer: Annotated[Literal["auto", "on", "off"], Unit("auto|on|off")] = "auto"
    """Whether the automation answers requests for clearances in the controller's place; `auto`:
    while no token is a controller's and no controllers' stream is open."""

    records: Annotated[Literal["on", "off"], Unit("on|off")] = "on"
    """Whether flights, commands and plans asked for are kept."""
    database_url: Annotated[str, Unit("URL")] = ""
    """Of the records: sqlite:///FILE or postgresql://USER:PASSWORD@HOST/NAME. A file in `data` if
    empty."""
    data: Annotated[str, Unit("FOLDER")] = ""
    """The folder of the records' file; the user's own folder for data if empty."""
    record_plans: Annotated[CountOrNone, Unit("PLANS/S")] = 200
    """Plans a second that are kept; 0: none."""
    keep_days: Annotated[Positive, Unit("DAYS")] = 30.0
    """How long records are kept."""
    keep_mb: Annotated[Positive, Unit("MB")] = 2000.0
    """How much the documents of all flights may take; then the oldest go."""

    @field_validator("planner")
    @classmethod
    def _can_serve(cls, name: str) -> str:
        if name not in SERVING:
            raise ValueError(f"must be {' or '.join(SERVING)}")
        return name

    @field_validator("database_url")
    @classmethod
    def _is_a_database(cls, url: str) -> str:
        if url and not url.startswith(DATABASES):
            raise ValueError(f"must begin with {' or '.join(DATABASES)}")
        return url

    @field_validator("feed")
    @classmethod
    def _are_feeds(cls, text: str) -> str:
        feeds_of(text)
        return text

    @field_validator("root_path")
    @classmethod
    def _is_a_path(cls, path: str) -> str:
        path = path.rstrip("/")
        if not PATH.fullmatch(path):
            raise ValueError("must be a path such as /relguide")
        if path and path.split("/")[1] in OWN_PATHS:
            raise ValueError("must not begin as a path of the service itself does")
        return path

    @field_validator("process")
    @classmethod
    def _is_a_letter(cls, name: str) -> str:
        if not re.fullmatch("[a-z]?", name):
            raise ValueError("must be a letter from a to z")
        return name

    @field_validator("peers")
    @classmethod
    def _are_processes(cls, text: str) -> str:
        if any(not PEER.fullmatch(part) for part in text.split(",") if text):
            raise ValueError("must be letters and addresses such as a=http://flights-a:8000")
        return text

    @field_validator("proxies")
    @classmethod
    def _are_addresses(cls, text: str) -> str:
        for part in filter(None, (part.strip() for part in text.split(","))):
            try:
                _ = part == "*" or ip_network(part, strict=False)
            except ValueError:
                raise ValueError("must be addresses such as 127.0.0.1,10.0.0.0/8") from None
        return text

    def text_for_records(self) -> str:
        """Those that matter to a flight, as JSON."""
        return json.dumps({name: getattr(self, name) for name in ("planner", "stream_rate")})


@dataclass(frozen=True, slots=True, kw_only=True)
class Option:
    """How `relguide serve` takes a setting."""

    name: str
    """Of the setting."""
    flag: str
    """E.g. `--max-flights`; empty for what is read from the environment alone."""
    variable: str
    """Of the environment."""
    unit: str
    """What it counts, or what it may be."""
    help: str
    """What it does, its default and its variable."""


def options() -> list[Option]:
    """How `relguide serve` takes the settings, each with what `--help` says of it."""
    return [_option(name, field) for name, field in ServiceSettings.model_fields.items()]


def settings_from(**given: str) -> ServiceSettings:
    """The settings: what is given by name, else the environment, else the defaults.

    Raises:
        ValueError: with a sentence that names the setting, and what would be right; for a variable
            of the environment that is no setting, the nearest that is.
    """
    _refuse_unknown(os.environ)
    try:
        return ServiceSettings(**given)  # type: ignore[arg-type]  # texts, read by pydantic
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        name = str(first["loc"][0])
        where = _flag(name) if name in given else _variable(name)
        shown = "" if name in SECRET else f", not {first['input']!r}"
        raise ValueError(f"{where} {_what_is_right(first)}{shown}.") from None


def _refuse_unknown(environment: Mapping[str, str]) -> None:
    known = {name.upper() for name in ServiceSettings.model_fields}
    for variable in environment:
        name = variable.upper().removeprefix(PREFIX)
        if name == variable.upper() or name in known or NOT_OURS.fullmatch(name):
            continue
        near = get_close_matches(name, known, n=1)
        meant = f"is {PREFIX}{near[0]} meant?" if near else "relguide serve --help lists all."
        raise ValueError(f"{variable} is no setting: {meant}")


def _what_is_right(error: ErrorDetails) -> str:
    limits = error.get("ctx", {})
    match error["type"]:
        case "int_parsing" | "int_type" | "int_from_float":
            return "must be a whole number"
        case "float_parsing" | "float_type":
            return "must be a number"
        case "greater_than" | "finite_number":
            return "must be a positive number"
        case "greater_than_equal":
            return f"must be {limits['ge']} or more"
        case "literal_error":
            return f"must be {str(limits['expected']).replace(chr(39), '')}"
        case _:
            return str(limits.get("error", error["msg"]))


def _option(name: str, field: FieldInfo) -> Option:
    (unit,) = (part.name for part in field.metadata if isinstance(part, Unit))
    default = field.get_default(call_default_factory=True, validated_data={})
    shown = f"{default:g}" if isinstance(default, float) else str(default)
    said = " ".join(str(field.description).split())
    more = f"default: {shown or 'none'}" + ("" if name in SECRET else f"; {_variable(name)}")
    return Option(
        name=name,
        flag="" if name in SECRET else _flag(name),
        variable=_variable(name),
        unit=unit,
        help=f"{said[0].lower()}{said[1:].rstrip('.')} ({more})",
    )


def _flag(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _variable(name: str) -> str:
    return f"{PREFIX}{name.upper()}"

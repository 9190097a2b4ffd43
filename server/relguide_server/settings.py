"""The settings of an operator, each with its reason."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite
from os import cpu_count
from typing import Any

from relguide.learn.planners import SERVING

DATABASES = ("sqlite:///", "postgresql://", "postgresql+psycopg://")
"""What the address of a database may begin with."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """Limits of the service. Each can be set by an environment variable `RELGUIDE_<NAME>`."""

    workers: int = field(default_factory=lambda: min(4, max(2, cpu_count() or 1)))
    """Processes that plan what takes longer than a millisecond, draw areas and answer batches; each
    holds 200 MB. With 0, threads of the service itself do that, and nothing ends one that is stuck.
    """
    queue: int = 64
    """Jobs of a kind that may wait for a worker."""
    hosts: str = ""
    """Names this server is reached by, with commas between; it always answers to localhost and to
    addresses. `*`: any name, which lets pages of other sites reach it."""
    tokens: str = ""
    """Who may do what, e.g. `view:TOKEN,fly:TOKEN,control:TOKEN`; if empty, everybody may do all.
    """
    max_watchers: int = 64
    """Browsers that may watch one flight."""
    max_connections: int = 512
    """Connections that are served at once; others get 503."""
    max_flights: int = 16
    """Flights that may be in the air at once: each is a thread that shares one interpreter."""
    keep_unseen: float = 600.0
    """A flight that nobody has watched or asked for in this time [s] is removed."""
    spare_after: float = 15.0
    """When no more flights fit, one unseen for this long [s] makes room for a new one."""
    max_body: int = 8 * 1024 * 1024
    """Largest request body [bytes]: 1,000 situations with 20 pieces of intent each fit in 3 MB."""
    stream_rate: float = 20.0
    """Ticks a wall-clock second [1/s]."""
    planner: str = "exact"
    """Who plans, for REST and for flights: one of `SERVING`."""
    drift_check: int = 100
    """One in so many plans by network is planned again exactly, for `/metrics`; 0: none. Where the
    limit binds that takes tens of milliseconds, on a thread of its own."""

    records: str = "on"
    """Whether flights, commands and plans asked for are kept: on or off."""
    database_url: str = ""
    """Where: sqlite:///FILE or postgresql://USER:PASSWORD@HOST/NAME. A file in `data` if empty."""
    data: str = ""
    """The folder of that file; the user's own folder for data if empty."""
    record_plans: int = 200
    """Plans a second that are kept; 0: none."""
    keep_days: float = 30.0
    """How long records are kept."""
    keep_mb: float = 2000.0
    """How much the documents of all flights may take; then the oldest go."""

    def __post_init__(self) -> None:
        """Refuse settings with which nothing could run."""
        if self.planner not in SERVING:
            raise ValueError(f"planner must be {' or '.join(SERVING)}, not {self.planner}.")
        if self.records not in ("on", "off"):
            raise ValueError(f"records must be on or off, not {self.records}.")
        if self.database_url and not self.database_url.startswith(DATABASES):
            raise ValueError(f"database_url must begin with {' or '.join(DATABASES)}.")
        for name in ("drift_check", "workers", "record_plans"):
            if getattr(self, name) < 0:
                raise ValueError(f"{name} must be 0 or more, not {getattr(self, name)}.")
        for name in ("max_flights", "max_body", "queue", "max_watchers", "max_connections"):
            if getattr(self, name) < 1:
                raise ValueError(f"{name} must be 1 or more, not {getattr(self, name)}.")
        for name in ("keep_unseen", "spare_after", "stream_rate", "keep_days", "keep_mb"):
            value = getattr(self, name)
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{name} must be a positive number, not {value}.")

    def text_for_records(self) -> str:
        """Those that matter to a flight, as JSON."""
        return json.dumps({name: getattr(self, name) for name in ("planner", "stream_rate")})


def settings_from(environment: Mapping[str, str]) -> Settings:
    """The settings, with overrides from the environment, e.g. `RELGUIDE_MAX_FLIGHTS=4`."""
    defaults = Settings()
    changed: dict[str, Any] = {}
    for name in Settings.__dataclass_fields__:
        variable = f"RELGUIDE_{name.upper()}"
        if variable not in environment:
            continue
        kind = type(getattr(defaults, name))
        try:
            changed[name] = kind(environment[variable])
        except ValueError as error:
            noun = "a whole number" if kind is int else "a number"
            raise ValueError(
                f"{variable} must be {noun}, not {environment[variable]!r}."
            ) from error
    return Settings(**changed)

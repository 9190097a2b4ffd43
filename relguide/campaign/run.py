"""campaign(file, out): fly what a campaign asks for, on all cores or a Dask cluster."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import asdict, replace
from functools import partial
from itertools import islice
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple

from relguide.campaign.campaign_file import Campaign, load_campaign, read_campaign
from relguide.campaign.draw import draw_flight
from relguide.campaign.judge import documents_of, failed_row, fly_case
from relguide.campaign.parts import (
    begin_folder,
    encode_part,
    keep_part,
    part_name,
    read_table,
    write_manifest,
)
from relguide.parallel.in_order import in_order
from relguide.parallel.lock import locked
from relguide.parallel.pool import count_cores, start_processes
from relguide.planning.extras import need
from relguide.planning.progress import progress_bar
from relguide.units import Second

if TYPE_CHECKING:
    import pyarrow as pa

LEAST_ROWS, MOST_ROWS, PARTS = 10, 250, 400
"""Flights in a part: so that there are `PARTS`, but within these. A kill loses those under way."""
KEPT_EVERY: Second = 2.0
"""Between two manifests."""
LOADING = 40
"""Documents of a flight that loads the kernels, before processes begin as copies of this one."""


class PartChunk(NamedTuple):
    """The flights of a part."""

    number: int
    first: int
    last: int
    """Past the end."""

    @property
    def name(self) -> str:
        """As a sentence begins that is about it."""
        return f"The flights from {self.first} on"


class FlownPart(NamedTuple):
    """A part that was flown."""

    content: bytes
    """Of its file."""
    rows: int


class FlightWorkers(NamedTuple):
    """Where flights are flown."""

    processes: int
    """Of this machine."""
    scheduler: str | None = None
    """Of a Dask cluster, which then does it all."""


def campaign(
    what: Path | str | Mapping[str, Any],
    out: Path | str,
    *,
    processes: int | None = None,
    dask: str | None = None,
) -> "pa.Table":
    """Fly a campaign, or what is missing of it, and give its flights as a table.

    Args:
        what: a TOML file, or its tables: `{"campaign": {"flights": 100, "family": "declared"}}`.
        out: the folder that keeps them; a stopped run goes on there.
        processes: of this machine; all cores if left out.
        dask: the address of a Dask scheduler that flies them instead.

    Returns:
        a row each flight; `.to_pandas()` makes a data frame of it.

    Raises:
        ValueError: naming what is wrong with the file, or with the folder.
        MissingExtra: without pyarrow: pip install 'relguide[parquet]'.
    """
    asked = read_campaign(what) if isinstance(what, Mapping) else load_campaign(what)
    workers = FlightWorkers(processes or count_cores(), dask)
    fly_campaign(asked, Path(out), workers, print_nothing)
    return read_table(Path(out))


def print_nothing(sentence: str) -> None:
    """Say nothing."""


def fly_campaign(
    asked: Campaign, out: Path, workers: FlightWorkers, say: Callable[[str], None]
) -> int:
    """Fly what is missing of a campaign.

    Args:
        asked: what to fly.
        out: the folder that keeps the flights.
        workers: the processes that fly.
        say: called with a sentence while a cluster has no workers.

    Returns:
        how many flights were flown now.

    Raises:
        ValueError: if the folder holds something else, or another run is writing it.
    """
    need("pyarrow")
    manifest = begin_folder(out, asked)
    with locked(out / ".lock", f"{out} is being flown by another run."):
        chunks = list(chunks_of(asked))
        missing = [chunk for chunk in chunks if part_name(chunk.number) not in manifest.parts]
        parts = dict(manifest.parts)
        kept_at, flown = monotonic(), 0
        try:
            with progress_bar("flying", total=float(asked.total)) as advance:
                advance(float(sum(part.rows for part in parts.values())))
                for chunk, part in _flown_parts(asked, missing, workers, say):
                    name = part_name(chunk.number)
                    parts[name] = keep_part(out, name, part.content, part.rows)
                    advance(float(part.rows))
                    flown += part.rows
                    if monotonic() - kept_at > KEPT_EVERY:
                        write_manifest(out, replace(manifest, parts=dict(parts)))
                        kept_at = monotonic()
        finally:
            write_manifest(out, replace(manifest, parts=dict(parts)))
    return flown


def chunks_of(asked: Campaign) -> Iterator[PartChunk]:
    """The parts of a campaign, the same whoever flies them."""
    size = min(max(asked.total // PARTS, LEAST_ROWS), MOST_ROWS)
    for number, first in enumerate(range(0, asked.total, size)):
        yield PartChunk(number, first, min(first + size, asked.total))


def _flown_parts(
    asked: Campaign,
    chunks: list[PartChunk],
    workers: FlightWorkers,
    say: Callable[[str], None],
) -> Iterator[tuple[PartChunk, FlownPart]]:
    task = partial(fly_part, asked)
    if not chunks:
        return
    with ExitStack() as stack:
        if workers.scheduler is not None:
            from relguide.parallel.cluster import cluster

            machines = stack.enter_context(cluster(workers.scheduler, say))
            yield from in_order(task, chunks, machines, 1)
        elif workers.processes > 1:
            _load_kernels(asked)
            count = min(workers.processes, len(chunks))
            executor = stack.enter_context(start_processes(count))
            yield from in_order(task, chunks, executor, count)
        else:
            for chunk in chunks:
                yield chunk, task(chunk)


def _load_kernels(asked: Campaign) -> None:
    """Fly half a minute, so that copies of this process begin with all that is compiled."""
    for _ in islice(documents_of(draw_flight(asked, 0).case), LOADING):
        pass


def fly_part(asked: Campaign, chunk: PartChunk) -> FlownPart:
    """Fly the flights of a part, anywhere."""
    rows = [fly_one(asked, flight) for flight in range(chunk.first, chunk.last)]
    return FlownPart(encode_part(rows, asked), len(rows))


def fly_one(asked: Campaign, flight: int) -> dict[str, Any]:
    """Fly one; its row, with what was drawn. An exception is a row that says so."""
    values: Mapping[str, float] = {}
    try:
        drawn = draw_flight(asked, flight)
        values = drawn.values
        row = fly_case(drawn.case)
    except Exception as error:
        number, at = divmod(flight, len(asked.points))
        point = asked.points[at]
        values = values or point.values
        row = failed_row(point.family, number, error)
    return {"flight": flight, **values, **asdict(row)}

"""What `relguide audit` does: bars, tables and figures around `learn/audit` and its like."""

import sys
from pathlib import Path
from typing import Any

import orjson

from relguide.learn.audit import Audit, Group, audit_as_json, audit_of
from relguide.learn.judging import audit_request, judged, latencies
from relguide.learn.network import load_network
from relguide.learn.shares import Share
from relguide.training import collected, workers


def audit_network(
    file: Path | None,
    *,
    count: int,
    seed: int,
    threads: int | None,
    scheduler: str | None,
    as_json: bool,
) -> None:
    """Audit a network and print what is found.

    Args:
        file: its weights; those that come with the program if none is given.
        count: how many fresh situations to judge it in.
        seed: of them; not the training's.
        threads: how many; all cores if none is given.
        scheduler: of the Dask cluster to judge them on, as an address; this machine if none.
        as_json: one JSON object; a table otherwise.
    """
    network = load_network() if file is None else load_network(file)
    request = audit_request(network, count, seed)
    with workers(threads, scheduler) as pool:
        audit = audit_of(collected(judged(network, request, pool), request, "auditing"))
    asked = latencies(network, request)
    if as_json:
        about = {
            "situations": count,
            "seed": seed,
            "least_share": network.least_share,
            "network": network.about,
        }
        latency = {name: {"p50_us": low, "p99_us": high} for name, (low, high) in asked.items()}
        _print_json(about | audit_as_json(audit) | {"latency": latency})
        return
    _print_audit(audit)
    _write(
        "One query, median and 99th percentile: "
        + ", ".join(f"{name} {low:.1f} / {high:.1f} µs" for name, (low, high) in asked.items())
        + ".\n"
    )


def _print_audit(audit: Audit) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("situations", no_wrap=True)
    headings = ("number", "right, % (95 %)", "in 2", "set", "passed", "gap p99.9", "max, %")
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    for group in audit.groups:
        table.add_row(*_row(group))
    table.add_section()
    for group in audit.classes:
        table.add_row(*_row(group))
    Console(width=100).print(table)


def _row(group: Group) -> tuple[str, ...]:
    first, second, _ = group.tops
    low, high = first.interval
    return (
        group.name,
        f"{group.size:,}",
        f"{_percent(first)} ({100.0 * low:.2f}–{100.0 * high:.2f})",
        _percent(second),
        f"{group.mean_set:.2f}",
        _percent(group.fallbacks),
        f"{100.0 * group.gaps[-2]:.2g}",
        f"{100.0 * group.gaps[-1]:.2g}",
    )


def _percent(share: Share) -> str:
    return f"{100.0 * share.hits / share.of:.2f}" if share.of else "–"


def _print_json(content: dict[str, Any]) -> None:
    _write(orjson.dumps(content, option=orjson.OPT_INDENT_2).decode() + "\n")


def _write(text: str) -> None:
    sys.stdout.write(text)
    sys.stdout.flush()

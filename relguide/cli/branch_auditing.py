"""What `relguide audit` does: bars, tables and figures around `learn/audits`."""

from collections.abc import Sequence
from math import hypot, inf
from pathlib import Path
from typing import Any

from relguide.cli.audit_tables import percent, print_table, short, table, with_interval
from relguide.cli.branch_training import collected, workers
from relguide.cli.output import write, write_json
from relguide.figures.area_figure import check_figure
from relguide.learn.audits.branch_audit import Audit, Group, Miss, audit_as_json, audit_of
from relguide.learn.audits.branch_judging import audit_request, judged, latencies
from relguide.learn.audits.side_by_side import (
    Ground,
    Method,
    drawn_ground,
    method_as_json,
    side_by_side,
    two,
)
from relguide.learn.tree.nearest import lookup_in
from relguide.learn.tree.regular_network import load_regular, shipped
from relguide.learn.tree.reverse_dp import grow_order, planted, tree_from
from relguide.learn.tree.tree import Tree, TreeParameters
from relguide.learn.words.branch_network import BranchNetwork, load_network
from relguide.planning.progress import progress_bar, watched
from relguide.units import DEG

LARGEST = 10
"""Gaps printed."""


def audit_network(
    file: Path | None,
    *,
    count: int,
    seed: int,
    beside: int,
    figures: Path | None,
    threads: int | None,
    scheduler: str | None,
    as_json: bool,
) -> None:
    """Audit a network and print what is found.

    Args:
        file: its weights; those that come with the program if none is given.
        count: how many fresh situations to judge it in.
        seed: of them; not the training's.
        beside: in how many others to judge it side by side with the baselines; 0: in none.
        figures: a folder to draw into, if any.
        threads: how many; all cores if none is given.
        scheduler: of the Dask cluster to judge them on, as an address; this machine if none.
        as_json: one JSON object; tables otherwise.
    """
    if figures is not None:
        figures.mkdir(parents=True, exist_ok=True)
        check_figure(figures / "audit.svg")
    network = load_network() if file is None else load_network(file)
    request = audit_request(network, count, seed)
    with workers(threads, scheduler) as pool:
        chunks = collected(judged(network, request, pool), request, "auditing")
    with progress_bar("explaining gaps", total=0.0) as advance:
        audit = audit_of(chunks, advance)
    asked = latencies(network, request)
    ground, methods = _beside(network, beside, seed) if beside else (None, [])
    if figures is not None:
        from relguide.figures.branch_figure import draw_audit

        draw_audit(audit, methods, network.least_share, figures)
    if as_json:
        about = {
            "situations": count,
            "seed": seed,
            "least_share": network.least_share,
            "network": network.about,
        }
        latency = {name: {"p50_us": low, "p99_us": high} for name, (low, high) in asked.items()}
        found: dict[str, Any] = about | audit_as_json(audit) | {"latency": latency}
        if ground is not None:
            found["side_by_side"] = {
                "situations": len(ground),
                "left_out_the_limit_binds": ground.binding,
                "methods": {method.name: method_as_json(method) for method in methods},
            }
        write_json(found)
        return
    _print_audit(audit)
    write(
        "One query, median and 99th percentile of CPU time: "
        + ", ".join(f"{name} {low:.1f} / {high:.1f} µs" for name, (low, high) in asked.items())
        + ".\n"
    )
    _print_gaps(audit)
    if ground is not None:
        _print_methods(ground, methods)


def _beside(network: BranchNetwork, count: int, seed: int) -> tuple[Ground, list[Method]]:
    """Draw the ground, grow the tree, and judge all on it."""
    regressions = [load_regular(shipped(method)) for method in ("paper", "direct")]
    parameters = regressions[0].parameters
    with progress_bar("drawing situations", total=count) as advance:
        ground = drawn_ground(parameters, count, seed, advance)
    lookup = lookup_in(_grown(parameters))
    found = watched(
        enumerate(side_by_side(ground, network, lookup, regressions), start=1),
        title="side by side",
        total=2 + len(regressions),
        done=lambda item: item[0],
    )
    return ground, [method for _, method in found]


def _grown(parameters: TreeParameters) -> Tree:
    growth = planted(parameters)
    while not growth.finished:
        *_, growth = watched(
            grow_order(growth),
            title=f"growing order {growth.order + 1}",
            total=len(growth.latest),
            done=lambda block: block.next,
        )
    return tree_from(growth, {})


def _print_audit(audit: Audit) -> None:
    shown = table("situations")
    headings = ("number", "right, % (95 %)", "in 2", "set", "passed", "gap p99.9", "max, %")
    for heading in headings:
        shown.add_column(heading, justify="right", no_wrap=True)
    for group in audit.groups:
        shown.add_row(*_row(group))
    shown.add_section()
    for group in audit.classes:
        shown.add_row(*_row(group))
    print_table(shown)


def _row(group: Group) -> tuple[str, ...]:
    first, second, _ = group.tops
    return (
        group.name,
        f"{group.size:,}",
        with_interval(first),
        percent(second),
        f"{group.mean_set:.2f}",
        percent(group.fallbacks),
        f"{100.0 * group.gaps[-2]:.2g}",
        f"{100.0 * group.gaps[-1]:.2g}",
    )


def _print_gaps(audit: Audit) -> None:
    """The gaps above 0.01 %, and what explains them."""
    looked_at = (
        f" of the {len(audit.misses):,} largest" if len(audit.misses) < audit.worth.hits else ""
    )
    write(
        f"Slower than the fastest by more than 0.01 %: {audit.worth.hits:,} of "
        f"{audit.worth.of:,} answers. Unexplained{looked_at}: {audit.unexplained:,}.\n"
    )
    if not audit.misses:
        return
    shown = table("gap, %", right=True)
    for heading in ("fastest", "answered"):
        shown.add_column(heading, no_wrap=True)
    for heading in (
        "to its birth",
        "to a switch",
        "V_L/V_P",
        "range, R",
        "heading, °",
        "explained",
    ):
        shown.add_column(heading, justify="right", no_wrap=True)
    for miss in audit.misses[:LARGEST]:
        shown.add_row(*_gap_row(miss))
    print_table(shown)
    write(
        "A gap is explained where the fastest branch is born, or another becomes the fastest, "
        "within\n0.02 R or rad of place and heading.\n"
    )


def _gap_row(miss: Miss) -> tuple[str, ...]:
    x, y, h, alpha = miss.situation
    return (
        f"{100.0 * miss.gap:.2g}",
        miss.fastest,
        miss.answered,
        *(f"{far:.1e}" if far < inf else "none near" for far in (miss.birth, miss.switch)),
        f"{alpha:.3f}",
        f"{hypot(x, y):.2f}",
        f"{h / DEG:.0f}",
        "yes" if miss.explained else "no",
    )


def _print_methods(ground: Ground, methods: Sequence[Method]) -> None:
    encounter = ground.parameters.encounter
    write(
        f"\nSide by side: {len(ground):,} situations within "
        f"{ground.parameters.horizon / 60.0:g} min of the slot, V_P {encounter.pursuer_tas:g} m/s "
        f"at {encounter.max_bank / DEG:g}° of bank,\nV_L {encounter.leader_tas:g} m/s, D "
        f"{encounter.slot_distance / 1e3:g} km, d_min {encounter.min_separation / 1e3:g} km "
        f"({ground.binding:,} more in which the limit binds left out).\n"
    )
    shown = table("")
    for method in methods:
        shown.add_column(method.name, justify="right", no_wrap=True)
    rows = [_column(method) for method in methods]
    for name in rows[0]:
        shown.add_row(name, *(row[name] for row in rows))
    print_table(shown)


def _column(method: Method) -> dict[str, str]:
    """What is printed of a method, by the name of its line."""
    low, high = method.right.interval
    gaps = [short(100.0 * gap) for gap in method.gaps]
    return {
        "fastest branch named, %": percent(method.right),
        "  95 % interval": f"{100.0 * low:.2f}–{100.0 * high:.2f}",
        "branches held": f"{method.mean_set:.2f}",
        **_flown(method),
        "solved: the fastest path, %": percent(method.fastest, 3),
        "  gap, %, 50 / 99 %": " / ".join(gaps[:2]),
        "  gap, %, 99.9 % / largest": " / ".join(gaps[2:]),
        "  passed on, %": percent(method.passed_on, 3),
        "one query, µs, 50 / 99 %": " / ".join(f"{spent:.0f}" for spent in method.latency),
    }


def _flown(method: Method) -> dict[str, str]:
    """Of what a method gives, flown as it is; ours gives no path of its own."""
    names = "as given: in the slot, %", "  off by km, 50 / 99 %", "  off by °, 50 / 99 %"
    if method.reached is None or method.places is None or method.headings is None:
        return dict.fromkeys(names, "–")
    place, heading = two(method.places), two(method.headings)
    values = (
        percent(method.reached, 3),
        f"{place[0] / 1e3:.2f} / {place[1] / 1e3:.1f}",
        f"{heading[0] / DEG:.1f} / {heading[1] / DEG:.0f}",
    )
    return dict(zip(names, values, strict=True))

"""Tables of `relguide audit`: the branch network, alone and beside the paper's methods."""

from collections.abc import Mapping, Sequence
from math import hypot, inf

from relguide.cli.output import write
from relguide.cli.shared_tables import (
    percent,
    print_latency,
    print_table,
    short,
    table,
    with_interval,
)
from relguide.learn.audits.branch_audit import Audit, Group, Miss
from relguide.learn.audits.latency import Latency
from relguide.learn.audits.side_by_side import Ground, MethodResult, two
from relguide.units import DEG

LARGEST = 10
"""Gaps printed."""


def print_audit(
    audit: Audit,
    latency: Mapping[str, Latency],
    ground: Ground | None,
    methods: Sequence[MethodResult],
) -> None:
    """Print what an audit has found.

    Args:
        audit: what to print.
        latency: of a query, by who is asked.
        ground: the situations that other methods were judged in, if there are any.
        methods: these methods.
    """
    _print_groups(audit)
    print_latency(latency)
    _print_gaps(audit)
    if ground is not None:
        _print_methods(ground, methods)


def _print_groups(audit: Audit) -> None:
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


def _print_methods(ground: Ground, methods: Sequence[MethodResult]) -> None:
    encounter = ground.parameters.encounter
    write(
        f"\nSide by side: {len(ground):,} situations within "
        f"{ground.parameters.horizon / 60.0:g} min of the slot, V_P {encounter.pursuer_tas:g} m/s "
        f"at {encounter.max_bank / DEG:g}° of bank,\nV_L {encounter.leader_tas:g} m/s, D "
        f"{encounter.slot_distance / 1e3:g} km, d_min {encounter.min_separation / 1e3:g} km "
        f"({ground.binding:,} more, in which d_min binds, are left out).\n"
    )
    shown = table("")
    for method in methods:
        shown.add_column(method.name, justify="right", no_wrap=True)
    rows = [_column(method) for method in methods]
    for name in rows[0]:
        shown.add_row(name, *(row[name] for row in rows))
    print_table(shown)


def _column(method: MethodResult) -> dict[str, str]:
    """The lines of a method, by their names."""
    low, high = method.right.interval
    gaps = [short(100.0 * gap) for gap in method.gaps]
    return {
        "fastest branch named, %": percent(method.right),
        "  95 % interval": f"{100.0 * low:.2f}–{100.0 * high:.2f}",
        "branches in its set": f"{method.mean_set:.2f}",
        **_endings(method),
        "solved: the fastest path, %": percent(method.fastest, 3),
        "  gap, %, 50 / 99 %": " / ".join(gaps[:2]),
        "  gap, %, 99.9 % / largest": " / ".join(gaps[2:]),
        "  passed on, %": percent(method.passed_on, 3),
        "one query, µs, 50 / 99 %": " / ".join(f"{spent:.0f}" for spent in method.latency),
    }


def _endings(method: MethodResult) -> dict[str, str]:
    """How the paths that a method gives end, flown as given; our networks give none."""
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

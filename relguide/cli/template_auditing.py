"""What `relguide audit --method templates` does: bars, tables and a figure of what it finds."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.cli.audit_tables import percent, print_table, short, table, with_interval
from relguide.cli.branch_training import workers
from relguide.cli.output import write, write_json
from relguide.figures.area_figure import check_figure
from relguide.learn.audits.both_networks import UNIT
from relguide.learn.audits.template_audit import (
    WORTH,
    Late,
    Reason,
    TemplateAudit,
    TemplateGroup,
    TemplateMiss,
    template_audit_as_json,
    template_audit_of,
)
from relguide.learn.audits.template_bound import template_latencies
from relguide.learn.audits.template_judging import (
    TemplateJudged,
    joined_templates,
    judged_templates,
    template_request,
)
from relguide.learn.boundary.template_network import load_template_network
from relguide.learn.words.branch_network import load_network
from relguide.planning.progress import progress_bar

if TYPE_CHECKING:
    from rich.table import Table

LARGEST = 10
"""Gaps printed."""
_LATE = ("answered", "99 %", "99.9 %", "largest", "> 0.1 s, %")
_SHORT = ("99.9 %", "largest", "> 0.1 s", "no way")
_SAID: dict[Reason, str] = {
    "left out": "the right kind is left out of the set",
    "not solved": "held, but not solved next to its guess",
    "of no kind": "the way is of no kind",
}


def audit_template_network(
    file: Path | None,
    *,
    count: int,
    seed: int,
    figures: Path | None,
    threads: int | None,
    scheduler: str | None,
    as_json: bool,
) -> None:
    """Audit a network of ways round the limit and print what is found.

    Args:
        file: its weights; those that come with the program if none is given.
        count: in how many fresh situations in which the limit binds to judge it, and in how many
            more in which it may.
        seed: of them; not the training's.
        figures: a folder to draw into, if any.
        threads: how many; all cores if none is given.
        scheduler: of the Dask cluster to judge them on, as an address; this machine if none.
        as_json: one JSON object; tables otherwise.
    """
    if figures is not None:
        figures.mkdir(parents=True, exist_ok=True)
        check_figure(figures / "audit.svg")
    ways = load_template_network() if file is None else load_template_network(file)
    network = load_network()
    request = template_request(ways, count, seed)
    chunks: dict[int, TemplateJudged] = {}
    with (
        workers(threads, scheduler) as pool,
        progress_bar("auditing", total=request.chunks) as advance,
    ):
        for number, chunk in judged_templates(ways, network, request, pool):
            chunks[number] = chunk
            advance(1.0)
    audit = template_audit_of(chunks)
    asked = template_latencies(ways, joined_templates(chunks).bound.situations)
    if figures is not None:
        from relguide.figures.template_figure import draw_template_audit

        draw_template_audit(audit, figures)
    if as_json:
        latency = {name: {"p50_us": low, "p99_us": high} for name, (low, high) in asked.items()}
        about = {
            "situations": count,
            "seed": seed,
            "least_share": ways.least_share,
            "most": ways.most,
            "doubt": ways.doubt,
            "r_per_v_s": UNIT,
            "network": ways.about,
        }
        write_json(about | template_audit_as_json(audit) | {"latency": latency})
        return
    _print_named(audit)
    _print_late(audit)
    _print_everywhere(audit)
    write(
        "One query where the limit binds, median and 99th percentile of CPU time:\n"
        + ", ".join(f"{name} {low:,.0f} / {high:,.0f} µs" for name, (low, high) in asked.items())
        + ".\n"
    )
    _print_gaps(audit)


def _print_named(audit: TemplateAudit) -> None:
    """How often the right kind is named, and held possible."""
    write("Where the limit binds: how often the first choice is the fastest way.\n")
    shown = table("situations")
    for heading in ("number", "named, % (95 %)", "in its set, %", "set", "answered, %"):
        shown.add_column(heading, justify="right", no_wrap=True)

    _print_groups(audit, shown, _named_row)


def _print_late(audit: TemplateAudit) -> None:
    """How much later than the fastest way what is answered arrives."""
    write(
        "Of what is answered: how much longer it takes than the fastest way, in % of that; later "
        f"by over\n0.1 s where R/V_P = {UNIT:g} s; answers where there is no way; those sooner "
        "than the search's.\n"
    )
    shown = table("situations")
    for heading in (*_LATE, "no way", "sooner"):
        shown.add_column(heading, justify="right", no_wrap=True)

    _print_groups(
        audit,
        shown,
        lambda group: (*_late_row(group.late), _none(group.late), f"{group.late.sooner:,}"),
    )


def _print_groups(
    audit: TemplateAudit, shown: "Table", cells: Callable[[TemplateGroup], tuple[str, ...]]
) -> None:
    """A row a source, and below a row a kind."""
    for groups in (audit.groups, audit.kinds):
        for group in groups:
            shown.add_row(group.name, *cells(group))
        shown.add_section()
    print_table(shown)


def _named_row(group: TemplateGroup) -> tuple[str, ...]:
    return (
        f"{group.size:,}", with_interval(group.named), percent(group.covered),
        f"{group.mean_set:.2f}", percent(group.late.answered),
    )  # fmt: skip


def _late_row(late: Late) -> tuple[str, ...]:
    gaps = [short(100.0 * gap) for gap in late.gaps[1:]] if late.answered.hits else ["–"] * 3
    return (f"{late.answered.hits:,}", *gaps, percent(late.late, 3))


def _none(late: Late) -> str:
    """Answers where there is no way, and how many such situations there are."""
    return f"{late.invented.hits:,} of {late.invented.of:,}"


def _print_everywhere(audit: TemplateAudit) -> None:
    """The networks together, the limit included."""
    write(
        "All situations, the limit included: the first choice of the network that is for it, what "
        "the planner\nby networks passes on of those that have a way, and its gap, in %.\n"
    )
    shown = table("the limit")
    for heading in ("number", "named, % (95 %)", "passed on", *_SHORT):
        shown.add_column(heading, justify="right", no_wrap=True)
    for group in audit.everywhere:
        passed = 100.0 * (1.0 - group.late.answered.value)
        _, *gaps, late = _late_row(group.late)
        shown.add_row(
            group.name, f"{group.size:,}", with_interval(group.named), f"{passed:.2f}", *gaps[1:],
            late, _none(group.late),
        )  # fmt: skip
    print_table(shown)


def _print_gaps(audit: TemplateAudit) -> None:
    """The gaps above 0.1 % where the limit binds, and why."""
    write(
        f"Slower than the fastest way by more than {100.0 * WORTH:g} %: {audit.worth.hits:,} of "
        f"{audit.worth.of:,} answers.\n"
    )
    if not audit.misses:
        return
    for reason, number in audit.reasons.items():
        write(f"  {number:5,}  {_SAID[reason]}\n")
    _print_misses(audit.misses[:LARGEST])


def _print_misses(misses: Sequence[TemplateMiss]) -> None:
    shown = table("gap, %", right=True)
    shown.add_column("late, R/V_P", justify="right", no_wrap=True)
    shown.add_column("fastest", no_wrap=True)
    shown.add_column("its share, %", justify="right", no_wrap=True)
    for heading in ("answered", "why"):
        shown.add_column(heading, no_wrap=True)
    for miss in misses:
        shown.add_row(
            short(100.0 * miss.gap), f"{miss.late:.2g}", miss.fastest, f"{100.0 * miss.share:.2g}",
            miss.answered, miss.reason,
        )  # fmt: skip
    print_table(shown)

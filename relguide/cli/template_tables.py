"""Tables of `relguide audit --method templates`: the network for where d_min binds."""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from relguide.cli.output import write
from relguide.cli.shared_tables import (
    percent,
    print_latency,
    print_table,
    short,
    table,
    with_interval,
)
from relguide.learn.audits.latency import Latency
from relguide.learn.audits.planner_judging import UNIT
from relguide.learn.audits.template_audit import (
    WORTH,
    GapReason,
    Late,
    TemplateAudit,
    TemplateGroup,
    TemplateMiss,
)

if TYPE_CHECKING:
    from rich.table import Table

LARGEST = 10
"""Gaps printed."""
_LATE = ("answered", "99 %", "99.9 %", "largest", "> 0.1 s, %")
_SHORT = ("99.9 %", "largest", "> 0.1 s", "no path")
_SAID: dict[GapReason, str] = {
    "left out": "the right template is left out of the set",
    "not solved": "in the set, but not solved next to its guess",
    "of no template": "the path is of no template",
}


def print_template_audit(audit: TemplateAudit, latency: Mapping[str, Latency]) -> None:
    """Print what an audit has found.

    Args:
        audit: what to print.
        latency: of a query, by who is asked.
    """
    _print_naming(audit)
    _print_late(audit)
    _print_everywhere(audit)
    write("One query where d_min binds.\n")
    print_latency(latency)
    _print_gaps(audit)


def _print_naming(audit: TemplateAudit) -> None:
    """How often the right template is named, and is in the set."""
    write("Where d_min binds: how often the first choice is the fastest path.\n")
    shown = table("situations")
    for heading in ("number", "named, % (95 %)", "in its set, %", "set", "answered, %"):
        shown.add_column(heading, justify="right", no_wrap=True)

    _print_groups(audit, shown, _naming_row)


def _print_late(audit: TemplateAudit) -> None:
    """How much later than the fastest path the answers arrive."""
    write(
        "Of the answers: how much longer they take than the fastest path, in %; how many are late "
        f"by over\n0.1 s where R/V_P = {UNIT:g} s; answers where there is no path; answers faster "
        "than the search's.\n"
    )
    shown = table("situations")
    for heading in (*_LATE, "no path", "faster"):
        shown.add_column(heading, justify="right", no_wrap=True)

    _print_groups(
        audit,
        shown,
        lambda group: (
            *_late_row(group.late),
            _no_path_cells(group.late),
            f"{group.late.sooner:,}",
        ),
    )


def _print_groups(
    audit: TemplateAudit, shown: "Table", cells: Callable[[TemplateGroup], tuple[str, ...]]
) -> None:
    """A row for each source, and below one for each template."""
    for groups in (audit.groups, audit.templates):
        for group in groups:
            shown.add_row(group.name, *cells(group))
        shown.add_section()
    print_table(shown)


def _naming_row(group: TemplateGroup) -> tuple[str, ...]:
    return (
        f"{group.size:,}", with_interval(group.named), percent(group.covered),
        f"{group.mean_set:.2f}", percent(group.late.answered),
    )  # fmt: skip


def _late_row(late: Late) -> tuple[str, ...]:
    gaps = [short(100.0 * gap) for gap in late.gaps[1:]] if late.answered.hits else ["–"] * 3
    return (f"{late.answered.hits:,}", *gaps, percent(late.late, 3))


def _no_path_cells(late: Late) -> str:
    """Answers where there is no path, and how many such situations there are."""
    return f"{late.invented.hits:,} of {late.invented.of:,}"


def _print_everywhere(audit: TemplateAudit) -> None:
    """Both networks together, whether d_min binds or not."""
    write(
        "All situations, whether d_min binds or not: the first choice of the network for each, how "
        "many of\nthose with a path the planner by networks passes on, and its gap, in %.\n"
    )
    shown = table("d_min")
    for heading in ("number", "named, % (95 %)", "passed on", *_SHORT):
        shown.add_column(heading, justify="right", no_wrap=True)
    for group in audit.everywhere:
        passed = 100.0 * (1.0 - group.late.answered.value)
        _, *gaps, late = _late_row(group.late)
        shown.add_row(
            group.name, f"{group.size:,}", with_interval(group.named), f"{passed:.2f}", *gaps[1:],
            late, _no_path_cells(group.late),
        )  # fmt: skip
    print_table(shown)


def _print_gaps(audit: TemplateAudit) -> None:
    """The gaps above 0.1 % where d_min binds, and why."""
    write(
        f"Slower than the fastest path by more than {100.0 * WORTH:g} %: {audit.worth.hits:,} of "
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

"""Flights for people: what happened, and the figures, as tables."""

from collections.abc import Mapping, Sequence
from typing import Any, assert_never

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from relguide.cli.shared_tables import clock, miles
from relguide.contract.flight_summary import FlightSummary, SummaryEvent
from relguide.flying.documents import (
    Alert,
    AssignmentChanged,
    ClearanceNews,
    ControlChanged,
    EngagementChanged,
    LeaderChanged,
    ModeChanged,
    PlanChanged,
    PlanRefused,
    PlanUnavailable,
    PromiseChanged,
    SeparationLost,
    Unable,
)


def print_flight(flight: FlightSummary, figures: Mapping[str, Any]) -> None:
    """Print what happened in a flight, then its figures as `fly --json` names them."""
    console = Console(highlight=False)
    for started in flight.started:
        console.print(Text(started.title or started.scenario, style="bold"))
        for link in started.links:
            limits = f"D {miles(link.slot_distance)}, d_min {miles(link.min_separation)}"
            if link.spacing == "time":
                limits += f", once joined {link.spacing_time:.0f} s behind"
            console.print(Text(f"{link.pursuer} behind {link.leader}, {limits}"))
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    table.add_column("at", justify="right")
    table.add_column("what")
    table.add_column("why", overflow="fold")
    for event in flight.events:
        table.add_row(*_event(event))
    for ended in flight.ended:
        table.add_row(clock(ended.t), "end", ended.message)
    console.print(table)
    if "links" in figures:
        console.print(_links(figures["links"]))
    summary = Table(box=None, show_header=False, pad_edge=False)
    summary.add_column(style="dim")
    summary.add_column()
    for row in _figure_rows(figures).items():
        summary.add_row(*row)
    console.print(summary)


def _links(links: Sequence[Mapping[str, Any]]) -> Table:
    """How the flight of each pursuer of several went."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for name in ("pursuer", "behind", "joined", "least separation", "separation lost"):
        table.add_column(name)
    for link in links:
        table.add_row(
            link["pursuer"],
            link["leader"],
            f"after {clock(link['join_time_s'])}" if link["joined"] else "no",
            miles(link["least_separation_m"]),
            _losses(link["losses"]),
        )
    return table


def _event(event: SummaryEvent) -> tuple[str, str, str]:
    match event:
        case PlanChanged(reason=reason, plan=plan):
            what = f"plan by {plan.planner}: {reason.replace('_', ' ')}"
        case PlanUnavailable(answer=answer):
            return clock(event.t), "no plan", answer.message
        case EngagementChanged(engagement=engagement):
            what = engagement
        case ControlChanged(autopilot=autopilot):
            what = "autopilot" if autopilot else "flown by hand"
        case AssignmentChanged():
            what = "assignment"
        case ClearanceNews(clearance=status):
            what = f"clearance: {status}"
        case PlanRefused():
            what = "plan refused"
        case ModeChanged(mode=mode):
            what = mode
        case PromiseChanged(promised=promised):
            what = f"joins in {clock(promised)}"
        case LeaderChanged(change=change):
            what = f"leader: {change.replace('_', ' ')}"
        case Alert(level=level, subject=subject, cleared=cleared):
            what = f"{subject}: " + ("alert over" if cleared else level)
        case Unable(reason=reason):
            what = f"unable: {reason}"
        case SeparationLost(separation=separation, cause=cause):
            return clock(event.t), f"separation lost: {miles(separation)}", cause
        case _:
            assert_never(event)
    return clock(event.t), what, event.message


def _figure_rows(figures: Mapping[str, Any]) -> dict[str, str]:
    rows = {"flight time": clock(figures["simulated_s"])}
    if "joined" in figures:
        rows |= {
            "joined": f"after {clock(figures['join_time_s'])}" if figures["joined"] else "no",
            "planned at engagement": clock(figures["planned_time_s"]),
            "promised at engagement": clock(figures["promised_s"]),
            "over the optimum": _over_optimum(figures["over_optimum_s"], figures["joined"]),
            "least separation": miles(figures["least_separation_m"]),
            "separation lost": _losses(figures["losses"]),
            "heading swing": f"{figures['heading_swing_deg']:.0f}°",
            "bank reversals": f"{figures['bank_reversals']}",
            "new plans": f"{figures['replans']}, {figures['replans_announced']} announced",
            "while following": f"within {miles(figures['along_error_m'])} along, "
            f"{miles(figures['across_error_m'])} across",
            "planned by": _planners(figures["plans_by"]),
            "fallbacks": f"{figures['fallbacks']}",
            "flown": f"{figures['track_nm']:.1f} NM over the ground",
        }
    if "by_hand" in figures:
        rows["by hand"] = _by_hand(figures["by_hand"])
    if "wall_s" in figures:
        speed = figures["simulated_s"] / max(figures["wall_s"], 1e-9)
        rows["computed in"] = f"{figures['wall_s']:.2f} s, {speed:,.0f} times as fast as it flies"
    return rows


def _over_optimum(seconds: float | None, joined: bool) -> str:
    if not joined:
        return "not joined"
    if seconds is None:
        return "not known: no plan from the start, or a recorded leader"
    return f"{abs(seconds):.0f} s {'sooner' if seconds < 0.0 else 'later'}"


def _by_hand(figures: Mapping[str, Any]) -> str:
    shown, within = figures["with_bars_s"], figures["within_bar_s"]
    bars = f"the bar within 2° for {within / shown:.0%}" if shown > 0.0 else "without bars"
    return f"{clock(figures['time_s'])}, {bars}, within {miles(figures['tube_m'])} of the path"


def _planners(plans_by: Mapping[str, int]) -> str:
    return ", ".join(f"{planner} {plans}" for planner, plans in plans_by.items()) or "none"


def _losses(losses: Sequence[Mapping[str, Any]]) -> str:
    if not losses:
        return "never"
    silent = sum(loss["announced_s"] is None for loss in losses)
    often = "once" if len(losses) == 1 else f"{len(losses)} times"
    return f"{often}, {silent} unannounced"

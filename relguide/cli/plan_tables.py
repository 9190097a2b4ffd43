"""Plans for people: tables in minutes, nautical miles and degrees."""

from collections.abc import Sequence
from typing import assert_never

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from relguide.cli.others_tables import print_levels, print_others
from relguide.cli.shared_tables import clock, miles
from relguide.flying.plan_documents import (
    AlternativeCard,
    AnyAlternativeCard,
    BoundarySegment,
    EarlyAlternativeCard,
    FlownCard,
    MissingAlternativeCard,
    NoPlanCard,
    NotFlownCard,
    PathPoint,
    PathSegment,
    PlanCard,
    StraightSegment,
    TurnSegment,
    UnsafeAlternativeCard,
)
from relguide.flying.verdicts import (
    ComparedPlanner,
    NotChecked,
    OptimalityCheck,
    PlannerVerdict,
    RegularCheck,
)
from relguide.planning.phrases import whole_degrees
from relguide.units import DEG, NM

PROOFS = {
    "relaxation": "optimal: no faster plan exists, with or without the separation limit",
    "certified": "optimal to 0.1 s: no plan that keeps the separation limit is faster by more",
    "bound": "proved to within the lower bound",
    "none": "not proved optimal",
}

PLANNER_NAMES: dict[ComparedPlanner, str] = {
    "exact": "exact",
    "network": "networks",
    "regular_dp": "the paper's tree",
    "printed_network": "the paper's network",
}


def print_plan(card: PlanCard, *, min_separation: float) -> None:
    """Print a plan.

    Args:
        card: what to print.
        min_separation: d_min [m].
    """
    console = Console(highlight=False)
    console.print(
        Text.assemble(
            ("Joins in ", ""),
            (clock(card.time_to_converge), "bold green"),
            f" by {card.word}, {miles(card.length)} through the air",
        )
    )
    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("piece", no_wrap=True)
    for heading in ("at", "lasts", "NM", "turn", "bank", "to", "east NM", "north NM"):
        table.add_column(heading, justify="right", no_wrap=True)
    for segment in card.segments:
        table.add_row(*_row(segment, card.length / card.time_to_converge))
    console.print(table)
    print_levels(console, card.levels)
    keeps = card.separation.least - min_separation
    console.print(
        f"Least separation {miles(card.separation.least)} after {clock(card.separation.at)}: "
        f"{miles(keeps)} more than d_min; proved above {miles(card.separation.proved_above)}."
    )
    print_others(console, card.separation)
    bound = card.optimality.lower_bound
    closed = card.optimality.proof in ("relaxation", "certified")
    gap = "closed" if closed else f"of {card.time_to_converge - bound:.1f} s is open"
    console.print(
        f"{PROOFS[card.optimality.proof].capitalize()} (lower bound {clock(bound)}, gap {gap}). "
        f"Planner {card.planner}, {card.compute:.2f} ms."
    )
    if not card.alternatives:
        return
    others = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True, style="dim")
    others.add_column("instead", no_wrap=True)
    others.add_column("at", justify="right", no_wrap=True)
    others.add_column("turns", justify="right", no_wrap=True)
    others.add_column("passes", no_wrap=True)
    others.add_column("leader on", no_wrap=True)
    others.add_column("why not", overflow="fold")
    for other in card.alternatives:
        others.add_row(*_alternative(other))
    console.print(others)


def print_flown(card: FlownCard | NotFlownCard) -> None:
    """Print when an aircraft that flies a plan joins, and why then."""
    console = Console(highlight=False)
    match card:
        case FlownCard():
            console.print(
                Text.assemble("Flown, it joins in ", (clock(card.join), "bold green"))
                + f" by {card.word}, and comes within {miles(card.least)}. {card.reason}".rstrip()
            )
        case NotFlownCard():
            console.print(Text("It is not flown", "yellow") + f": {card.reason}")
        case _:
            assert_never(card)


def print_verdicts(found: Sequence[PlannerVerdict]) -> None:
    """Print what each planner would fly, and what is wrong with it."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("planner", no_wrap=True)
    table.add_column("word", no_wrap=True)
    for heading in ("joins in", "over exact", "least", "found in"):
        table.add_column(heading, justify="right", no_wrap=True)
    for each in found:
        flown = (each.word, clock(each.time_to_converge), f"{each.over_exact:+.1f} s")
        shown = (*flown, miles(each.least)) if each.word else ("–",) * 4
        style = "" if each.status == "planned" else "yellow"
        spent = f"{each.compute:.2f} ms"
        table.add_row(PLANNER_NAMES[each.planner], *shown, spent, style=style)
    console = Console(highlight=False)
    console.print(table)
    for each in found:
        console.print(f"{PLANNER_NAMES[each.planner].capitalize()}: {each.message}")


def print_no_plan(card: NoPlanCard) -> None:
    """Print why there is no plan."""
    console = Console(highlight=False)
    console.print(Text("No plan", style="bold red") + f" ({card.reason.value})")
    console.print(card.message)


def print_optimality(check: OptimalityCheck) -> None:
    """Print how a plan meets Pontryagin's conditions."""
    console = Console(highlight=False)
    residuals = (
        f"H is within {check.hamiltonian_residual:.1e} of what is due, λ_ψ within "
        f"{check.switching_residual:.1e} s/rad of 0 where it must vanish."
    )
    match check.arrival:
        case "at_once":
            console.print("Pontryagin's conditions ask nothing of a pursuer in the slot.")
            return
        case "release":
            said = Text("Stationary", "green") + ": it arrives as the slot opens, "
            console.print(said + "where no path can be faster.")
            return
        case "free" if check.stationary:
            console.print(Text("Stationary", "green") + f", as eq. (16) asks: {residuals}")
        case "free":
            said = Text("Not stationary", "yellow") + ", a small change would make it faster: "
            console.print(said + residuals)
        case _:
            assert_never(check.arrival)
    for contact in check.contacts:
        console.print(
            f"At {clock(contact.t)} it touches d_min: λ_d rises by {contact.jump:.2e} s/m."
        )
    for boundary_arc in check.boundary_arcs:
        console.print(
            f"From {clock(boundary_arc.start)} to {clock(boundary_arc.end)} it slides along d_min: "
            f"μ is {boundary_arc.least_multiplier:.1e} /m or more."
        )


def print_regular(card: RegularCheck, *, min_separation: float) -> None:
    """Print what is found of a regular trajectory.

    Args:
        card: what to print.
        min_separation: d_min [m].
    """
    console = Console(highlight=False)
    console.print(
        Text.assemble(
            (f"Regular trajectory of order {card.order}", "bold"),
            f": {miles(card.length)} in {clock(card.duration)}",
        )
    )
    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    for heading in ("i", "ε", "θ", "l NM", "turn ≥ NM", "straight ≥ NM", "T* s"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("eq. (20)", no_wrap=True)
    numbered = enumerate(zip(card.triplets, card.pairs, strict=True), start=1)
    for i, (triplet, pair) in reversed(list(numbered)):  # in the order flown
        table.add_row(
            f"{i}",
            f"{triplet.epsilon:+d}",
            f"{triplet.theta / DEG:.2f}°",
            f"{triplet.l / NM:.2f}",
            f"{pair.turn_proved_above / NM:.2f}",
            f"{pair.straight_least / NM:.2f}",
            f"{pair.t_star:.1f}",
            "holds" if pair.keeps_separation else "fails",
        )
    console.print(table)
    off = card.final_error
    console.print(
        _verdict("Reaches the slot", "Misses the slot", card.reaches_slot)
        + f" (18), (19): ends {off.along:z,.1f} m along and {off.left:z,.1f} m left of it, "
        f"heading off by {off.heading_error / DEG:z.3f}°."
    )
    near = card.separation
    console.print(
        _verdict("Keeps d_min", "Comes too close", card.keeps_separation)
        + f" (20): least {miles(near.least)} after {clock(near.at)}, d_min {miles(min_separation)}."
    )
    match card.stationarity:
        case NotChecked(not_checked=why):
            console.print(f"Pontryagin's conditions are not asked. {why}")
        case OptimalityCheck() as check:
            print_optimality(check)


def _alternative(other: AnyAlternativeCard) -> tuple[str, ...]:
    match other:
        case MissingAlternativeCard():
            return other.word, "", "", "", "", other.why
        case EarlyAlternativeCard():
            return other.word, clock(other.time_to_converge), "", "", "", other.why
        case AlternativeCard() | UnsafeAlternativeCard():
            return (
                other.word,
                clock(other.time_to_converge),
                f"{other.turning / DEG:.0f}°",
                other.passes,
                f"its {other.side}",
                other.why,
            )
        case _:
            assert_never(other)


def _verdict(good: str, bad: str, holds: bool) -> Text:
    return Text(good, "green") if holds else Text(bad, "red")


def _row(segment: PathSegment, tas: float) -> tuple[str, ...]:
    match segment:
        case TurnSegment():
            turn, bank = f"{segment.angle / DEG:.1f}°", f"{segment.bank / DEG:.0f}°"
            piece: str = segment.direction
            length = segment.angle * segment.radius
        case StraightSegment():
            piece, turn, bank, length = "straight", "", "", segment.length
        case BoundarySegment():
            piece, turn, bank = f"along d_min, {segment.side}", "", ""
            length = tas * segment.duration
        case _:
            assert_never(segment)
    return (
        piece,
        clock(segment.start.t),
        clock(segment.duration),
        f"{length / NM:.2f}",
        turn,
        bank,
        _heading(segment.end),
        f"{segment.end.x / NM:.2f}",
        f"{segment.end.y / NM:.2f}",
    )


def _heading(point: PathPoint) -> str:
    return f"{whole_degrees(point.heading) or 360:03d}°"

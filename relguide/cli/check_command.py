"""`relguide check`: a regular trajectory, given as the paper's triplets, judged and drawn."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.cli.output import DONE, FAILED, add_form, for_people, say, write_json
from relguide.cli.situation_file import open_input, read_situation

if TYPE_CHECKING:
    from relguide.flying.verdicts import RegularCheck

PURPOSE = "judge a regular trajectory, given as the paper's triplets (ε, θ, l)"
EXAMPLES = """
    relguide check straight.json triplets.json           what holds of it; JSON off a terminal
    relguide check straight.json triplets.json --json    JSON wherever it goes
    relguide check straight.json --figure plan.svg       the fastest plan's own, drawn

    The leader must keep straight: one whose intent turns is refused.
    Triplets are numbered backward from the slot, the one flown last comes first:
    {"triplets": [{"epsilon": 1, "theta_deg": 3.2, "l_m": 0},
                  {"epsilon": -1, "theta_deg": 43.4, "l_m": 267000}]}
    epsilon 1 turns left, -1 right; l_m is the straight after the turn.
    """


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide check`."""
    parser.add_argument(
        "situation", metavar="SITUATION", help="a situation in JSON; - for standard input"
    )
    parser.add_argument(
        "triplets",
        metavar="TRIPLETS",
        nargs="?",
        default="",
        help="triplets in JSON; left out: those of the fastest plan",
    )
    add_form(parser)
    parser.add_argument("--figure", metavar="FILE.svg", type=_drawing, help="draw both tracks")


def run(chosen: argparse.Namespace) -> int:
    """Judge the trajectory: does it reach the slot, keep d_min, and is it stationary?"""
    table = for_people(chosen, "rich")
    if chosen.situation == chosen.triplets == "-":
        raise ValueError("Only one of the two files can come from standard input.")
    from relguide.contract.refusal import ContractError
    from relguide.contract.triplets import regular_from_json
    from relguide.contract.wire import to_wire
    from relguide.flying.regular_card import regular_check
    from relguide.planning.outcome import NoPlan
    from relguide.planning.plan import plan
    from relguide.planning.regular import regular_from_trajectory, trajectory_from_regular

    try:
        situation, _, _ = read_situation(chosen.situation)
    except ContractError as refused:
        if "triplets" in dict(refused.problems):
            raise ValueError(
                f"{chosen.situation} holds triplets: name the situation before them."
            ) from None
        raise
    if chosen.triplets:
        with open_input(chosen.triplets) as stream:
            content = stream.read()
        try:
            regular = regular_from_json(content)
        except ContractError as refused:
            raise ValueError(f"{chosen.triplets}: {refused}") from None
    else:
        planned = plan(situation)
        if isinstance(planned, NoPlan):
            say(planned.message)
            return FAILED
        radius = situation.pursuer.turn_radius
        regular = regular_from_trajectory(planned.trajectory, turn_radius=radius)
    found = regular_check(regular, situation)
    wrong = " and ".join(_failures(found))
    if chosen.figure:
        from relguide.figures.tracks_figure import draw
        from relguide.units import NM

        picture = draw(
            trajectory_from_regular(regular, situation),
            situation,
            nodes=found.nodes,
            closest_at=found.separation.at,
            title=f"Regular trajectory of order {found.order}: {found.duration:,.0f} s, "
            f"least separation {found.separation.least / NM:.2f} NM"
            + (f"; failed: it {wrong}" if wrong else ""),
        )
        Path(chosen.figure).write_text(picture, "utf-8")
        if wrong:
            say(f"{chosen.figure} shows a trajectory that {wrong}.")
    if table:
        from relguide.cli.plan_tables import print_regular

        print_regular(found, min_separation=situation.min_separation)
    else:
        write_json(to_wire(found))
    return DONE if found.passed else FAILED


def _failures(found: "RegularCheck") -> list[str]:
    """What a trajectory does wrong; empty if it passed."""
    if found.passed:
        return []
    wrong = []
    if not found.reaches_slot:
        wrong.append("misses the slot")
    if not found.keeps_separation:
        wrong.append("comes too close")
    return wrong or ["is not stationary"]


def _drawing(text: str) -> str:
    if Path(text).suffix.lower() != ".svg":
        raise argparse.ArgumentTypeError(f"must end in .svg, not be {text}")
    return text

"""`relguide picture`: the navigation display at one instant of a flight, as a file."""

import argparse
import shlex
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.cli.output import DONE, say
from relguide.cli.shared_options import seconds
from relguide.planning.extras import need

if TYPE_CHECKING:
    from relguide.flying.documents import Document

PURPOSE = "draw the navigation display at one instant of a flight"
EXAMPLES = """
    relguide picture flight.jsonl --at 560 --out nd.svg             of a recording
    relguide picture fig_6b --at 560 --out nd.png                   of a scenario, flown first
    relguide picture fig_6b --at 560 --out nd.svg --light           for paper
    relguide picture fig_6b --at 560 --out nd.svg --mode ROSE --range 80
    """
FORMS = (".svg", ".png")
RECORDINGS = (".jsonl", ".jsonl.gz")
LONGEST = 43_200.0
"""The latest instant of any flight [s]."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide picture`."""
    from relguide.pictures.picture import RANGES_NM

    parser.add_argument(
        "flight",
        metavar="FLIGHT",
        help="a recording (.jsonl, .jsonl.gz), or the name of a scenario",
    )
    parser.add_argument("--at", metavar="SECONDS", type=_instant, required=True, help="flight time")
    parser.add_argument(
        "--out", metavar="FILE", type=_drawing, required=True, help="written here: .svg or .png"
    )
    parser.add_argument(
        "--mode",
        choices=("ARC", "ROSE"),
        default="ARC",
        help="ARC looks ahead, ROSE all round; default: ARC",
    )
    parser.add_argument(
        "--range",
        metavar="NM",
        type=int,
        choices=RANGES_NM,
        help="of the map; default: the smallest with path, leader and slot in sight",
    )
    parser.add_argument("--light", action="store_true", help="dark on white, for paper")


def run(chosen: argparse.Namespace) -> int:
    """Draw it and write the file."""
    out = Path(chosen.out)
    need("quickjs", *(["resvg_py"] if out.suffix == ".png" else []))
    from relguide.pictures.picture import picture

    drawn = picture(
        chosen.flight if chosen.flight.endswith(RECORDINGS) else _flown(chosen.flight, chosen.at),
        chosen.at,
        mode=chosen.mode,
        range_nm=chosen.range,
        palette="light" if chosen.light else "dark",
        caption=_command(chosen),
    )
    if out.suffix == ".png":
        out.write_bytes(drawn.png())
    else:
        out.write_text(drawn + "\n", encoding="utf-8")
    say(f"{out} is written.")
    return DONE


def _flown(name: str, until: float) -> "Iterable[Document]":
    """The documents of a scenario, flown as they are asked for."""
    from relguide.flying.flight import fly
    from relguide.flying.scenarios import scenario
    from relguide.planning.plan import plan
    from relguide.planning.progress import show_progress

    if Path(name).is_file():
        raise ValueError(
            f"{name} is no recording: its name would end in .jsonl or .jsonl.gz. "
            f"`relguide fly {name} --record flight.jsonl` makes one."
        )
    return show_progress(
        fly(scenario(name), plan, sample_period=1.0),
        title=f"flying {name}",
        total=until,
        done=lambda document: document.t,
    )


def _command(chosen: argparse.Namespace) -> str:
    """What makes the same picture again."""
    words = ["relguide", "picture", Path(chosen.flight).name, "--at", f"{chosen.at:g}"]
    words += ["--mode", chosen.mode] if chosen.mode != "ARC" else []
    words += ["--range", str(chosen.range)] if chosen.range is not None else []
    words += ["--light"] if chosen.light else []
    return shlex.join([*words, "--out", Path(chosen.out).name])


def _instant(text: str) -> float:
    return seconds(text, 0.0, LONGEST)


def _drawing(text: str) -> str:
    if not text.endswith(FORMS):
        raise argparse.ArgumentTypeError(f"must end in .svg or .png, not be {text}")
    return text

"""`relguide replay`: what a recording holds."""

import argparse
from typing import Any

from relguide.cli.output import DONE, FAILED, add_form, for_people, say, write_json

PURPOSE = "show what a recording holds"
EXAMPLES = """
    relguide replay flight.jsonl           what happened, when and why
    relguide replay flight.jsonl --json    the figures as JSON
    """


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide replay`."""
    parser.add_argument("file", metavar="FILE", help="made by relguide fly --record")
    add_form(parser)


def run(chosen: argparse.Namespace) -> int:
    """Print what is good of a recording; done if that is all of it."""
    table = for_people(chosen, "rich")
    from relguide.contract.flight_summary import figures, summarize
    from relguide.contract.recorder import replay
    from relguide.planning.progress import show_progress

    flight = summarize(
        show_progress(replay(chosen.file), title="reading", total=0.0, done=lambda _: 0.0)
    )
    whole = bool(flight.ended) and not flight.broken
    result: dict[str, Any] = {"simulated_s": flight.last_time}
    if flight.ended:
        result = figures(flight) | {"plans_by": flight.plans_by}
    if table:
        from relguide.cli.flight_tables import print_flight

        print_flight(flight, result)
    else:
        about = {
            "scenario": "".join(started.scenario for started in flight.started),
            "title": "".join(started.title for started in flight.started),
            "documents": flight.documents,
            "complete": whole,
        }
        write_json(about | result)
    if not whole:
        say(
            flight.broken
            or f"{chosen.file} ends before its flight does; it may still be being written."
        )
    return DONE if whole else FAILED

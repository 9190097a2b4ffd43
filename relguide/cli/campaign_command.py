"""`relguide campaign`: thousands of flights drawn at random, and what became of them."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from relguide.cli.output import DONE, FAILED, add_form, for_people, say, write, write_json
from relguide.cli.shared_options import add_workers
from relguide.planning.extras import need

if TYPE_CHECKING:
    from relguide.campaign.draw import DrawnFlight

PURPOSE = "fly thousands of flights drawn at random, and report what became of them"
EXAMPLES = """
    relguide campaign examples/campaign.toml --dry-run   what it would fly
    relguide campaign examples/campaign.toml --out runs/wind
                                                         fly it on all cores; after a stop, go on
    relguide campaign keys                               what may be varied or swept
    relguide campaign report runs/wind                   shares, quantiles, differences, the worst
    relguide campaign report runs/wind --figure wind.svg and the distributions, drawn
    relguide campaign show runs/wind 17                  fly one again and print it
    relguide campaign replay runs/wind 17 --record a.jsonl
                                                         fly one again and record it
    """
DEEDS = {"keys": 0, "report": 1, "show": 2, "replay": 2}
"""What may be done besides flying, and how many words follow."""
AFTER = ("nothing after it", "DIR", "DIR N")
"""These words, for people, by how many they are."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide campaign`."""
    parser.add_argument(
        "words",
        nargs="+",
        metavar="FILE.toml | keys | report DIR | show DIR N | replay DIR N",
        help="a campaign to fly, what one may vary or sweep, or what to do with its folder",
    )
    parser.add_argument("--out", metavar="DIR", type=Path, help="keep the flights there")
    parser.add_argument(
        "--dry-run", action="store_true", help="fly nothing: say what would be flown"
    )
    parser.add_argument(
        "--figure", metavar="FILE", type=Path, help="of report: an .svg, .png or .pdf file"
    )
    parser.add_argument(
        "--record", metavar="FILE", type=Path, help="of replay: default DIR/flight-N.jsonl"
    )
    add_workers(parser, "processes")
    add_form(parser)


def run(chosen: argparse.Namespace) -> int:
    """Fly a campaign, say what one may vary, or do something with its folder."""
    deed, *rest = chosen.words
    if deed not in DEEDS:
        if rest:
            raise ValueError(
                f"{deed} is followed by {rest[0]}: give one FILE.toml, or report DIR, show DIR N, "
                "replay DIR N or keys."
            )
        return _fly(chosen, deed)
    if len(rest) != DEEDS[deed]:
        raise ValueError(f"relguide campaign {deed} takes {AFTER[DEEDS[deed]]}.")
    if deed == "keys":
        return _keys(chosen)
    if deed == "report":
        return _report(chosen, Path(rest[0]))
    return _fly_again(chosen, Path(rest[0]), rest[1], record=deed == "replay")


def _keys(chosen: argparse.Namespace) -> int:
    from relguide.campaign.keys import KEYS

    if for_people(chosen, "rich"):
        from relguide.cli.campaign_tables import print_keys

        print_keys(KEYS)
    else:
        write_json(
            {
                name: {"least": key.limits.low, "most": key.limits.high, "says": key.says}
                for name, key in KEYS.items()
            }
        )
    return DONE


def _fly(chosen: argparse.Namespace, file: str) -> int:
    from relguide.campaign.campaign_file import load_campaign
    from relguide.campaign.run import FlightWorkers, chunks_of, fly_campaign
    from relguide.parallel.pool import count_cores

    need("pyarrow")
    asked = load_campaign(file)
    if chosen.dry_run:
        from relguide.campaign.draw import draw_flight

        parts = sum(1 for _ in chunks_of(asked))
        points = [point.name for point in asked.points]
        first = draw_flight(asked, 0)
        write_json(
            asked.as_tables()
            | {"points": points, "total": asked.total, "parts": parts}
            | {"flight_0": dict(first.values) | {"code": first.case.as_code().splitlines()}}
        )
        return DONE
    if chosen.out is None:
        raise ValueError("Name the folder that keeps the flights: --out DIR.")
    workers = FlightWorkers(chosen.processes or count_cores(), chosen.dask)
    try:
        flown = fly_campaign(asked, chosen.out, workers, say)
    except KeyboardInterrupt:
        say(f"What is flown is in {chosen.out}: the same command goes on with it.")
        raise
    write(f"{chosen.out}: {asked.total:,} flights, {flown:,} of them flown now.\n")
    return DONE


def _report(chosen: argparse.Namespace, folder: Path) -> int:
    people = for_people(chosen, "rich")
    from relguide.campaign.parts import read_manifest, read_table, row_of_record
    from relguide.campaign.report import FlownRow, report
    from relguide.cli.campaign_tables import print_report, report_as_json

    if chosen.figure is not None:
        from relguide.figures.area_figure import check_figure

        check_figure(chosen.figure)
    asked = read_manifest(folder).campaign
    flown = [
        FlownRow(
            flight=record["flight"],
            point=asked.points[record["flight"] % len(asked.points)],
            row=row_of_record(record),
        )
        for record in read_table(folder).to_pylist()
    ]
    found = report(asked, flown)
    if people:
        print_report(asked, found, folder)
    else:
        write_json(report_as_json(asked, found, folder))
    if len(flown) < asked.total:
        say(f"{len(flown):,} of {asked.total:,} flights are flown: the rest is missing here.")
    if chosen.figure is not None:
        from relguide.campaign.row import FIGURES
        from relguide.figures.campaign_figure import draw_distributions

        draw_distributions(
            {
                figure.heading: {
                    point.name: [
                        value
                        for value, _ in figure.values([o.row for o in flown if o.point == point])
                    ]
                    for point in asked.points
                }
                for figure in FIGURES
            },
            chosen.figure,
        )
    return FAILED if any(one.row.error for one in flown) else DONE


def _fly_again(chosen: argparse.Namespace, folder: Path, word: str, *, record: bool) -> int:
    table = for_people(chosen, "rich")
    from relguide.campaign.draw import draw_flight
    from relguide.campaign.judge import documents_of
    from relguide.campaign.parts import read_manifest
    from relguide.contract import recorder
    from relguide.contract.flight_summary import figures, summarize
    from relguide.parallel.program import program

    manifest = read_manifest(folder)
    if not word.isdecimal():
        raise ValueError(f"N must be the number of a flight, not {word}.")
    drawn = draw_flight(manifest.campaign, int(word))
    if dict(program()) != dict(manifest.program):
        say(f"{folder} was flown by another version of relguide: this flight may be another.")
    documents = documents_of(drawn.case)
    file = chosen.record or folder / f"flight-{drawn.flight}.jsonl"
    if record:
        documents = recorder.record(documents, file)
    flight = summarize(documents)
    result = figures(flight) | {"plans_by": flight.plans_by}
    if table:
        from relguide.cli.flight_tables import print_flight

        write(drawn.case.as_code() + "\n")
        print_flight(flight, result)
    else:
        write_json(_about(drawn) | result)
    if record:
        say(f"Recorded in {file}: relguide replay shows it, and the cockpit plays it.")
    return DONE


def _about(drawn: "DrawnFlight") -> dict[str, Any]:
    about = {"flight": drawn.flight, "family": drawn.point.family, "number": drawn.case.number}
    return about | {"values": dict(drawn.values), "code": drawn.case.as_code().splitlines()}

"""`relguide warm-up`: the kernels compiled ahead of their first use."""

import argparse

from relguide.cli.shared_options import count

PURPOSE = "compile ahead of the first use"
EXAMPLES = """
    relguide warm-up                   all that is installed, on all cores
    relguide warm-up --for plan        what planning and flying need
    """
FOR = ("plan", "serve", "all")
"""What it may be for."""


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of `relguide warm-up`."""
    parser.add_argument("--for", dest="wanted", choices=FOR, default="all", help="default: all")
    parser.add_argument(
        "--jobs",
        metavar="N",
        type=count,
        default=0,
        help="processes; default: as many as cores and memory allow",
    )


def run(chosen: argparse.Namespace) -> int:
    """Compile what is not compiled yet, and say where it is kept."""
    from relguide.warm_up import main

    jobs = ["--jobs", f"{chosen.jobs}"] if chosen.jobs else []
    return main(["--for", chosen.wanted, *jobs])

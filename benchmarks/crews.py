"""Whether crews that react get their guidance engaged: `python -m benchmarks.crews --tries 60`.

Half of the tries fly the scenarios, half random flights. A crew designates its leader, reads for 2
to 20 s what is proposed before it accepts, and engages 2 to 30 s after that. A proposal that can no
longer be flown as it was accepted is offered again, and read again. After ten minutes it gives up.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from statistics import median

import numpy as np

from benchmarks.options import positive
from benchmarks.tables import markdown
from relguide.flying.documents import EngagementChanged
from relguide.flying.flight import fly
from relguide.flying.orders import SetEngagement
from relguide.flying.scenarios import SCENARIOS, random_scenario, scenario
from relguide.flying.scripted_crew import CrewOrder, with_crew
from relguide.planning.plan import plan
from relguide.planning.progress import show_progress
from relguide.units import Second

PATIENCE: Second = 600.0
HEADINGS = ("", "tries", "engaged", "offered again", "refused", "after: median", "longest")


@dataclass(frozen=True, slots=True)
class Try:
    """What became of one crew."""

    kind: str
    engaged: Second | None
    """After how long."""
    again: int
    """How often it was offered another proposal than the one it had accepted."""
    refused: int
    """How many of its orders were."""


def main(arguments: list[str] | None = None) -> int:
    """Fly them all, and print the table; 1 if one was not engaged."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.crews", description=__doc__)
    parser.add_argument("--tries", type=positive, default=60)
    tries = parser.parse_args(arguments).tries
    done = show_progress(
        enumerate(fly_all(tries), 1), title="crews", total=tries, done=lambda one: one[0]
    )
    found = [one for _, one in done]
    print(markdown(HEADINGS, [_line(kind, found) for kind in ("scenarios", "random flights")]))  # noqa: T201
    return 1 if any(one.engaged is None for one in found) else 0


def fly_all(tries: int) -> Iterator[Try]:
    """The scenarios in turn and random flights, a crew of its own in each."""
    names = [name for name, one in SCENARIOS.items() if not one.missing()]
    for seed in range(tries):
        rng = np.random.default_rng(seed)
        read, ready = float(rng.uniform(2.0, 20.0)), float(rng.uniform(2.0, 30.0))
        named = seed % 2 == 0
        flown = scenario(names[seed // 2 % len(names)]) if named else random_scenario(seed)
        flight = partial(fly, flown, plan, engagement="off", sample_period=1.0)
        again, refused, engaged = 0, 0, None
        for document in with_crew(crew_of(read, ready), flight):
            if document.t > PATIENCE or engaged is not None:
                break
            match document:
                case EngagementChanged(previous="armed", engagement="designated"):
                    again += 1
                case EngagementChanged(engagement="engaged", t=t):
                    engaged = t
                case EngagementChanged(previous=before, engagement=now) if before == now:
                    refused += 1
        yield Try("scenarios" if named else "random flights", engaged, again, refused)


def crew_of(read: Second, ready: Second) -> tuple[CrewOrder, ...]:
    """A crew that reads for so long before it accepts, and is ready to engage so long after."""
    return (
        CrewOrder(command=SetEngagement(engagement="designated")),
        CrewOrder(on="proposed", after=read, command=SetEngagement(engagement="armed")),
        CrewOrder(on="armed", after=ready, command=SetEngagement(engagement="engaged")),
    )


def _line(kind: str, tries: Sequence[Try]) -> list[str]:
    own = [one for one in tries if one.kind == kind]
    took = [one.engaged for one in own if one.engaged is not None]
    return [
        kind,
        f"{len(own)}",
        f"{len(took)}",
        f"{sum(one.again for one in own)}",
        f"{sum(one.refused for one in own)}",
        f"{median(took):.0f} s" if took else "–",
        f"{max(took):.0f} s" if took else "–",
    ]


if __name__ == "__main__":
    sys.exit(main())

"""Crews that react, by the dozen: does each of them get its guidance engaged?

    python -m benchmarks.crews 60

Half of the tries fly the scenarios, half random flights. A crew designates its leader, reads for 2
to 20 s what is proposed before it accepts it, and engages 2 to 30 s after that. What is no longer as
it was accepted is offered again, and read again. A crew stops trying after ten minutes.
"""

import sys
from collections import Counter
from dataclasses import replace
from functools import partial
from itertools import takewhile

import numpy as np

from relguide.flying.documents import EngagementChanged, ModeChanged, PlanProposed
from relguide.flying.flight import Scenario, fly
from relguide.flying.orders import SetEngagement
from relguide.flying.scenarios import SCENARIOS, random_scenario, scenario
from relguide.flying.scripted_crew import CrewOrder, with_crew
from relguide.planning.phrases import duration
from relguide.planning.plan import plan
from relguide.units import Second

PATIENCE: Second = 600.0


def main(tries: int) -> None:
    """Fly them, and print a line for each and a table."""
    names = [name for name, one in SCENARIOS.items() if not one.missing()]
    tally: Counter[tuple[str, str]] = Counter()
    waits: dict[str, list[float]] = {"scenarios": [], "random": []}
    for seed in range(tries):
        kind = "scenarios" if seed % 2 == 0 else "random"
        name = names[seed // 2 % len(names)] if kind == "scenarios" else f"random {seed}"
        flown = scenario(name) if kind == "scenarios" else random_scenario(seed)
        found = _try(flown, seed)
        print(f"{name:24} {found}", flush=True)
        tally[kind, "tries"] += 1
        tally[kind, "engaged"] += found["engaged"] is not None
        for each in ("offered again", "refused"):
            tally[kind, each] += found[each]
        if found["engaged"] is not None:
            waits[kind].append(found["engaged"])
    for kind, took in waits.items():
        print(
            {what: tally[kind, what] for what in ("tries", "engaged", "offered again", "refused")}
        )
        print(kind, "engaged after", np.percentile(took, (50, 100)) if took else "never")


def _try(flown: Scenario, seed: int) -> dict[str, float | None | int]:
    rng = np.random.default_rng(seed)
    read, ready = float(rng.uniform(2.0, 20.0)), float(rng.uniform(2.0, 30.0))
    crew = (
        CrewOrder(command=SetEngagement(engagement="designated")),
        CrewOrder(on="proposed", after=read, command=SetEngagement(engagement="armed")),
        CrewOrder(on="armed", after=ready, command=SetEngagement(engagement="engaged")),
    )
    engaged, again, refused, proposed = None, 0, 0, 0
    flight = partial(fly, flown, plan, engagement="off", sample_period=1.0, planner_name="exact")
    for document in takewhile(lambda one: one.t < PATIENCE, with_crew(crew, flight)):
        match document:
            case PlanProposed():
                proposed += 1
            case EngagementChanged(previous="armed", engagement="designated"):
                again += 1
            case EngagementChanged(previous=before, engagement=now) if before == now:
                refused += 1
            case EngagementChanged(engagement="engaged", t=t):
                engaged = t
                break
    return {
        "engaged": engaged, "proposed": proposed, "offered again": again, "refused": refused,
        "read": round(read), "ready": round(ready),
    }  # fmt: skip


if __name__ == "__main__":
    main(int(sys.argv[1]))

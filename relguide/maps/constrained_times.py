"""Where the limit binds: the full search for constrained paths, at the nodes of a grid.

It takes some ten ms a node, or up to a second if the leader turns: too long for each vertex of a
line, so between nodes its times are interpolated. The times are still given with their bound:
constrained paths are not proved to be optimal. At each node the work is bounded as in `plan`; the
caller chooses how many nodes are searched, and a server limits them.
"""

from collections.abc import Callable
from dataclasses import replace
from math import inf

import numpy as np

from relguide.kernels.maps.field import DELAY
from relguide.maps.contours import Evaluate, Field, Floats
from relguide.planning.batch import Situations, plan_arrays
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation

CONSTRAINED = DELAY + 1
"""Word number of a constrained path: it touches d_min or slides along it."""
SEARCHED = 64
"""Nodes searched between two reports: about a second."""


def search_nodes(
    situation: Situation, field: Field, x: Floats, y: Floats,
    threads: int | None, progress: Callable[[int], object],
) -> Field:  # fmt: skip
    """The same field, with the times of the exact planner's full search where the limit binds.

    Args:
        situation: all but the pursuer's place counts.
        field: of the nodes. (n,)
        x: of the nodes, east [m]. (n,)
        y: north [m]. (n,)
        threads: how many; all cores if left out. One if the leader turns.
        progress: called with the number of nodes searched since the last call.
    """
    time, words = field.time.copy(), field.words.copy()
    binding = np.flatnonzero(field.limited)
    for first in range(0, len(binding), SEARCHED):
        nodes = binding[first : first + SEARCHED]
        search = _search_each if situation.leader.intent else _search_many
        found = search(situation, x[nodes], y[nodes], threads)
        better = found < time[nodes]
        time[nodes[better]], words[nodes[better]] = found[better], CONSTRAINED
        progress(len(nodes))
    return Field(time=time, lower_bound=field.lower_bound, words=words, limited=field.limited)


def between_nodes(field: Field, x: Floats, y: Floats, evaluate: Evaluate) -> Evaluate:
    """Times between searched nodes: where the limit binds a mean of the four, else `evaluate`'s.

    Args:
        field: of the nodes, row after row. (rows · columns,)
        x: of the columns [m], ascending evenly.
        y: of the rows [m], ascending evenly.
        evaluate: what the field was made by, without the search.
    """
    times = field.time.reshape(len(y), len(x))
    words = field.words.reshape(len(y), len(x))

    def between(east: Floats, north: Floats) -> Field:
        found = evaluate(east, north)
        column = (east - x[0]) / (x[1] - x[0])
        row = (north - y[0]) / (y[1] - y[0])
        i = np.clip(column.astype(np.int64), 0, len(x) - 2)
        j = np.clip(row.astype(np.int64), 0, len(y) - 2)
        u, v = column - i, row - j
        mean = np.zeros(len(east))
        for di, dj, weight in (
            (0, 0, (1.0 - u) * (1.0 - v)),
            (1, 0, u * (1.0 - v)),
            (0, 1, (1.0 - u) * v),
            (1, 1, u * v),
        ):
            counts = weight > 1e-9  # a corner that does not count may be infinite
            mean[counts] += weight[counts] * times[j[counts] + dj, i[counts] + di]
        nearest = words[j + (v > 0.5), i + (u > 0.5)]
        return Field(
            time=np.where(found.limited, mean, found.time),
            lower_bound=found.lower_bound,
            words=np.where(found.limited, nearest, found.words),
            limited=found.limited,
        )

    return between


def _search_many(situation: Situation, x: Floats, y: Floats, threads: int | None) -> Floats:
    pursuer, leader, wind = situation.pursuer, situation.leader, situation.wind
    return plan_arrays(
        Situations(
            pursuer_x=x,
            pursuer_y=y,
            pursuer_heading=pursuer.heading,
            pursuer_tas=pursuer.tas,
            max_bank=pursuer.max_bank,
            leader_x=leader.x,
            leader_y=leader.y,
            leader_heading=leader.heading,
            leader_tas=leader.tas,
            slot_distance=situation.slot_distance,
            min_separation=situation.min_separation,
            wind_east=wind.east,
            wind_north=wind.north,
        ),
        threads=threads,
    ).time_to_converge


def _search_each(situation: Situation, x: Floats, y: Floats, threads: int | None) -> Floats:
    del threads  # a plan is made by one
    times = np.full(len(x), inf)
    for i, (east, north) in enumerate(zip(x.tolist(), y.tolist(), strict=True)):
        planned = plan(replace(situation, pursuer=replace(situation.pursuer, x=east, y=north)))
        if isinstance(planned, Plan):
            times[i] = planned.time_to_converge
    return times

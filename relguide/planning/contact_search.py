"""The least time of all paths that touch d = d_min or keep clear, by halving cells of contacts.

A path that keeps d_min either never touches it, and is then an extremal without the limit that
keeps it, or it has a first contact, and a last one. So none arrives before the fastest such
extremal and the least, over all contacts, of the soonest arrival at the contact and the soonest way
on from there. If that way on breaks the limit, there is another contact, and the last of them
counts too. Contacts are put into cells, of bearing and time, for which all this is bounded at once
(`kernels/bounds/words/contact_bound.py`). The node of paths with the least bound is halved again
and again: that bound is proved, at any moment (`kernels/bounds/search/branch_and_bound.py`).

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from math import inf, pi

import numpy as np

from relguide.kernels.base.clock import now
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.bounds.fronts.around import times_round, unknown_around
from relguide.kernels.bounds.search.branch_and_bound import SEARCHING, begin, go_on, look_around
from relguide.kernels.bounds.search.cell_tree import Problem
from relguide.kernels.bounds.search.nodes import Search
from relguide.kernels.bounds.search.probe import Find, begin_find
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.bounds.words.contact_bound import untouched_bound
from relguide.kernels.bounds.words.sets import Goal
from relguide.kernels.bounds.words.tangent_contacts import tangent_contacts

_QUADRANT_CELLS = 2
"""Cells a quadrant is cut into at first; none may reach into two."""
_LOOKS = {24: 0.02, 36: 5e-3}
"""Before which rounds it is looked around a leader that turns, and how closely [rad]. Elsewhere
than at d_min > R words say more: see `kernels/bounds/search/narrowing.py`."""
_ROUND = 5e-3
"""Time from one report to the next [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Question:
    """How soon can a path that keeps d_min be at a goal? In the slot frame."""

    start: Pose
    scene: Scene
    """With t_release the time before which arrivals do not count."""
    goal: Goal
    horizon: float
    """Contacts after this time do not matter [R/V_P]."""
    paired: float = 2e-5
    """As in `cell_tree.Problem` [rad]: at once where paths that arrive as the slot opens are to
    be ruled out, and else late, since there are many cells of last contacts."""

    def first_contacts(self) -> Iterator[Cell]:
        """All contacts there are, in cells."""
        t_release = self.scene.t_release
        for i, (start, end) in enumerate(self._windows()):
            # until the slot opens a contact leaves so much time, and after that any
            parts = ((start, t_release), (t_release, end))
            for low, high in parts if start < t_release < end == inf else ((start, end),):
                high = min(high, self.horizon)
                if low < high or low == 0.0:
                    yield from _all_cells(i, low, high)

    def spare_contacts(self) -> Iterator[Cell]:
        """All contacts to which a path may come with time to spare, in cells: see `junction`."""
        turns = np.flatnonzero(self.scene.leader[:, 4])
        pieces = int(turns[-1]) + 1 if len(turns) > 0 else 0
        for i, (start, end) in enumerate(islice(self._windows(), pieces)):
            end = min(end, self.horizon)
            if start < end:
                yield from _all_cells(i, start, end)

    def last_contacts(self) -> Iterator[Cell]:
        """All contacts from which the goal is reached, in cells."""
        for i, (start, end) in enumerate(self._windows()):
            end = min(end, self.horizon)
            if start < end or start == 0.0:
                yield from _all_cells(i, start, end)

    def bounds(self, incumbent: float) -> Iterator[float]:
        """Ever better bounds of the time of all paths, up to `incumbent`, where they end."""
        return self.search(incumbent, begin_find(self.start, self.scene, -inf, 0.0, False), 0.0)

    def load(self) -> None:
        """Load the kernels."""
        for _ in self.bounds(0.0):
            pass
        search, problem, firsts = self._begin(0.0)
        look_around(search, problem, firsts, 1.0, inf)

    def search(
        self, incumbent: float, find: Find, gap: float, until: float = inf
    ) -> Iterator[float]:
        """The same; paths that are found on the way lower `incumbent`.

        Args:
            incumbent: arrivals from here on do not matter at first [R/V_P].
            find: takes the fastest path found.
            gap: nor do those from so much before its arrival on [R/V_P].
            until: when no more is wanted, by `clock.now` [s].
        """
        search, problem, firsts = self._begin(incumbent)
        incumbent, state, rounds = problem.incumbent, SEARCHING, 0
        looks = self._looks()
        while state == SEARCHING:
            rounds += 1
            if rounds in looks:
                size = looks[rounds]
                search, problem = look_around(search, problem, firsts, size, until)
            bound, state = go_on(search, problem, find, now() + _ROUND)
            if find.best[1] > 0.0:
                problem = problem._replace(incumbent=min(incumbent, float(find.best[0]) - gap))
            yield bound

    def _begin(self, incumbent: float) -> tuple[Search, Problem, int]:
        """A search that has only begun, and how many cells of first contacts it has."""
        # no path that nowhere touches d_min arrives sooner than the first of these
        incumbent = untouched_bound(self.start, self.scene, self.goal, incumbent)
        table, nothing = times_round(self.scene.alpha, self.scene.d_min), unknown_around()
        tangents = tangent_contacts(self.start, self.scene, incumbent)
        problem = Problem(
            self.start, self.scene, self.goal, table, incumbent, self.paired, nothing, tangents
        )
        first, spare = [*self.first_contacts()], [*self.spare_contacts()]
        last = np.array([*self.last_contacts()])
        search = begin(problem, np.array(first + spare), len(first), last)
        return search, problem, len(first) + len(spare)

    def _looks(self) -> dict[int, float]:
        if len(self.scene.leader) == 1 or self.scene.d_min <= 1.0:
            return {}
        return _LOOKS

    def _windows(self) -> Iterator[tuple[float, float]]:
        """When the leader's pieces begin and end."""
        starts = self.scene.leader[:, 0].tolist()
        return zip(starts, (*starts[1:], inf), strict=True)


def _all_cells(piece: int, start: float, end: float) -> Iterator[Cell]:
    """Cells for all bearings and both sides; none may reach into two quadrants."""
    width = 0.5 * pi / _QUADRANT_CELLS
    for k in range(4 * _QUADRANT_CELLS):
        for side in (1.0, -1.0):
            yield Cell(piece, side, (k + 0.5) * width - pi, 0.5 * width, start, end)

"""Facts of a cell as sole, first or last contact. Each is computed once and kept in the tree.

The turn goes on through a contact, as λ_ψ does. Where other contacts come after it, or before it, a
turn away from the leader goes on for a while as well: see `junction`. Slot frame: lengths in R,
times in R/V_P, angles counter-clockwise.
"""

from math import inf, isnan

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import is_last, soonest_in
from relguide.kernels.bounds.search.cell_tree import (
    AWAY,
    LEAVING,
    LEFT,
    LEFT_END,
    ON,
    ONWARD,
    REACHED,
    SOON,
    TO,
    Problem,
    Tree,
    cell_at,
    size_of,
)
from relguide.kernels.bounds.words.after_spare import Onward, after_spare, before_touching
from relguide.kernels.bounds.words.cell_words import (
    can_be_at,
    can_go_on_to,
    turned_after_bound,
    turned_before_bound,
    word_from,
)
from relguide.kernels.bounds.words.cells import Cell, poses_of
from relguide.kernels.bounds.words.contact_bound import (
    NEVER,
    Passed,
    anyhow,
    cell_bound,
    leaving_bound,
    otherwise,
    spare_bound,
    until_again,
)
from relguide.kernels.bounds.words.found_word import COLUMNS, MOST, UNKNOWN, OpenIntervals
from relguide.kernels.bounds.words.junction import apart_by, beyond_outward, can_touch
from relguide.kernels.bounds.words.sets import EDGE, is_track
from relguide.kernels.bounds.words.tangent_contacts import may_be_tangent

_BY_TURN = 0.1  # how contacts are passed matters in cells smaller than this [rad]
_TO_GOAL, _TO_NEXT, _AGAIN = 5, 6, 7
_ONLY, _TURNED, _BEFORE, _APART = 0, 1, 2, 3  # columns of what is known


@njit(cache=True, nogil=True)
def reach(tree: Tree, problem: Problem, n: int) -> tuple[float, float]:
    """How soon a first contact can be in the cell, and how soon the goal from there.

    Its window of time is narrowed to when contacts are reached that lead to the goal in time.
    """
    known = tree.known[n]
    if isnan(known[SOON]):
        cell = cell_at(tree, n)
        soon, onward, latest, passed = inf, inf, inf, NEVER
        if can_touch(problem.scene, cell):
            start, scene, goal = problem.start, problem.scene, problem.goal
            closely = size_of(tree, n, scene.d_min) < _BY_TURN
            if tree.spare[n]:
                on = _open_of(tree, n, ON, 0)
                soon, onward = spare_bound(start, scene, goal, cell, problem.incumbent, on)
            else:
                to, on = _open_of(tree, n, TO, 0), _open_of(tree, n, ON, 1)
                switch = not closely or may_be_tangent(problem.tangents, cell)
                passed, onward, latest = cell_bound(
                    start, scene, goal, cell, problem.incumbent, closely, switch, to, on
                )
                passed = until_again(scene, cell, 1.0, passed)
                soon = anyhow(passed)
                _keep_open(tree, n, TO, to)
            _keep_open(tree, n, ON, on)
        known[SOON], known[ONWARD] = soon, onward
        if soon < inf and cell.end < inf:
            tree.cells[n, 4] = soon
            tree.cells[n, 5] = min(
                cell.end, max(min(problem.incumbent - onward, latest + EDGE), soon)
            )
        if tree.spare[n] and soon < inf:
            lasts = 0.0
            if soon + onward < problem.incumbent:
                lasts = spare_onward(tree, problem, n).contact
                lasts = min(lasts, beyond_outward(problem.scene, cell, 1.0))
            passed = Passed(inf, inf, inf, soon, soon + lasts)
        _keep(known[REACHED:], passed)
    soon, onward = float(known[SOON]), float(known[ONWARD])
    if soon < inf and is_last(problem.around, problem.scene, cell_at(tree, n)):
        onward = max(onward, leave(tree, problem, n))
    return soon, onward


@njit(cache=True, nogil=True)
def spare_onward(tree: Tree, problem: Problem, n: int) -> Onward:
    """How long it takes from a contact in a cell, come to with time to spare, to the next or goal.

    See `after_spare` [R/V_P]. How soon one can be there is known, see `reach`.
    """
    facts = tree.facts[n]
    if isnan(facts[_TO_GOAL]):
        left = problem.incumbent - float(tree.known[n, SOON])
        onward = after_spare(problem.scene, problem.goal, cell_at(tree, n), left)
        facts[_TO_GOAL], facts[_TO_NEXT] = onward.goal, onward.contact
        facts[_AGAIN] = onward.again
    return Onward(float(facts[_TO_GOAL]), float(facts[_TO_NEXT]), float(facts[_AGAIN]))


@njit(cache=True, nogil=True)
def leave(tree: Tree, problem: Problem, n: int) -> float:
    """How soon the goal can be reached from a last contact in the cell."""
    known = tree.known[n]
    if isnan(known[LEAVING]):
        passed, cell = NEVER, cell_at(tree, n)
        scene, left = problem.scene, problem.incumbent - cell.start
        # elsewhere than as the slot opens that takes as much time as it saves
        asked = isnan(known[SOON]) and is_track(problem.goal, scene.alpha)
        if can_touch(scene, cell) and (not asked or can_be_at(problem.start, scene, cell)):
            closely = size_of(tree, n, scene.d_min) < _BY_TURN
            # words on from the cell itself are known more closely
            on = _open_of(tree, n, AWAY if isnan(known[SOON]) else ON, 0)
            passed = leaving_bound(scene, problem.goal, cell, left, closely, on)
            passed = until_again(scene, cell, -1.0, passed)
            _keep_open(tree, n, AWAY, on)
        known[LEAVING] = anyhow(passed)
        _keep(known[LEFT:], passed)
    return float(known[LEAVING])


@njit(cache=True, nogil=True)
def bury(tree: Tree, n: int) -> None:
    """Put down that no path in time has its last contact in a cell."""
    known = tree.known[n]
    known[LEAVING] = inf
    _keep(known[LEFT:], NEVER)


@njit(cache=True, nogil=True, forceinline=True)
def is_buried(tree: Tree, n: int) -> bool:
    """Whether it is known that no path in time has its last contact in a cell."""
    return bool(tree.known[n, LEAVING] == inf)


@njit(cache=True, nogil=True)
def learn(tree: Tree, n: int) -> None:
    """Let a cell know of leaving it what both its halves know, and so the cell that it is half of.

    Args:
        tree: with the cell.
        n: its number, or −1.
    """
    while n >= 0:
        half = tree.halves[n, 0]
        if half < 0:
            break
        known, one, other = tree.known[n], tree.known[half], tree.known[half + 1]
        if isnan(one[LEAVING]) or isnan(other[LEAVING]):
            break
        raised = False
        for k in range(LEFT_END - LEFT + 1):
            at = LEAVING if k == 0 else LEFT + k - 1
            least = min(one[at], other[at])
            if least > known[at]:
                known[at], raised = least, True
        if not raised:
            break
        n = tree.halves[n, 1]


@njit(cache=True, nogil=True, forceinline=True)
def reached(tree: Tree, problem: Problem, n: int) -> Passed:
    """How soon a first contact can be in the cell, by how it is passed."""
    reach(tree, problem, n)
    known = tree.known[n, REACHED:]
    return Passed(known[0], known[1], known[2], known[3], known[4])


@njit(cache=True, nogil=True, forceinline=True)
def departed(tree: Tree, problem: Problem, n: int) -> Passed:
    """How soon the goal can be reached from a last contact in the cell, by how it is passed."""
    leave(tree, problem, n)
    known = tree.known[n, LEFT:]
    return Passed(known[0], known[1], known[2], known[3], known[4])


@njit(cache=True, nogil=True)
def _open_of(tree: Tree, n: int, which: int, place: int) -> OpenIntervals:
    """What is known to be left of the words of a cell, and room for what is left now."""
    # two may be under way
    room = int(tree.open_of[len(tree.cells), 0]) + place * (MOST + 1)
    if room + MOST < len(tree.open_rows):
        tree.open_rows[room, 0] = UNKNOWN  # as long as no words are looked at
    else:
        room = UNKNOWN
    return OpenIntervals(tree.open_rows, int(tree.open_of[n, which]), room)


@njit(cache=True, nogil=True)
def _keep_open(tree: Tree, n: int, which: int, open_intervals: OpenIntervals) -> None:
    """Keep what is left of the words of a cell, if all of it is there."""
    if open_intervals.room < 0 or not 0.0 <= tree.open_rows[open_intervals.room, 0] <= MOST:
        return
    room, rows = (
        int(tree.open_of[len(tree.cells), 0]),
        int(tree.open_rows[open_intervals.room, 0]) + 1,
    )
    if room < open_intervals.room:
        for k in range(rows):
            for column in range(COLUMNS):
                tree.open_rows[room + k, column] = tree.open_rows[open_intervals.room + k, column]
    tree.open_of[n, which] = room
    tree.open_of[len(tree.cells), 0] = room + rows


@njit(cache=True, nogil=True)
def _keep(known: FloatArray, passed: Passed) -> None:
    for k in range(len(passed)):
        known[k] = passed[k]


@njit(cache=True, nogil=True)
def only_of(tree: Tree, problem: Problem, n: int) -> float:
    """How soon a path can be at the goal whose only contact lies in a cell [R/V_P]."""
    if isnan(tree.facts[n, _ONLY]):
        soon, onward = reach(tree, problem, n)
        only = soon + onward
        if tree.spare[n] and only < problem.incumbent:
            # where that path leads is known already
            only = max(only, soon + spare_onward(tree, problem, n).goal)
        if only < problem.incumbent:
            leaving = leave(tree, problem, n)
            only = max(only, soon + leaving)
        if only < problem.incumbent:
            first, last = reached(tree, problem, n), departed(tree, problem, n)
            # a turn goes on as it was
            turned = min(first.inward + last.inward, first.outward + last.outward)
            looped = min(first.looped + leaving, soon + last.looped)
            only = max(only, min(turned, looped, soon + last.tangent))
        tree.facts[n, _ONLY] = only
    return float(tree.facts[n, _ONLY])


@njit(cache=True, nogil=True)
def spare_between(
    tree: Tree, problem: Problem, n: int, other: Cell, slack: float, before: float, enough: float
) -> float:
    """As `between.word_between`, from contacts of a cell that are come to with time to spare."""
    scene, cell = problem.scene, cell_at(tree, n)
    begin, until = before_touching(scene, cell, spare_onward(tree, problem, n).contact)
    on = word_from(scene, begin, cell.piece, other, slack - until, before, enough - until)
    return until + on


@njit(cache=True, nogil=True)
def may_go_on_to(tree: Tree, problem: Problem, n: int, other: Cell) -> bool:
    """Whether any path from a first contact in a cell is at one of another just when it is there.

    See `cell_words`.
    """
    scene, cell = problem.scene, cell_at(tree, n)
    if cell.end == inf:
        return True
    if tree.spare[n]:
        begin, _ = before_touching(scene, cell, spare_onward(tree, problem, n).contact)
    else:
        begin = poses_of(scene, cell)
    return can_go_on_to(scene, begin, other)


@njit(cache=True, nogil=True)
def turned_goal(tree: Tree, problem: Problem, n: int) -> float:
    """How soon at the goal, if a first contact in a cell is passed in a turn away from the leader.

    That is when others come after it [R/V_P].
    """
    if isnan(tree.facts[n, _TURNED]):
        soon, onward = reach(tree, problem, n)
        first, incumbent = reached(tree, problem, n), problem.incumbent
        goal = inf
        if max(first.turned, first.outward + onward) < incumbent:
            cell = cell_at(tree, n)
            if tree.spare[n]:
                after = spare_onward(tree, problem, n).again
            else:
                turn = max(first.turned - min(incumbent - onward, cell.end + EDGE), 0.0)
                after = turned_after_bound(
                    problem.scene, problem.goal, cell, turn, incumbent - soon
                )
            goal = max(first.turned, first.outward + max(onward, after))
        tree.facts[n, _TURNED] = goal
    return float(tree.facts[n, _TURNED])


@njit(cache=True, nogil=True)
def turned_leave(tree: Tree, problem: Problem, n: int) -> float:
    """How soon at the goal from the beginning of a turn away from the leader.

    It passes a last contact in a cell that has others before it [R/V_P].
    """
    if isnan(tree.facts[n, _BEFORE]):
        leaving, turned = leave(tree, problem, n), departed(tree, problem, n).turned
        cell, incumbent = cell_at(tree, n), problem.incumbent
        if turned < inf and cell.end < inf:
            # the goal is not reached later than in time, nor the contact sooner than this
            since = max(cell.start, soonest_in(problem.around, problem.scene, cell))
            turn, end = (
                max(turned - (incumbent - since), 0.0),
                min(cell.end, incumbent - leaving) + EDGE,
            )
            if turned_before_bound(problem.start, problem.scene, cell, turn, end) == inf:
                turned = inf
        tree.facts[n, _BEFORE] = turned
    return float(tree.facts[n, _BEFORE])


@njit(cache=True, nogil=True)
def may_be_last(tree: Tree, problem: Problem, n: int) -> bool:
    """Whether a path in time may have its last contact in a cell; if not, that is put down."""
    leaving, cell, incumbent = leave(tree, problem, n), cell_at(tree, n), problem.incumbent
    since = max(cell.start, soonest_in(problem.around, problem.scene, cell))
    may_be = since <= cell.end and since + leaving < incumbent
    if may_be:
        last = departed(tree, problem, n)
        away = since + last.outward < incumbent and turned_leave(tree, problem, n) < inf
        may_be = away or since + otherwise(last) < incumbent
    if not may_be:
        bury(tree, n)
    return may_be


@njit(cache=True, nogil=True, forceinline=True)
def apart(tree: Tree, problem: Problem, n: int, pace: float) -> float:
    """For how long there is no other contact after one in a cell, or with pace −1 before it."""
    column = _APART if pace > 0.0 else _APART + 1
    if isnan(tree.facts[n, column]):
        took = apart_by(problem.scene, cell_at(tree, n), pace)
        if pace > 0.0 and tree.spare[n]:
            took = max(took, spare_onward(tree, problem, n).contact)
        tree.facts[n, column] = took
    return float(tree.facts[n, column])

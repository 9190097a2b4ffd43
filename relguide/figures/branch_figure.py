"""draw_audit(…): the pictures of an audit: accuracy, calibration, gaps."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.area_figure import FAINT, INK
from relguide.figures.panels import (
    COLOURS,
    DASHES,
    MARKS,
    PERCENT,
    logarithmic,
    rates_over,
    shares_across,
    two_panels,
    write_figures,
)
from relguide.learn.audits.branch_audit import Audit, Group
from relguide.learn.audits.side_by_side import MethodResult
from relguide.learn.training.shares import Share
from relguide.learn.words.branch_labels import BRANCHES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KM = 1000.0


def draw_audit(
    audit: Audit, methods: Sequence[MethodResult], least_share: float, folder: Path
) -> list[Path]:
    """Draw an audit.

    Args:
        audit: of our network.
        methods: side by side; none: what needs them is left out.
        least_share: of our network, marked where its set is.
        folder: where to; it must exist.

    Returns:
        the files written.
    """
    drawn = {"network_accuracy.svg": _accuracy, "network_calibration.svg": _calibration}
    if methods:
        drawn["network_gaps.svg"] = _gaps
    return write_figures(
        {name: partial(draw, audit, methods, least_share) for name, draw in drawn.items()}, folder
    )


def _accuracy(audit: Audit, methods: Sequence[MethodResult], least_share: float) -> "Figure":
    """How often the fastest branch is the first choice, by group and by branch."""
    del least_share
    figure, (left, right) = two_panels("How often the fastest branch is the first choice")
    groups: list[Group] = [*audit.groups, *audit.classes]
    lines = len(audit.groups), len(groups)
    at = [-(i + (i >= lines[0])) for i in range(lines[1])]
    shares_across(left, [group.tops[0] for group in groups], at, COLOURS[0], MARKS[0])
    left.set_yticks(at, [group.name for group in groups])
    left.axhline(-lines[0], color=FAINT, lw=0.6)
    left.set_title("our network, all encounters", color=INK, fontsize=10)
    left.set_xlabel("right [%], with 95 % interval", color=INK)
    left.set_xlim(None, 100.3)
    for k, method in enumerate(methods):
        offset = 0.24 - 0.16 * k
        places = [-i + offset for i in range(len(BRANCHES))]
        shares_across(right, method.classes, places, COLOURS[k], MARKS[k], method.name)
    right.set_yticks([-i for i in range(len(BRANCHES))], BRANCHES)
    right.set_title("side by side, one encounter, by fastest branch", color=INK, fontsize=10)
    right.set_xlabel("right [%], with 95 % interval", color=INK)
    right.set_xlim(40.0, 102.0)
    if methods:
        right.legend(loc="upper left", fontsize=8, framealpha=1.0)
    return figure


def _calibration(audit: Audit, methods: Sequence[MethodResult], least_share: float) -> "Figure":
    """Whether it is as often wrong as it says, and what a larger set would give."""
    del methods
    figure, (left, right) = two_panels("How sure the network is, and what its set costs")
    low, high = 1e-5, 100.0
    said = [max(PERCENT * doubt.said, low) for doubt in audit.doubts]
    left.plot([low, high], [low, high], color=FAINT, lw=0.9, label="as often as it says")
    rates_over(left, said, [doubt.wrong for doubt in audit.doubts], "is wrong")
    left.set_xscale("log")
    left.set_xlim(0.7 * low, 1.4 * high)
    left.set_ylim(low, 1.4 * high)
    left.set_xlabel("says it is wrong: 1 − highest share [%]", color=INK)
    left.set_ylabel("is wrong [%], 95 % interval", color=INK)
    left.set_title("calibration, random situations", color=INK, fontsize=10)
    sizes = [size.mean_set for size in audit.sets]
    rates_over(
        right, sizes, [size.worth for size in audit.sets], "slower than the fastest by over 0.01 %"
    )
    logs = np.log([size.least_share for size in audit.sets])
    chosen = float(np.interp(np.log(least_share), logs, sizes))
    right.axvline(chosen, color=FAINT, ls="--", lw=1.0, label="the network's set")
    right.set_xlabel("branches in the set, on average", color=INK)
    right.set_ylabel("answers [%], 95 % interval", color=INK)
    right.set_title("what a larger set gives, random situations", color=INK, fontsize=10)
    for axes in (left, right):
        axes.set_yscale("log")
        axes.legend(fontsize=8)
    return figure


def _gaps(audit: Audit, methods: Sequence[MethodResult], least_share: float) -> "Figure":
    """How bad the bad answers are, and where a path flown as it is ends."""
    del audit, least_share
    figure, (left, right) = two_panels("Side by side, one encounter")
    least = 1.0
    for k, method in enumerate(methods):
        worse = method.gap[method.gap > 0.0]
        of = len(method.gap)
        least = min(least, 0.3 / of)
        if len(worse) == 0:
            bound = Share(hits=0, of=of).interval[1]
            left.axhline(
                PERCENT * bound,
                color=COLOURS[k],
                ls=":",
                label=f"{method.name}: none of {of:,}, 95 % bound",
            )
            continue
        share = np.arange(len(worse), 0, -1) / of
        left.step(
            PERCENT * worse, PERCENT * share, color=COLOURS[k], ls=DASHES[k], label=method.name
        )
    left.set_xlim(1e-3, 1e4)
    left.set_ylim(PERCENT * least, PERCENT)
    logarithmic(left, "gap to the fastest path [%]", "answers with a larger gap [%]")
    left.set_title("words solved exactly", color=INK, fontsize=10)
    for k, method in enumerate(methods):
        if method.places is not None:
            share = np.arange(1, len(method.places) + 1) / len(method.places)
            distances = method.places / KM
            right.plot(
                distances, PERCENT * share, color=COLOURS[k], ls=DASHES[k], label=method.name
            )
    right.set_xscale("log")
    right.set_xlim(0.05, None)
    right.set_xlabel("distance of its end from the slot [km]", color=INK)
    right.set_ylabel("paths that end nearer [%]", color=INK)
    right.set_title("flown as given", color=INK, fontsize=10)
    for axes in (left, right):
        axes.legend(fontsize=8)
    return figure

"""Fig. 2: a regular trajectory of order 4, with its triplets (ε_i, θ_i, l_i), (17)–(20)."""

from itertools import pairwise
from math import atan2, cos, degrees, sin
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.style import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PALE,
    aircraft,
    as_map,
    empty_figure,
)
from relguide.flying.regular_card import regular_check
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.regular import RegularTrajectory, Triplet, trajectory_from_regular
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT, Pose, Trajectory
from relguide.units import DEG, NM

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KM = 1000.0
REGULAR = RegularTrajectory(
    triplets=(
        Triplet(turn=LEFT, turn_angle=60.0 * DEG, length=16_000.0),
        Triplet(turn=RIGHT, turn_angle=95.0 * DEG, length=18_000.0),
        Triplet(turn=LEFT, turn_angle=80.0 * DEG, length=15_000.0),
    )
)
"""Numbered backward from the slot; turns that are seen at a glance."""
START = Pursuer(x=0.0, y=0.0, heading=135.0 * DEG, tas=240.0, max_bank=25.0 * DEG)
D, LEADER_TAS = 12_000.0, 200.0


def situation() -> Situation:
    """The one that the trajectory is an answer to: its leader is where the slot must be, (19)."""
    anywhere = _behind(Leader(x=0.0, y=0.0, heading=0.0, tas=LEADER_TAS))
    flown = trajectory_from_regular(REGULAR, anywhere)
    end = flown.pose_at(flown.duration)
    back = LEADER_TAS * flown.duration - D
    return _behind(
        Leader(
            x=end.x - back * sin(end.heading),
            y=end.y - back * cos(end.heading),
            heading=end.heading,
            tas=LEADER_TAS,
        )
    )


def _behind(leader: Leader) -> Situation:
    return Situation(pursuer=START, leader=leader, slot_distance=D, min_separation=5.0 * NM)


def draw(step: Step) -> Drawn:
    """Both tracks to scale; at each turn its ε and θ, along each straight its l, nodes 4 … 1."""
    del step
    asked = situation()
    flown, found = trajectory_from_regular(REGULAR, asked), regular_check(REGULAR, asked)
    figure = empty_figure(9.0, 4.4)
    axes = figure.subplots()
    as_map(axes)
    _tracks(axes, asked, flown)
    starts = np.concatenate(([0.0], np.cumsum(flown.durations())))
    for k, (begin, end) in enumerate(pairwise(starts)):
        number = len(REGULAR.triplets) - k // 2
        times = np.linspace(begin, end, 80)
        poses = [flown.pose_at(float(t)) for t in times]
        if k % 2 == 0:
            _turn(axes, number, REGULAR.triplets[number - 1], poses)
        else:
            _straight(axes, number, poses)
    for k, begin in enumerate((*starts[:-1:2], starts[-1])):
        number = found.order - k
        pose = flown.pose_at(float(begin))
        axes.plot(pose.x / KM, pose.y / KM, "o", color=INK, mfc="white", ms=11, zorder=7)
        axes.text(
            pose.x / KM, pose.y / KM, f"{number}",
            ha="center", va="center_baseline", fontsize=8, zorder=8,
        )  # fmt: skip
    return Drawn(
        figure,
        f"Order {found.order}: {len(REGULAR.triplets)} pairs of a turn at "
        f"{degrees(START.max_bank):.0f}° of bank (R_min = {START.turn_radius / KM:.1f} km) and a "
        f"straight, numbered backward from the slot; Σ(l + R_min θ) = {found.length / KM:.1f} km, "
        f"{found.duration:.0f} s. It ends in the slot to {abs(found.final_error.along):.0f} m and "
        f"keeps {found.separation.least / NM:.1f} NM from the leader.",
    )


def _tracks(axes: "Axes", asked: Situation, flown: Trajectory) -> None:
    times = np.linspace(0.0, flown.duration, 300)
    leader = asked.leader.trajectory
    for path, colour, dashes in ((flown, BLUE, "-"), (leader, ORANGE, "--")):
        poses = [path.pose_at(float(t)) for t in times]
        x, y = [p.x / KM for p in poses], [p.y / KM for p in poses]
        axes.plot(x, y, color=colour, ls=dashes, lw=2.0)
    for path, t, colour, name, offset in (
        (flown, 0.0, BLUE, "pursuer", (-14, 14)),
        (leader, 0.0, ORANGE, "leader at 0 s", (-10, -16)),
        (leader, flown.duration, ORANGE, f"leader at {flown.duration:.0f} s", (-50, -16)),
    ):
        pose = path.pose_at(t)
        aircraft(axes, pose.x / KM, pose.y / KM, degrees(pose.heading), colour)
        axes.annotate(
            name, (pose.x / KM, pose.y / KM), offset, textcoords="offset points", color=colour
        )
    end, ahead = flown.pose_at(flown.duration), leader.pose_at(flown.duration)
    axes.annotate(
        "", (end.x / KM, end.y / KM), (ahead.x / KM, ahead.y / KM),
        arrowprops={"arrowstyle": "<->", "color": GREEN, "lw": 1.2, "shrinkA": 8, "shrinkB": 8},
    )  # fmt: skip
    axes.annotate(
        "$D$", (0.5 * (end.x + ahead.x) / KM, 0.5 * (end.y + ahead.y) / KM), (0, 7),
        textcoords="offset points", color=GREEN, fontsize=12, ha="center",
    )  # fmt: skip


def _turn(axes: "Axes", number: int, pair: Triplet, poses: list[Pose]) -> None:
    """Its centre, two radii, the angle between, and what it is called."""
    first, last, radius = poses[0], poses[-1], START.turn_radius / KM
    side = -pair.turn  # +1: the centre lies to the right
    cx = first.x / KM + side * radius * cos(first.heading)
    cy = first.y / KM - side * radius * sin(first.heading)
    for pose in (first, last):
        axes.plot([cx, pose.x / KM], [cy, pose.y / KM], color=PALE, lw=0.8, ls=(0, (3, 2)))
    axes.plot(cx, cy, "+", color=PALE, ms=6)
    inner = [(cx + 0.45 * (p.x / KM - cx), cy + 0.45 * (p.y / KM - cy)) for p in poses]
    axes.plot([x for x, _ in inner], [y for _, y in inner], color=PALE, lw=1.0)
    middle = poses[len(poses) // 2]
    angle = atan2(middle.y / KM - cy, middle.x / KM - cx)
    axes.text(
        cx - 0.35 * radius * cos(angle), cy - 0.35 * radius * sin(angle),
        f"$\\varepsilon_{number} = {'+' if pair.turn == LEFT else '−'}1$\n"
        f"$\\theta_{number} = {degrees(pair.turn_angle):.0f}°$",
        ha="center", va="center", fontsize=10,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.85},
    )  # fmt: skip


def _straight(axes: "Axes", number: int, poses: list[Pose]) -> None:
    first, middle, last = poses[0], poses[len(poses) // 2], poses[-1]
    turned = degrees(atan2(last.y - first.y, last.x - first.x))
    length = ((last.x - first.x) ** 2 + (last.y - first.y) ** 2) ** 0.5 / KM
    axes.annotate(
        f"$l_{number} = {length:.0f}$ km", (middle.x / KM, middle.y / KM),
        (-10.0 * sin(turned * DEG), 10.0 * cos(turned * DEG)), textcoords="offset points",
        ha="center", va="center", rotation=turned, color=BLUE, fontsize=10,
    )  # fmt: skip


FIGURE = NamedFigure(
    name="fig_2", title="Fig. 2: a regular trajectory of order 4", seconds=1.0, draw=draw
)

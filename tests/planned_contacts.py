"""Where plans touch d_min, in the frame in which it is proved that none is faster."""

from dataclasses import dataclass
from math import atan2, cos, hypot, sin

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Contact, Pose
from relguide.kernels.bounds.fronts.around import times_round, unknown_around
from relguide.kernels.bounds.search.cell_tree import Problem
from relguide.kernels.bounds.words.tangent_contacts import tangent_contacts
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.planning.contact_search import Question
from relguide.planning.outcome import Plan
from relguide.planning.prove import question_of
from relguide.planning.words import candidates


@dataclass(frozen=True, slots=True, kw_only=True)
class Flown:
    """A plan's path in the slot frame."""

    question: Question
    """How soon a path can arrive."""
    time: float
    """How soon this one does [R/V_P]."""
    pieces: list[tuple[float, float]]
    """Turn rate, positive to the left [V_P/R], and duration [R/V_P] of each."""

    def seen(self, t: float) -> tuple[Pose, Pose]:
        """Where the pursuer and the leader are at a time [R/V_P]."""
        x, y, h = self.question.start
        left, leader = t, self.question.scene.leader
        for rate, lasts in self.pieces:
            took = min(left, lasts)
            if abs(rate) < 1e-9:
                x, y = x + took * cos(h), y + took * sin(h)
            else:
                x += (sin(h + rate * took) - sin(h)) / rate
                y -= (cos(h + rate * took) - cos(h)) / rate
            h, left = h + rate * took, left - took
            if left <= 0.0:
                break
        return Pose(x, y, h), leader_at(self.question.scene, piece_at(leader, t), t)

    def outside(self, t: float) -> float:
        """How far outside d_min the pursuer is at a time [R]."""
        at, there = self.seen(t)
        return hypot(at.x - there.x, at.y - there.y) - self.question.scene.d_min

    def contact(self, t: float) -> tuple[Contact, float]:
        """The contact at a time at which there is one, and how far the heading is off it [rad]."""
        at, there = self.seen(t)
        scene = self.question.scene
        bearing = wrap_signed(atan2(at.y - there.y, at.x - there.x) - there.h)
        off = {
            side: abs(wrap_signed(at.h - there.h - contact_heading(bearing, side, scene.alpha)))
            for side in (1.0, -1.0)
        }
        side = min(off, key=off.__getitem__)
        return Contact(piece_at(scene.leader, t), bearing, side), off[side]


def flown(planned: Plan) -> Flown:
    """The path of a plan."""
    pursuer = planned.situation.pursuer
    scale = pursuer.turn_radius / pursuer.tas
    return Flown(
        question=question_of(candidates(planned.situation)),
        time=planned.time_to_converge / scale,
        pieces=[(-rate * scale, took / scale) for took, rate in planned.trajectory.bends()],
    )


def problem_of(asked: Question, incumbent: float) -> Problem:
    """What is asked, of paths that arrive before a time [R/V_P]."""
    scene = asked.scene
    return Problem(
        asked.start, scene, asked.goal, times_round(scene.alpha, scene.d_min), incumbent,
        asked.paired, unknown_around(), tangent_contacts(asked.start, scene, incumbent),
    )  # fmt: skip

"""Plain plans: turns and straights without other paths, as JSON, by the shortest way.

They are nearly all plans there are. Cards and the wire's own encoding (`wire.py`) make the same
object in twice the time; whatever is not plain is left to them.
"""

from math import degrees, isfinite
from typing import Any

from relguide.contract.compass import compass
from relguide.kernels.base.turn import bank_for_turn_radius
from relguide.planning.plan import Plan
from relguide.planning.trajectory import LEFT, Arc, Straight


def plain_plan(plan: Plan) -> dict[str, Any] | None:
    """What `to_wire` gives of a plan's card, without alternatives; `None` if it is not plain."""
    trajectory, wind, tas = plan.trajectory, plan.situation.wind, plan.trajectory.tas
    certificate, arrival, optimality = plan.certificate, plan.arrival, plan.optimality
    east, north = wind.east, wind.north
    segments: list[dict[str, Any]] = []
    poses = iter(trajectory.breakpoints())
    first, t = next(poses), 0.0
    start = {"t_s": 0.0, "x_m": first.x, "y_m": first.y, "heading_deg": _direction(first.heading)}
    for piece, pose in zip(trajectory.segments, poses, strict=True):
        duration = piece.length / tas
        t += duration
        end = {
            "t_s": t,
            "x_m": pose.x + east * t,
            "y_m": pose.y + north * t,
            "heading_deg": _direction(pose.heading),
        }
        if type(piece) is Arc:
            segment = {
                "kind": "turn",
                "direction": "left" if piece.turn == LEFT else "right",
                "angle_deg": degrees(piece.turn_angle),
                "bank_deg": degrees(bank_for_turn_radius(tas, piece.radius)),
                "radius_m": piece.radius,
                "duration_s": duration,
                "start": start,
                "end": end,
            }
        elif type(piece) is Straight:
            segment = {
                "kind": "straight",
                "length_m": piece.length,
                "duration_s": duration,
                "start": start,
                "end": end,
            }
        else:  # a boundary arc, with points that draw it
            return None
        segments.append(segment)
        start = end
    length, time = trajectory.length, trajectory.duration
    numbers = (
        length, time, start["t_s"], start["x_m"], start["y_m"], start["heading_deg"],
        certificate.least_separation, certificate.at_time, certificate.lower_bound,
        arrival.slot_error, arrival.heading_error, arrival.early,
        optimality.lower_bound, plan.compute_time,
    )  # fmt: skip
    # what is not finite on the way is not so at its end
    if not isfinite(sum(numbers)):
        return None
    return {
        "status": "planned",
        "planner": plan.planner,
        "word": plan.word,
        "time_to_converge_s": time,
        "length_m": length,
        "segments": segments,
        "separation": {
            "least_m": float(certificate.least_separation),
            "at_s": float(certificate.at_time),
            "proved_above_m": float(certificate.lower_bound),
        },
        "arrival": {
            "slot_error_m": arrival.slot_error,
            "heading_error_deg": degrees(arrival.heading_error),
            "early_s": arrival.early,
        },
        "optimality": {"proof": optimality.proof, "lower_bound_s": optimality.lower_bound},
        "compute_ms": plan.compute_time,
    }


def _direction(heading: float) -> float:
    return compass(degrees(heading))

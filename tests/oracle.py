"""An oracle that shares nothing with the planner: the equations of motion, integrated by scipy."""

from math import atan2, cos, hypot, pi, sin, tan

import numpy as np
from scipy.integrate import solve_ivp

from relguide import FlyStraight, Situation, Trajectory, TurnTo
from relguide.units import G0

Piece = tuple[float, float]
"""Duration [s] and turn rate [rad/s], positive to the right."""


def pieces_of(trajectory: Trajectory) -> list[Piece]:
    return [
        (length / trajectory.tas, curvature * trajectory.tas)
        for segment in trajectory.segments
        for length, curvature in segment.bends
    ]


def pieces_of_intent(situation: Situation) -> list[Piece]:
    leader, heading, pieces = situation.leader, situation.leader.heading, []
    for piece in leader.intent:
        match piece:
            case FlyStraight():
                pieces.append((piece.duration, 0.0))
            case TurnTo():
                rate = -piece.turn * G0 * tan(piece.bank) / leader.tas
                change = (piece.heading - heading) % (2.0 * pi)
                if 2.0 * pi - change < 1e-9:  # a full turn that only rounding makes is none
                    change = 0.0
                if rate < 0.0:
                    change = (2.0 * pi - change) % (2.0 * pi)
                if 2.0 * pi - change < 1e-6:  # the little that is missing, the other way round
                    change, rate = 2.0 * pi - change, -rate
                pieces.append((change / abs(rate), rate))
                heading = piece.heading
    return pieces


def integrate(
    start: tuple[float, float, float], speed: float, pieces: list[Piece], wind: tuple[float, float],
    until: float,
) -> list[tuple[float, float, float, float]]:  # fmt: skip
    """Fly the pieces over the ground, then straight on: (t, x, y, heading) every second or so."""
    x, y, psi = start
    t = 0.0
    track = [(t, x, y, psi)]
    for duration, rate in [*pieces, (max(until - sum(d for d, _ in pieces), 0.0), 0.0)]:
        duration = min(duration, until - t)
        if duration <= 1e-9:  # shorter than scipy can part; 0.4 µm at most
            continue
        flown = solve_ivp(
            lambda _, s, r=rate: (speed * sin(s[2]) + wind[0], speed * cos(s[2]) + wind[1], r),
            (0.0, duration), (x, y, psi), method="DOP853", rtol=1e-11, atol=1e-8,
            t_eval=np.linspace(0.0, duration, 10 + int(duration)),
        )  # fmt: skip
        track += [(t + s, *state) for s, state in zip(flown.t[1:], flown.y.T[1:], strict=True)]
        t += duration
        x, y, psi = flown.y[:, -1]
    return track


def arrival_error(situation: Situation, trajectory: Trajectory) -> tuple[float, float, float]:
    """Fly both aircraft over the ground and compare with the definition of the slot.

    Returns:
        distance from the slot at the end [m], heading error [rad], least separation seen [m].
    """
    wind = (situation.wind.east, situation.wind.north)
    pursuer, leader = situation.pursuer, situation.leader
    until = trajectory.duration
    ours = integrate(
        (pursuer.x, pursuer.y, pursuer.heading), pursuer.tas, pieces_of(trajectory), wind, until
    )
    intent = pieces_of_intent(situation)
    theirs = integrate((leader.x, leader.y, leader.heading), leader.tas, intent, wind, until)
    _, lx, ly, lpsi = theirs[-1]
    ground = (leader.tas * sin(lpsi) + wind[0], leader.tas * cos(lpsi) + wind[1])
    ground_speed = hypot(*ground)
    slot = (
        lx - situation.slot_distance * ground[0] / ground_speed,
        ly - situation.slot_distance * ground[1] / ground_speed,
    )
    if any(rate != 0.0 and duration > 0.0 for duration, rate in intent):
        opens = sum(d for d, _ in intent) + situation.slot_distance / ground_speed
        assert until >= opens - 1e-6, "arrived before the slot opened"
    _, x, y, psi = ours[-1]
    times = np.array([row[0] for row in ours])
    columns = np.array(theirs)
    separation = np.hypot(
        np.array([row[1] for row in ours]) - np.interp(times, columns[:, 0], columns[:, 1]),
        np.array([row[2] for row in ours]) - np.interp(times, columns[:, 0], columns[:, 2]),
    )
    heading_error = abs(atan2(sin(psi - lpsi), cos(psi - lpsi)))
    return hypot(x - slot[0], y - slot[1]), heading_error, float(separation.min())

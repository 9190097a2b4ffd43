"""Situations of eleven numbers, as situations."""

from math import atan2, cos, hypot, pi, sin, tan, tau

import numpy as np

from relguide import LEFT, RIGHT, FlyStraight, Leader, Pursuer, Situation, TurnTo, Wind
from relguide.kernels.networks.turning_leader import turning_scene

GRAVITY = 9.80665


def situation_of(numbers: np.ndarray, *, final: float, mirrored: bool = False) -> Situation:
    """The situation that these numbers describe, the leader's final heading given [rad].

    The pursuer flies 200 m/s at 25° of bank. With `mirrored` the leader turns right.
    """
    pose, scene = turning_scene(numbers)
    tas, bank, side = 200.0, 25.0 * pi / 180.0, -1.0 if mirrored else 1.0
    radius = tas * tas / (GRAVITY * tan(bank))
    _, _, _, alpha, limit, ahead, left, lead, turn, rate, hold = numbers.tolist()
    # the slot frame's axes in the world: along the final heading, and to its left
    along, across = (sin(final), cos(final)), (-cos(final) * side, sin(final) * side)

    def world(x: float, y: float) -> tuple[float, float]:
        return (
            radius * (x * along[0] + y * across[0]),
            radius * (x * along[1] + y * across[1]),
        )

    lx, ly = world(*scene.leader[0, 1:3])
    px, py = world(pose.x, pose.y)
    leader_tas = alpha * tas
    wind = world((ahead / hold - alpha) * tas / radius, left / hold * tas / radius)
    intent = (FlyStraight(duration=lead * radius / tas),) if lead > 0.0 else ()
    return Situation(
        pursuer=Pursuer(x=px, y=py, heading=(final - side * pose.h) % tau, tas=tas, max_bank=bank),
        leader=Leader(
            x=lx,
            y=ly,
            heading=(final + side * turn) % tau,
            tas=leader_tas,
            intent=(
                *intent,
                TurnTo(
                    heading=final % tau,
                    turn=RIGHT if mirrored else LEFT,
                    bank=atan2(leader_tas * rate * tas / radius, GRAVITY),
                ),
            ),
        ),
        slot_distance=radius * hypot(ahead, left),
        min_separation=radius * limit,
        wind=Wind(east=wind[0], north=wind[1]),
    )

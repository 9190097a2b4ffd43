"""Joining a leader as a Gymnasium environment, judged by the exact optimum.

Needs relguide and `pip install gymnasium`. Run, it flies ten situations by a simple rule and by the
exact plan, and prints what each loses to the optimum.
"""

from collections.abc import Callable
from dataclasses import replace
from math import atan2, cos, hypot, pi, remainder, sin
from statistics import mean
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

import relguide as rg

Floats = NDArray[np.float32]
PURSUER_TAS, LEADER_TAS, MAX_BANK = 240.0, 200.0, 0.436  # [m/s], [m/s], [rad] = 25°
D, D_MIN = 12_000.0, 9_260.0  # [m]
NEAR, ALIGNED = 150.0, 0.09  # of the slot [m], of its heading [rad]: joined
LIMIT = 3_600  # seconds to join in
LOST = 1_000.0  # what it costs to come too near [s]
G = 9.80665  # [m/s²]


class JoinEnv(gymnasium.Env[Floats, Floats]):
    """Reach the slot, 12 km behind a leader that keeps straight, on its heading and in least time.

    Observation, seen from the pursuer: the slot ahead and to the right [km], the leader ahead and
    to the right [km], and sin and cos of the leader's heading less one's own.
    Action: bank for one second, as a share of 25°, positive to the right.
    Reward: −1 a second, and −1,000 where the leader is nearer than 5 NM, which ends it.
    `info["optimum_s"]` is the least time there is; at the end `info["regret_s"]` is what was lost
    to it. Whoever comes within 150 m and 5° has joined, so that regret may be −4 s at best.
    """

    def __init__(self) -> None:
        """Nothing is drawn before `reset`."""
        bounds = np.array([2e3, 2e3, 2e3, 2e3, 1.0, 1.0], np.float32)
        self.observation_space = gymnasium.spaces.Box(-bounds, bounds)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (1,))

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Draw a start within 60 km of the leader from which there is a plan."""
        super().reset(seed=seed)
        leader = rg.Leader(x=0.0, y=0.0, heading=0.5 * pi, tas=LEADER_TAS)
        while True:
            x, y = self.np_random.uniform(-60e3, 60e3, 2).tolist()
            heading = float(self.np_random.uniform(0.0, 2.0 * pi))
            own = rg.Pursuer(x=x, y=y, heading=heading, tas=PURSUER_TAS, max_bank=MAX_BANK)
            asked = rg.Situation(pursuer=own, leader=leader, slot_distance=D, min_separation=D_MIN)
            best = rg.plan(asked)
            if isinstance(best, rg.Plan):
                self.situation, self.time, self.best = asked, 0, best
                return self._observe(), {"optimum_s": best.time_to_converge}

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Fly a second."""
        own, leader = self.situation.pursuer, self.situation.leader
        rate = G / PURSUER_TAS * np.tan(MAX_BANK * float(np.clip(action[0], -1.0, 1.0)))
        middle = own.heading + 0.5 * rate
        x, y = own.x + PURSUER_TAS * sin(middle), own.y + PURSUER_TAS * cos(middle)
        own = replace(own, x=x, y=y, heading=(own.heading + rate) % (2.0 * pi))
        leader = replace(leader, x=leader.x + LEADER_TAS)
        self.situation = replace(self.situation, pursuer=own, leader=leader)
        self.time += 1
        seen = self._observe()
        aligned = abs(atan2(seen[4], seen[5])) < ALIGNED
        joined = bool(aligned and 1e3 * hypot(seen[0], seen[1]) < NEAR)
        lost = bool(1e3 * hypot(seen[2], seen[3]) < D_MIN)
        info = {"optimum_s": self.best.time_to_converge, "joined": joined}
        if joined:
            info["regret_s"] = self.time - self.best.time_to_converge
        return seen, -1.0 - LOST * lost, joined or lost, self.time >= LIMIT, info

    def _observe(self) -> Floats:
        own, leader = self.situation.pursuer, self.situation.leader
        s, c = sin(own.heading), cos(own.heading)
        relative = leader.heading - own.heading
        seen = []
        for behind in (D, 0.0):
            dx, dy = (leader.x - behind - own.x) / 1e3, (leader.y - own.y) / 1e3
            seen += [dx * s + dy * c, dx * c - dy * s]
        return np.array([*seen, sin(relative), cos(relative)], np.float32)


def by_rule(env: JoinEnv, seen: Floats) -> float:
    """Aim at where the slot will be when a third of the way is flown."""
    ahead, right, _, _, s, c = map(float, seen)
    lead = 0.3 * hypot(ahead, right)
    bearing = atan2(right + lead * s, ahead + lead * c)
    return float(np.clip(4.0 * bearing, -1.0, 1.0))


def by_plan(env: JoinEnv, _: Floats) -> float:
    """Fly the fastest plan from the start, as bank allows."""
    heading = env.best.trajectory.pose_at(env.time + 1.0).heading
    turned = remainder(heading - env.situation.pursuer.heading, 2.0 * pi)
    return float(np.arctan(turned * PURSUER_TAS / G) / MAX_BANK)


def fly(rule: Callable[[JoinEnv, Floats], float], seed: int) -> dict[str, Any]:
    """What the last step of an episode says."""
    env = JoinEnv()
    seen, _ = env.reset(seed=seed)
    while True:
        seen, _, over, late, info = env.step(np.array([rule(env, seen)], np.float32))
        if over or late:
            return info


if __name__ == "__main__":
    for name, rule in (("the rule", by_rule), ("the exact plan", by_plan)):
        ends = [fly(rule, seed) for seed in range(10)]
        lost = [end["regret_s"] for end in ends if end["joined"]]
        print(f"{name}: {len(lost)} of 10 join, with a regret of {mean(lost):.1f} s on average")

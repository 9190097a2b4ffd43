"""Situations behind a leader who turns once, in which the limit binds, and their exact answers.

Half of them in wind. What remains of a situation are the eleven numbers of
`kernels.networks.turning_leader`. Two sources: `tight`, within some widths of a disc larger than R,
and `near`, round a disc smaller than R; of each, those are kept in which no path that is as fast as
without the limit keeps it, but for paths delayed by a third turn.
"""

from dataclasses import dataclass, field
from math import hypot, isfinite, pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.contact.chain import WORD
from relguide.kernels.networks.turning_leader import (
    BINDS,
    NUMBERS,
    advance_turning_rows,
    solve_turning_rows,
    turning_limit_binds_rows,
    turning_scene,
)
from relguide.learn.boundary.template_labels import (
    DRAWN,
    LEAST_TURN,
    LONGEST,
    ConstrainedPaths,
    Floats,
    TemplateLabels,
    pick_paths,
)
from relguide.learn.training.requests import (
    begin_chunk,
    check_ratios,
    check_request,
    chunks_of,
)
from relguide.planning.constrained_path import TURNING_BEARINGS

SOURCES = ("tight", "near")
"""Where a situation comes from, by number."""
LEGS = 6
"""Legs of a path that are kept; paths with more are not learnt."""
GRAVITY = 9.80665
"""For how long the leader may keep straight, in R/V_P [m/s²]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnBox:
    """The situations that are learnt; beyond them nothing is claimed."""

    min_ratio: float = 0.6
    """Least V_L/V_P."""
    max_ratio: float = 0.98
    """Largest V_L/V_P."""
    min_limit: float = 0.3
    """Least d_min [R]."""
    max_limit: float = 4.0
    """Largest d_min [R]."""
    max_slot: float = 2.5
    """Largest D [d_min]; the least is 1."""
    max_range: float = 7.0
    """Farthest from the disc round the leader [R], or [d_min] where that is less."""
    max_wind: float = 0.25
    """Strongest wind [V_P]."""
    max_lead: float = 9.0
    """Longest straight before the turn [R/V_P]."""
    min_rate: float = 0.38
    """Slowest turn of the leader's, ω [V_P/R]."""
    max_rate: float = 3.6
    """Fastest."""

    def __post_init__(self) -> None:
        """Refuse a box that holds nothing, or where the slot may be out of reach."""
        check_ratios(self.min_ratio, self.max_ratio)
        if not 0.0 < self.min_limit < 1.0 < self.max_limit:
            raise ValueError(
                f"d_min must reach from below R to above it, not {self.min_limit:g} … "
                f"{self.max_limit:g} R."
            )
        if not (self.max_slot > 1.0 and 0.0 <= self.max_wind < self.min_ratio):
            raise ValueError("max_slot must be above 1, and max_wind below min_ratio.")
        if not (0.0 < self.min_rate < self.max_rate and self.max_lead >= 0.0):
            raise ValueError("min_rate must be above 0 and below max_rate, max_lead 0 or more.")
        if not all(isfinite(size) for size in (self.max_limit, self.max_slot, self.max_rate)):
            raise ValueError("The box must be bounded.")

    def holds(self, numbers: Floats) -> bool:
        """Whether a situation lies in it; its numbers are of shape (NUMBERS,)."""
        pose, scene = turning_scene(numbers)
        _, _, _, alpha, limit, ahead, left, lead, _, rate, hold = numbers.tolist()
        slot, at = hypot(ahead, left), scene.leader[0]
        away = hypot(pose.x - at[1], pose.y - at[2]) - limit
        return bool(
            self.min_ratio <= alpha <= self.max_ratio
            and self.min_limit <= limit <= self.max_limit
            and limit <= slot <= self.max_slot * limit
            and away <= self.max_range * min(limit, 1.0)
            and hypot(ahead / hold - alpha, left / hold) <= self.max_wind
            and lead <= self.max_lead
            and self.min_rate <= rate <= self.max_rate
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnLabelRequest:
    """What labels to make. The same request gives the same labels."""

    method: ClassVar[str] = "turns"
    sources: ClassVar[tuple[str, ...]] = SOURCES
    count: int
    seed: int = 0
    box: TurnBox = field(default_factory=TurnBox)
    shares: tuple[float, float] = (0.45, 0.55)
    """Of `SOURCES`."""
    chunk: int = 250
    """Labels made at a time."""

    def __post_init__(self) -> None:
        """Refuse what is no request."""
        check_request(self)

    @property
    def chunks(self) -> int:
        """How many chunks there are."""
        return chunks_of(self)

    def make(self, number: int) -> TemplateLabels:
        """One chunk; a function of the request and its number alone."""
        rng, sizes = begin_chunk(self, number)
        drawn = [_draw(rng, self.box, source, n) for source, n in enumerate(sizes)]
        situations = np.concatenate(drawn)
        times, counts, legs = turning_answers_of(situations)
        return TemplateLabels(
            situations=situations,
            times=times,
            counts=counts,
            legs=legs,
            sources=np.repeat(np.arange(len(SOURCES), dtype=np.int8), sizes),
        )


def turning_answers_of(situations: Floats) -> tuple[Floats, NDArray[np.int8], Floats]:
    """Times, numbers of legs and legs of the fastest paths, as in `TemplateLabels`."""
    n = len(situations)
    times, counts, legs = np.empty((n, 3)), np.empty(n), np.zeros((n, LEGS, 6))
    solve_turning_rows(situations, TURNING_BEARINGS, LONGEST, times, counts, legs)
    return times, counts.astype(np.int8), legs


def advance_turning(paths: ConstrainedPaths, rng: np.random.Generator) -> ConstrainedPaths:
    """As `template_labels.advance_paths`, from moments before the leader ends its turn.

    Paths delayed without a contact are left out: soon they may do without a third turn.
    """
    turning = (paths.counts > 0) & (paths.legs[:, 0, 0] == WORD)
    turning &= (paths.legs[:, 0, 3] > LEAST_TURN) & (paths.counts <= LEGS)
    rest = pick_paths(paths, turning)  # a copy, which is put forward in place
    advance_turning_rows(rest.situations, rest.times, rest.legs, rng.random(len(rest.times)))
    return rest


def _draw(rng: np.random.Generator, box: TurnBox, source: int, size: int) -> Floats:
    """Situations of one source in which the limit binds."""
    found = np.empty((0, NUMBERS))
    while len(found) < size:
        drawn = draw_turning(rng, box, source, DRAWN)
        binds = np.empty(DRAWN)
        turning_limit_binds_rows(drawn, binds)
        found = np.concatenate((found, drawn[binds == BINDS]))
    return found[:size]


def draw_turning(rng: np.random.Generator, box: TurnBox, source: int, size: int) -> Floats:
    """Situations of one source, the leader turning left."""
    alpha = rng.uniform(box.min_ratio, box.max_ratio, size)
    if source == 0:
        limit = rng.uniform(1.0, box.max_limit, size)
        away = limit * rng.uniform(1.0, 1.6, size)
    else:
        limit = rng.uniform(box.min_limit, 1.0, size)
        away = limit * rng.uniform(1.0, 1.0 + box.max_range, size)
    # speeds and banks of airliners: how fast the leader turns, and for how long it keeps straight
    bank = np.radians(rng.uniform(15.0, 35.0, size))
    tas = rng.uniform(90.0, 260.0, size)
    rate = np.tan(np.radians(rng.uniform(15.0, 30.0, size))) / np.tan(bank) / alpha
    lead = rng.uniform(0.0, 120.0, size) * GRAVITY * np.tan(bank) / tas
    lead = np.where(rng.random(size) < 0.2, 0.0, np.minimum(lead, box.max_lead))
    turn = rng.uniform(0.02, 2.0 * pi, size)
    # over the ground the slot is D straight behind, and opens once that has been flown
    wind = np.where(rng.random(size) < 0.5, 0.0, rng.uniform(0.0, box.max_wind, size))
    toward = rng.uniform(0.0, 2.0 * pi, size)
    ground = np.column_stack((alpha + wind * np.cos(toward), wind * np.sin(toward)))
    speed = np.hypot(ground[:, 0], ground[:, 1])
    slot = limit * rng.uniform(1.0, box.max_slot, size)
    hold = slot / speed
    ahead, left = hold * ground[:, 0], hold * ground[:, 1]
    # the leader at t = 0: back along the turn, and along what it flies before
    radius, ends = alpha / rate, lead + turn / rate
    leader_x = ahead + alpha * ends - radius * np.sin(turn) - alpha * lead * np.cos(turn)
    leader_y = left + radius * (1.0 - np.cos(turn)) + alpha * lead * np.sin(turn)
    bearing, h = rng.uniform(0.0, 2.0 * pi, size), rng.uniform(0.0, 2.0 * pi, size)
    x, y = leader_x + away * np.cos(bearing), leader_y + away * np.sin(bearing)
    return np.column_stack((x, y, h, alpha, limit, ahead, left, lead, turn, rate, hold))

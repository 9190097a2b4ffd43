"""What a pursuer knows at the start of a flight, and worlds flown by hand."""

from dataclasses import dataclass, replace

from relguide.flying.belief import Belief
from relguide.flying.fleet import Fleet
from relguide.flying.flight import Scenario, world_of
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.settings import DEFAULT, Settings
from relguide.flying.knowledge import belief_of
from relguide.flying.pursuit import assignment_of, begin_pursuit
from relguide.flying.scenarios import fig_6, own_scenario
from relguide.kernels.flight.flight_records import Control
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.situation import Situation
from relguide.units import DEG, NM

FIG_6B = fig_6(intent_known=True)


@dataclass
class Watched:
    """A flight of two, a second at a time, with what the pursuer knows."""

    scenario: Scenario
    settings: Settings = DEFAULT
    t: float = 0.0

    def __post_init__(self) -> None:
        self.world = world_of(self.scenario, self.settings)
        (self.link,) = self.world.links
        self.fleet = Fleet(self.world, 0.05)
        self.track = begin_pursuit(self.world, self.fleet, self.link).track
        self.assignment = assignment_of(self.world, self.link)

    @property
    def belief(self) -> Belief:
        return belief_of(self.fleet, 0, 1, self.track, self.t, self.link.intent_known)

    def fly(self, control: Control) -> None:
        self.fleet.control(0, control)
        self.fleet.fly_second(self.t)
        self.t += 1.0
        self.track.add(self.fleet.body(1), self.fleet.drift(1), self.t)


def observe(scenario: Scenario, settings: Settings = DEFAULT) -> tuple[Belief, Assignment]:
    watched = Watched(scenario, settings)
    return watched.belief, watched.assignment


def near_limit(*, slot_distance: float = 12_000.0) -> Scenario:
    """Head-on and a little aside: the fastest path comes close to d_min as it turns in."""
    situation = Situation(
        pursuer=Pursuer(x=9_000.0, y=22_000.0, heading=180.0 * DEG, tas=235.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0),
        slot_distance=slot_distance,
        min_separation=5.0 * NM,
    )
    return own_scenario(situation)


def behind(
    *, along: float, abeam: float = 0.0, tas: float = 230.0, leader_tas: float = 200.0
) -> Scenario:
    """Behind a leader that flies north from the origin."""
    situation = Situation(
        pursuer=Pursuer(x=abeam, y=-along, heading=0.0, tas=tas, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=leader_tas),
        slot_distance=10_000.0,
        min_separation=5.0 * NM,
    )
    return replace(own_scenario(situation), after_joining=60.0)

"""A flight of a campaign: its aircraft, its air, and what guidance is wrong about."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from relguide.flying.flight import DeclaredLeader, Scenario, world_of
from relguide.flying.guidance.settings import DEFAULT, Settings
from relguide.flying.guidances import Guidance
from relguide.flying.orders import Command
from relguide.flying.scripted_crew import CrewOrder
from relguide.flying.surveillance import EXACT
from relguide.flying.world import World
from relguide.planning.wind import CALM, Wind
from relguide.units import Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """What is flown."""

    family: str
    number: int
    scenario: Scenario
    noise_seed: int
    """Of gusts and of what reports have wrong."""
    orders: tuple[tuple[Second, Command], ...] = ()
    """Commands to the leader, each at its time, in order."""
    crew: tuple[CrewOrder, ...] = ()
    """What the pursuer's crew does; without it guidance is engaged from the start."""
    factors: Mapping[str, float] = field(default_factory=dict)
    """What the pursuer's constants really are, as multiples of what guidance believes."""
    wind_error: Wind = CALM
    """What guidance believes of the wind beyond what is true."""
    isa_error: float = 0.0
    """The same of the temperature [K]."""
    guidance: Guidance = "relguide"
    settings: Settings = DEFAULT
    """Of guidance."""

    @property
    def leader_as_declared(self) -> bool:
        """Whether the leader flies the intent of the situation, whoever knows it."""
        return isinstance(self.scenario.leader_source, DeclaredLeader) and not self.orders

    def world(self) -> World:
        """The world as it begins; the pursuer may be another than its guidance believes."""
        world = world_of(self.scenario)
        pursuer, leader = world.aircraft
        believed = pursuer.known_airframe
        true = replace(
            believed,
            **{name: factor * getattr(believed, name) for name, factor in self.factors.items()},
        )
        wrong = self.wind_error != CALM or self.isa_error
        return replace(
            world,
            aircraft=(replace(pursuer, airframe=true, believed=believed), leader),
            settings=self.settings,
            believed_air=world.air.with_error(wind_error=self.wind_error, isa_error=self.isa_error)
            if wrong
            else None,
        )

    def as_code(self) -> str:
        """The scenario and what comes with it, to paste; a recorded leader by its name."""
        scenario = self.scenario
        lines = [
            f"# {self.family} {self.number}: {scenario.description}",
            f"situation = {scenario.situation!r}",
            f"intent_known = {scenario.intent_known}",
            f"after_joining, duration_limit = {scenario.after_joining}, {scenario.duration_limit}",
            f"leader = {scenario.leader_ident!r}",
            *(f"at {t:.0f} s: {command!r}" for t, command in self.orders),
        ]
        lines += [f"crew: {order!r}" for order in self.crew]
        if self.guidance != "relguide":
            lines.append(f"guidance = {self.guidance!r}")
        if scenario.by_hand is not None:
            lines.append(f"by_hand = {scenario.by_hand!r}")
        if self.settings != DEFAULT:
            lines.append(f"settings = {self.settings!r}")
        if self.factors:
            lines.append(f"factors = {dict(self.factors)!r}")
        if self.wind_error != CALM or self.isa_error:
            lines.append(f"wind_error, isa_error = {self.wind_error!r}, {self.isa_error}")
        if scenario.gusts or scenario.surveillance != EXACT:
            lines.append(f"gusts, surveillance = {scenario.gusts}, {scenario.surveillance!r}")
        return "\n".join(lines)

"""What a pursuer was asked to do, and with what: until its crew asks for something else."""

from dataclasses import dataclass
from functools import cached_property

from relguide.flying.guidance.settings import Settings
from relguide.kernels.flight.flight_records import Limits
from relguide.kernels.flight.guide import Gate, Task
from relguide.kernels.flight.laws import Gains
from relguide.units import Metre, MetrePerSecond, Radian, Second

IN_GATE = 0.9
"""Share of the gate's length that the place aimed at may lie behind D."""


@dataclass(frozen=True, kw_only=True)
class Assignment:
    """One pursuer, one leader, and how far behind it."""

    aircraft_type: str
    """ICAO designator of the pursuer, for sentences."""
    tas: MetrePerSecond
    """V_P, kept until the spacing closes [m/s]."""
    asked_bank: Radian
    """What the plans are asked to turn with [rad]."""
    max_bank: Radian
    """What the autopilot may use [rad]."""
    idle_deceleration: float
    """What the type gives at idle thrust [m/s²]."""
    min_tas: MetrePerSecond
    """Its least speed at its level [m/s]."""
    slot_distance: Metre
    """D [m]."""
    min_separation: Metre
    """d_min [m]."""
    spacing: Second = 0.0
    """Time behind the leader to keep [s]; 0 where a distance is kept."""
    settings: Settings
    margin: Metre = 0.0
    """What is kept beside d_min for what is not certain, as where a crew flies by hand [m]."""
    selected_tas: MetrePerSecond = 0.0
    """The speed that the crew has selected; 0 while guidance sets the speed [m/s]."""

    @property
    def planned_tas(self) -> MetrePerSecond:
        """What plans fly at: the speed that the crew has selected, or else V_P [m/s]."""
        return self.selected_tas or self.tas

    def can(self, limits: Limits) -> Limits:
        """What an aircraft can do that flies the speed which its crew has selected, and no other.

        Args:
            limits: of the aircraft.
        """
        tas = self.selected_tas
        return limits._replace(min_tas=tas, max_tas=tas) if tas else limits

    @cached_property
    def planned_bank(self) -> Radian:
        """φ_max of the plans: the bank that was asked for, with some more in hand [rad]."""
        return min(self.asked_bank, self.settings.planned_bank(self.max_bank))

    @cached_property
    def aim(self) -> Metre:
        """Where in the gate the pursuer goes: D, or what keeps d_min with a buffer [m]."""
        wanted = self.min_separation + self.settings.separation_buffer + self.margin
        gate = self.slot_distance + IN_GATE * self.settings.joined_along
        return min(max(self.slot_distance, wanted), gate)

    @cached_property
    def buffered_separation(self) -> Metre:
        """The separation that new plans should keep [m]: d_min and a buffer, within the aim."""
        wanted = self.min_separation + self.settings.separation_buffer + self.margin
        return min(wanted, self.aim)

    @cached_property
    def kept_separation(self) -> Metre:
        """What a flight ahead must keep to be flown [m]: d_min and the margin, within the aim."""
        return min(self.min_separation + self.margin, self.buffered_separation)

    @cached_property
    def gains(self) -> Gains:
        """Of the laws, for this aircraft."""
        return self.settings.gains(self.idle_deceleration)

    @cached_property
    def gate(self) -> Gate:
        """When it has joined."""
        return self.settings.gate

    @cached_property
    def task(self) -> Task:
        """As the kernels take it."""
        return Task(
            self.planned_tas, self.slot_distance, self.aim, self.spacing, self.buffered_separation
        )

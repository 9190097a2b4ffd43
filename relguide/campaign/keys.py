"""The quantities that a campaign varies or sweeps: each key with its limits, and what it changes.

To add one: a line in `KEYS`, with a function that gives a case with it. Keys are applied in the
order of the table, so that a share comes after what it is a share of.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import atan2, cos, hypot, pi, sin
from typing import Any, NamedTuple

from relguide.campaign.case import Case
from relguide.campaign.starts import Draw
from relguide.flying.air import GUSTS, ISA_DEVIATION
from relguide.flying.pilot_model import (
    BANDWIDTH,
    DELAY,
    REACTION,
    REMNANT,
    THRESHOLD,
    PilotModel,
)
from relguide.flying.surveillance import LATENCY, LOSS_SHARE
from relguide.planning.inputs import Range
from relguide.planning.limits import BANK, COMPASS, DISTANCE, SPACING, TAS, WIND
from relguide.planning.situation import Situation
from relguide.planning.wind import Wind, wind_from
from relguide.units import DEG

Setter = Callable[[Case, float, Draw], Case]
"""A case with a value, and random numbers for what the value leaves open, as a direction."""
AWAY = Range(0.0, 1_000_000.0, "m")
FACTOR = Range(0.05, 10.0, "times")
MARGIN = Range(1.0, 10_000.0, "m")


class Key(NamedTuple):
    """A quantity."""

    limits: Range
    set: Setter
    says: str
    """What it is."""
    leader_is_drawn: bool = False
    """Whether it says nothing of a recorded leader."""


def _pursuer(name: str, unit: float = 1.0) -> Setter:
    def set_it(case: Case, value: float, rng: Draw) -> Case:
        changed: Any = {name: value * unit}
        pursuer = replace(case.scenario.situation.pursuer, **changed)
        return _with(case, pursuer=pursuer)

    return set_it


def _scenario(name: str) -> Setter:
    def set_it(case: Case, value: float, rng: Draw) -> Case:
        changed: Any = {name: value}
        return replace(case, scenario=replace(case.scenario, **changed))

    return set_it


def _pilot(name: str, unit: float = 1.0) -> Setter:
    """Flown by hand, with one of the pilot's constants; the others keep their default."""

    def set_it(case: Case, value: float, rng: Draw) -> Case:
        changed: Any = {name: value * unit}
        pilot = replace(case.scenario.by_hand or PilotModel(), **changed)
        return replace(case, scenario=replace(case.scenario, by_hand=pilot))

    return set_it


def _setting(name: str) -> Setter:
    def set_it(case: Case, value: float, rng: Draw) -> Case:
        changed: Any = {name: value}
        return replace(case, settings=replace(case.settings, **changed))

    return set_it


def _factor(*names: str) -> Setter:
    def set_it(case: Case, value: float, rng: Draw) -> Case:
        return replace(case, factors={**case.factors, **dict.fromkeys(names, value)})

    return set_it


def _leader_tas(case: Case, value: float, rng: Draw) -> Case:
    return _with(case, leader=replace(case.scenario.situation.leader, tas=value))


def _leader_share(case: Case, value: float, rng: Draw) -> Case:
    return _leader_tas(case, value * case.scenario.situation.pursuer.tas, rng)


def _min_separation(case: Case, value: float, rng: Draw) -> Case:
    """D goes with it: how far the slot is beyond d_min stays."""
    situation = case.scenario.situation
    beyond = situation.slot_distance - situation.min_separation
    return _with(case, min_separation=value, slot_distance=value + beyond)


def _slot_beyond(case: Case, value: float, rng: Draw) -> Case:
    return _with(case, slot_distance=case.scenario.situation.min_separation + value)


def _start_distance(case: Case, value: float, rng: Draw) -> Case:
    """On the bearing that was drawn."""
    return _placed(case, value, _bearing(case.scenario.situation))


def _start_bearing(case: Case, value: float, rng: Draw) -> Case:
    pursuer, leader = case.scenario.situation.pursuer, case.scenario.situation.leader
    return _placed(case, hypot(pursuer.x - leader.x, pursuer.y - leader.y), value * DEG)


def _placed(case: Case, away: float, bearing: float) -> Case:
    situation = case.scenario.situation
    x, y = situation.leader.x + away * sin(bearing), situation.leader.y + away * cos(bearing)
    return _with(case, pursuer=replace(situation.pursuer, x=x, y=y))


def _bearing(situation: Situation) -> float:
    """Of the pursuer from the leader [rad]."""
    pursuer, leader = situation.pursuer, situation.leader
    return atan2(pursuer.x - leader.x, pursuer.y - leader.y)


def _wind_speed(case: Case, value: float, rng: Draw) -> Case:
    """From where it was drawn to blow."""
    return _with(case, wind=_with_speed(case.scenario.situation.wind, value, rng))


def _wind_direction(case: Case, value: float, rng: Draw) -> Case:
    return _with(case, wind=wind_from(value * DEG, case.scenario.situation.wind.speed))


def _wind_error(case: Case, value: float, rng: Draw) -> Case:
    """To any side; a negative one to the other."""
    drawn = _with_speed(Wind(), abs(value), rng)
    error = drawn if value >= 0.0 else Wind(east=-drawn.east, north=-drawn.north)
    return replace(case, wind_error=error)


def _isa_error(case: Case, value: float, rng: Draw) -> Case:
    return replace(case, isa_error=value)


def _seen(name: str, as_given: Callable[[float], float] = float) -> Setter:
    """By ADS-B, with one of its fields; the others keep their default."""

    def set_it(case: Case, value: float, rng: Draw) -> Case:
        changed: Any = {"kind": "adsb", name: as_given(value)}
        seen = replace(case.scenario.surveillance, **changed)
        return replace(case, scenario=replace(case.scenario, surveillance=seen))

    return set_it


def _with_speed(wind: Wind, speed: float, rng: Draw) -> Wind:
    """A wind with another speed; where it was calm, from anywhere."""
    anywhere = float(rng.uniform(0.0, 2.0 * pi))
    from_ = atan2(-wind.east, -wind.north) if wind.speed else anywhere
    return wind_from(from_, speed)


def _with(case: Case, **changes: Any) -> Case:
    situation = replace(case.scenario.situation, **changes)
    return replace(case, scenario=replace(case.scenario, situation=situation))


KEYS: Mapping[str, Key] = {
    "altitude_m": Key(Range(0.0, 15_000.0, "m"), _scenario("altitude"), "pressure altitude"),
    "weight_kg": Key(Range(1e3, 1e6, "kg"), _scenario("pursuer_weight"), "of the pursuer"),
    "isa_deviation_k": Key(ISA_DEVIATION, _scenario("isa_deviation"), "warmer than ISA"),
    "pursuer_tas_mps": Key(TAS, _pursuer("tas"), "V_P"),
    "max_bank_deg": Key(BANK, _pursuer("max_bank", DEG), "bank that the autopilot may use"),
    "leader_tas_mps": Key(TAS, _leader_tas, "V_L", True),
    "leader_tas_share": Key(Range(0.1, 2.0, ""), _leader_share, "V_L/V_P", True),
    "min_separation_m": Key(DISTANCE, _min_separation, "d_min; D goes with it"),
    "slot_beyond_m": Key(DISTANCE, _slot_beyond, "D − d_min"),
    "spacing_s": Key(SPACING, _scenario("spacing"), "time to keep behind the leader once joined"),
    "start_distance_m": Key(AWAY, _start_distance, "from the leader at the start"),
    "start_bearing_deg": Key(Range(-360.0, 360.0, "°"), _start_bearing, "from the leader"),
    "wind_mps": Key(WIND, _wind_speed, "wind speed"),
    "wind_from_deg": Key(COMPASS, _wind_direction, "where it comes from"),
    "wind_error_mps": Key(Range(-60.0, 60.0, "m/s"), _wind_error, "believed less true wind"),
    "isa_error_k": Key(Range(-30.0, 30.0, "K"), _isa_error, "believed less true temperature"),
    "roll_rate_factor": Key(FACTOR, _factor("max_roll_rate"), "true over believed"),
    "roll_lag_factor": Key(FACTOR, _factor("roll_time_constant"), "true over believed"),
    "speed_lag_factor": Key(FACTOR, _factor("speed_time_constant"), "true over believed"),
    "thrust_factor": Key(FACTOR, _factor("thrust_share"), "true over believed"),
    "drag_factor": Key(
        FACTOR, _factor("zero_lift_drag", "induced_drag"), "true over believed, without brakes"
    ),
    "speed_brake_factor": Key(FACTOR, _factor("speed_brake_drag"), "true over believed"),
    "gusts_mps": Key(GUSTS, _scenario("gusts"), "σ along and across, Dryden"),
    "nacp": Key(Range(1, 11, "of NACp"), _seen("nacp", round), "category of ADS-B positions"),
    "nacv": Key(Range(1, 4, "of NACv"), _seen("nacv", round), "category of ADS-B velocities"),
    "latency_s": Key(LATENCY, _seen("latency"), "of reports"),
    "loss_share": Key(LOSS_SHARE, _seen("loss_share"), "of reports"),
    "pilot_bandwidth_radps": Key(BANDWIDTH, _pilot("bandwidth"), "by hand: ω_c"),
    "pilot_delay_s": Key(DELAY, _pilot("delay"), "by hand: τ"),
    "pilot_remnant_share": Key(REMNANT, _pilot("remnant"), "by hand: its noise"),
    "pilot_threshold_deg": Key(
        THRESHOLD, _pilot("threshold", DEG), "by hand: errors it lets stand"
    ),
    "pilot_reaction_s": Key(REACTION, _pilot("reaction"), "by hand: after an announcement"),
    "by_hand_margin_m": Key(MARGIN, _setting("by_hand_margin"), "by hand: kept beside d_min"),
}
"""By name, each with its unit."""

"""Minimum-time relative guidance of aircraft.

A pursuer joins the track of a leader, at a distance D behind it, in minimum time, never closer than
d_min. Five conventions hold everywhere:

1. SI and radians in every value and argument. Outside, every JSON field, option and file column
   names its unit (`_m`, `_s`, `_mps`, `_deg`); display units only in `units.py`.
2. World frame: x east, y north [m]. Heading ψ clockwise from north in [0, 2π).
   Velocity = V (sin ψ, cos ψ).
3. Slot frame (inside kernels only): origin at the slot, x along the leader's final heading,
   angles counter-clockwise, lengths in R, times in R/V_P. Crossed only in `planning/slot.py`.
4. Signs: bank φ > 0 is right wing down, turns right, ψ grows. The paper's ε = +1 is a left turn: so
   `turn = LEFT = +1`, and sign φ = −`turn`.
5. Time is t [s] from the start of the manoeuvre; segments are numbered forward from 0.
"""

import importlib
import typing

from relguide.planning.extras import add_command as _add_command

if typing.TYPE_CHECKING:
    from relguide.contract.recorder import record as record
    from relguide.contract.recorder import replay as replay
    from relguide.flying.air import Air as Air
    from relguide.flying.airframe import Airframe as Airframe
    from relguide.flying.airframe_files import airframe as airframe
    from relguide.flying.airframe_files import load_airframe as load_airframe
    from relguide.flying.documents import Alert as Alert
    from relguide.flying.documents import Document as Document
    from relguide.flying.documents import EngagementChanged as EngagementChanged
    from relguide.flying.documents import FanChanged as FanChanged
    from relguide.flying.documents import FlightEnded as FlightEnded
    from relguide.flying.documents import FlightStarted as FlightStarted
    from relguide.flying.documents import ForecastChanged as ForecastChanged
    from relguide.flying.documents import LeaderChanged as LeaderChanged
    from relguide.flying.documents import LeaderRoute as LeaderRoute
    from relguide.flying.documents import ModeChanged as ModeChanged
    from relguide.flying.documents import PlanChanged as PlanChanged
    from relguide.flying.documents import PlanProposed as PlanProposed
    from relguide.flying.documents import PlanRefused as PlanRefused
    from relguide.flying.documents import PlanUnavailable as PlanUnavailable
    from relguide.flying.documents import PromiseChanged as PromiseChanged
    from relguide.flying.documents import Sample as Sample
    from relguide.flying.documents import SeparationLost as SeparationLost
    from relguide.flying.documents import Unable as Unable
    from relguide.flying.flight import DeclaredLeader as DeclaredLeader
    from relguide.flying.flight import Scenario as Scenario
    from relguide.flying.flight import fly as fly
    from relguide.flying.followers import Follower as Follower
    from relguide.flying.guidance.settings import Settings as Settings
    from relguide.flying.guidance.settings import load_settings as load_settings
    from relguide.flying.orders import Command as Command
    from relguide.flying.orders import IntentKnown as IntentKnown
    from relguide.flying.orders import LeaderData as LeaderData
    from relguide.flying.orders import LeaderHeading as LeaderHeading
    from relguide.flying.orders import LeaderLevel as LeaderLevel
    from relguide.flying.orders import LeaderReport as LeaderReport
    from relguide.flying.orders import LeaderSpeed as LeaderSpeed
    from relguide.flying.orders import PursuerBank as PursuerBank
    from relguide.flying.orders import PursuerHeading as PursuerHeading
    from relguide.flying.orders import PursuerSpeed as PursuerSpeed
    from relguide.flying.orders import SetAutopilot as SetAutopilot
    from relguide.flying.orders import SetDirector as SetDirector
    from relguide.flying.orders import SetEngagement as SetEngagement
    from relguide.flying.orders import SetSpacing as SetSpacing
    from relguide.flying.orders import Stick as Stick
    from relguide.flying.pilot_model import PilotModel as PilotModel
    from relguide.flying.queues import queue_up as queue_up
    from relguide.flying.queues import soonest_first as soonest_first
    from relguide.flying.recordings.files import load_track as load_track
    from relguide.flying.scenarios import own_scenario as own_scenario
    from relguide.flying.scenarios import scenario as scenario
    from relguide.flying.scenarios import scenario_behind as scenario_behind
    from relguide.flying.scripted_crew import CrewOrder as CrewOrder
    from relguide.flying.scripted_crew import ScriptedCrew as ScriptedCrew
    from relguide.flying.scripted_crew import with_crew as with_crew
    from relguide.flying.simulation import simulate as simulate
    from relguide.flying.surveillance import Surveillance as Surveillance
    from relguide.flying.tracks import RecordedTrack as RecordedTrack
    from relguide.flying.wind_grib import load_grib as load_grib
    from relguide.flying.wind_profile import WindProfile as WindProfile
    from relguide.flying.wind_profile import load_profile as load_profile
    from relguide.flying.world import Aircraft as Aircraft
    from relguide.flying.world import Declared as Declared
    from relguide.flying.world import Guided as Guided
    from relguide.flying.world import Link as Link
    from relguide.flying.world import Recorded as Recorded
    from relguide.flying.world import World as World
    from relguide.maps.isochrones import Grid as Grid
    from relguide.maps.isochrones import Isochrones as Isochrones
    from relguide.maps.isochrones import isochrones as isochrones
    from relguide.pictures.flight import Flight as Flight
    from relguide.pictures.picture import Picture as Picture
    from relguide.pictures.picture import picture as picture
    from relguide.planning.aircraft import Leader as Leader
    from relguide.planning.aircraft import Pursuer as Pursuer
    from relguide.planning.aircraft import Traffic as Traffic
    from relguide.planning.alternatives import Alternative as Alternative
    from relguide.planning.alternatives import alternatives as alternatives
    from relguide.planning.arrival import Arrival as Arrival
    from relguide.planning.batch import Situations as Situations
    from relguide.planning.batch import TimeRow as TimeRow
    from relguide.planning.batch import Times as Times
    from relguide.planning.batch import plan_arrays as plan_arrays
    from relguide.planning.candidate import Candidate as Candidate
    from relguide.planning.cells import Cell as Cell
    from relguide.planning.cells import Disc as Disc
    from relguide.planning.cells import Polygon as Polygon
    from relguide.planning.certificate import Certificate as Certificate
    from relguide.planning.certificate import certify as certify
    from relguide.planning.intent import ChangeLevel as ChangeLevel
    from relguide.planning.intent import FlyStraight as FlyStraight
    from relguide.planning.intent import LevelChange as LevelChange
    from relguide.planning.intent import TurnTo as TurnTo
    from relguide.planning.optimality import OptimalityReport as OptimalityReport
    from relguide.planning.optimality import check as check
    from relguide.planning.outcome import NoPlan as NoPlan
    from relguide.planning.outcome import Optimality as Optimality
    from relguide.planning.outcome import Plan as Plan
    from relguide.planning.outcome import Planner as Planner
    from relguide.planning.outcome import Reason as Reason
    from relguide.planning.plan import plan as plan
    from relguide.planning.progress import progress_bar as progress_bar
    from relguide.planning.prove import prove as prove
    from relguide.planning.sampling import Samples as Samples
    from relguide.planning.situation import Situation as Situation
    from relguide.planning.trajectory import LEFT as LEFT
    from relguide.planning.trajectory import RIGHT as RIGHT
    from relguide.planning.trajectory import Arc as Arc
    from relguide.planning.trajectory import BoundaryArc as BoundaryArc
    from relguide.planning.trajectory import Pose as Pose
    from relguide.planning.trajectory import Straight as Straight
    from relguide.planning.trajectory import Trajectory as Trajectory
    from relguide.planning.wind import CALM as CALM
    from relguide.planning.wind import Wind as Wind
    from relguide.planning.wind import wind_from as wind_from
    from relguide.planning.words import candidates as candidates

__version__ = "0.3.0"

_HOMES = {
    "record": "relguide.contract.recorder",
    "replay": "relguide.contract.recorder",
    "Air": "relguide.flying.air",
    "Airframe": "relguide.flying.airframe",
    "airframe": "relguide.flying.airframe_files",
    "load_airframe": "relguide.flying.airframe_files",
    "Alert": "relguide.flying.documents",
    "Document": "relguide.flying.documents",
    "EngagementChanged": "relguide.flying.documents",
    "FanChanged": "relguide.flying.documents",
    "FlightEnded": "relguide.flying.documents",
    "FlightStarted": "relguide.flying.documents",
    "ForecastChanged": "relguide.flying.documents",
    "LeaderChanged": "relguide.flying.documents",
    "LeaderRoute": "relguide.flying.documents",
    "ModeChanged": "relguide.flying.documents",
    "PlanChanged": "relguide.flying.documents",
    "PlanProposed": "relguide.flying.documents",
    "PlanRefused": "relguide.flying.documents",
    "PlanUnavailable": "relguide.flying.documents",
    "PromiseChanged": "relguide.flying.documents",
    "Sample": "relguide.flying.documents",
    "SeparationLost": "relguide.flying.documents",
    "Unable": "relguide.flying.documents",
    "DeclaredLeader": "relguide.flying.flight",
    "Scenario": "relguide.flying.flight",
    "fly": "relguide.flying.flight",
    "Follower": "relguide.flying.followers",
    "Command": "relguide.flying.orders",
    "IntentKnown": "relguide.flying.orders",
    "LeaderData": "relguide.flying.orders",
    "LeaderHeading": "relguide.flying.orders",
    "LeaderLevel": "relguide.flying.orders",
    "LeaderReport": "relguide.flying.orders",
    "LeaderSpeed": "relguide.flying.orders",
    "PursuerHeading": "relguide.flying.orders",
    "PursuerBank": "relguide.flying.orders",
    "PursuerSpeed": "relguide.flying.orders",
    "SetAutopilot": "relguide.flying.orders",
    "SetDirector": "relguide.flying.orders",
    "SetSpacing": "relguide.flying.orders",
    "Stick": "relguide.flying.orders",
    "SetEngagement": "relguide.flying.orders",
    "PilotModel": "relguide.flying.pilot_model",
    "queue_up": "relguide.flying.queues",
    "soonest_first": "relguide.flying.queues",
    "own_scenario": "relguide.flying.scenarios",
    "scenario": "relguide.flying.scenarios",
    "scenario_behind": "relguide.flying.scenarios",
    "RecordedTrack": "relguide.flying.tracks",
    "load_track": "relguide.flying.recordings.files",
    "Settings": "relguide.flying.guidance.settings",
    "load_settings": "relguide.flying.guidance.settings",
    "CrewOrder": "relguide.flying.scripted_crew",
    "ScriptedCrew": "relguide.flying.scripted_crew",
    "with_crew": "relguide.flying.scripted_crew",
    "simulate": "relguide.flying.simulation",
    "Aircraft": "relguide.flying.world",
    "Declared": "relguide.flying.world",
    "Guided": "relguide.flying.world",
    "Link": "relguide.flying.world",
    "Recorded": "relguide.flying.world",
    "World": "relguide.flying.world",
    "Grid": "relguide.maps.isochrones",
    "Isochrones": "relguide.maps.isochrones",
    "isochrones": "relguide.maps.isochrones",
    "Flight": "relguide.pictures.flight",
    "Picture": "relguide.pictures.picture",
    "picture": "relguide.pictures.picture",
    "Alternative": "relguide.planning.alternatives",
    "alternatives": "relguide.planning.alternatives",
    "Arrival": "relguide.planning.arrival",
    "Situations": "relguide.planning.batch",
    "TimeRow": "relguide.planning.batch",
    "Times": "relguide.planning.batch",
    "plan_arrays": "relguide.planning.batch",
    "ChangeLevel": "relguide.planning.intent",
    "Traffic": "relguide.planning.aircraft",
    "Cell": "relguide.planning.cells",
    "Disc": "relguide.planning.cells",
    "Polygon": "relguide.planning.cells",
    "Certificate": "relguide.planning.certificate",
    "certify": "relguide.planning.certificate",
    "OptimalityReport": "relguide.planning.optimality",
    "check": "relguide.planning.optimality",
    "NoPlan": "relguide.planning.outcome",
    "Optimality": "relguide.planning.outcome",
    "Plan": "relguide.planning.outcome",
    "Planner": "relguide.planning.outcome",
    "Reason": "relguide.planning.outcome",
    "plan": "relguide.planning.plan",
    "progress_bar": "relguide.planning.progress",
    "prove": "relguide.planning.prove",
    "Samples": "relguide.planning.sampling",
    "CALM": "relguide.planning.wind",
    "FlyStraight": "relguide.planning.intent",
    "LevelChange": "relguide.planning.intent",
    "Leader": "relguide.planning.aircraft",
    "Pursuer": "relguide.planning.aircraft",
    "Situation": "relguide.planning.situation",
    "TurnTo": "relguide.planning.intent",
    "Wind": "relguide.planning.wind",
    "Surveillance": "relguide.flying.surveillance",
    "WindProfile": "relguide.flying.wind_profile",
    "load_grib": "relguide.flying.wind_grib",
    "load_profile": "relguide.flying.wind_profile",
    "wind_from": "relguide.planning.wind",
    "Arc": "relguide.planning.trajectory",
    "BoundaryArc": "relguide.planning.trajectory",
    "LEFT": "relguide.planning.trajectory",
    "Pose": "relguide.planning.trajectory",
    "RIGHT": "relguide.planning.trajectory",
    "Straight": "relguide.planning.trajectory",
    "Trajectory": "relguide.planning.trajectory",
    "Candidate": "relguide.planning.candidate",
    "candidates": "relguide.planning.words",
}
"""Public names and their modules, loaded when first asked for: numba alone takes 0.3 s."""

__all__ = [
    "CALM",
    "LEFT",
    "RIGHT",
    "Air",
    "Aircraft",
    "Airframe",
    "Alert",
    "Alternative",
    "Arc",
    "Arrival",
    "BoundaryArc",
    "Candidate",
    "Cell",
    "Certificate",
    "ChangeLevel",
    "Command",
    "CrewOrder",
    "Declared",
    "DeclaredLeader",
    "Disc",
    "Document",
    "EngagementChanged",
    "FanChanged",
    "Flight",
    "FlightEnded",
    "FlightStarted",
    "FlyStraight",
    "Follower",
    "ForecastChanged",
    "Grid",
    "Guided",
    "IntentKnown",
    "Isochrones",
    "Leader",
    "LeaderChanged",
    "LeaderData",
    "LeaderHeading",
    "LeaderLevel",
    "LeaderReport",
    "LeaderRoute",
    "LeaderSpeed",
    "LevelChange",
    "Link",
    "ModeChanged",
    "NoPlan",
    "Optimality",
    "OptimalityReport",
    "Picture",
    "PilotModel",
    "Plan",
    "PlanChanged",
    "PlanProposed",
    "PlanRefused",
    "PlanUnavailable",
    "Planner",
    "Polygon",
    "Pose",
    "PromiseChanged",
    "Pursuer",
    "PursuerBank",
    "PursuerHeading",
    "PursuerSpeed",
    "Reason",
    "Recorded",
    "RecordedTrack",
    "Sample",
    "Samples",
    "Scenario",
    "ScriptedCrew",
    "SeparationLost",
    "SetAutopilot",
    "SetDirector",
    "SetEngagement",
    "SetSpacing",
    "Settings",
    "Situation",
    "Situations",
    "Stick",
    "Straight",
    "Surveillance",
    "TimeRow",
    "Times",
    "Traffic",
    "Trajectory",
    "TurnTo",
    "Unable",
    "Wind",
    "WindProfile",
    "World",
    "airframe",
    "alternatives",
    "candidates",
    "certify",
    "check",
    "fly",
    "isochrones",
    "load_airframe",
    "load_grib",
    "load_profile",
    "load_settings",
    "load_track",
    "own_scenario",
    "picture",
    "plan",
    "plan_arrays",
    "progress_bar",
    "prove",
    "queue_up",
    "record",
    "replay",
    "scenario",
    "scenario_behind",
    "simulate",
    "soonest_first",
    "wind_from",
    "with_crew",
]


def __getattr__(name: str) -> typing.Any:
    """Load what a public name stands for, once."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        module = importlib.import_module(_HOMES[name])
    except ModuleNotFoundError as error:
        raise _add_command(error) from None
    value = getattr(module, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """All public names, loaded or not, and no module that has been imported meanwhile."""
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})

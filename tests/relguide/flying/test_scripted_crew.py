"""A scripted crew reacts to what is said of its flight, and orders what can follow."""

from functools import partial
from typing import Any

import pytest

from relguide.campaign.starts import random_start
from relguide.flying.documents import (
    Alert,
    CommandGiven,
    Document,
    EngagementChanged,
    FlightStarted,
    ModeChanged,
    PlanProposed,
    Unable,
)
from relguide.flying.engagement import Engagement
from relguide.flying.flight import fly
from relguide.flying.orders import Command, LeaderHeading, PursuerBank, SetAutopilot, SetEngagement
from relguide.flying.scenarios import fig_6
from relguide.flying.scripted_crew import CrewOrder, ScriptedCrew, both, with_crew
from relguide.planning.plan import plan
from relguide.units import DEG
from tests.flights import saying

ACCEPT = CrewOrder(on="proposed", after=5.0, command=SetEngagement(engagement="armed"))
ENGAGE = CrewOrder(on="armed", after=10.0, command=SetEngagement(engagement="engaged"))
DESIGNATE = CrewOrder(after=1.0, command=SetEngagement(engagement="designated"))

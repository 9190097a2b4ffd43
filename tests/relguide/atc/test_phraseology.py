"""Requests and answers in words."""

from dataclasses import replace

import numpy as np

from relguide.atc.phraseology import clearance_text, request_text, unable_text
from relguide.units import NM
from tests.relguide.atc.pictures import drawn_path, manoeuvre_on

ASKED = replace(manoeuvre_on(drawn_path(np.random.default_rng(1)))[0], leader="BAW12")


def test_a_request_names_the_place_and_the_leader():
    assert request_text(ASKED) == "REQUEST CAPTURE AND MAINTAIN 5.0 NM BEHIND BAW12"
    by_time = replace(ASKED, spacing_type="time", spacing=90.0)
    assert request_text(by_time) == "REQUEST CAPTURE AND MAINTAIN 90 SEC BEHIND BAW12"


def test_a_clearance():
    asked = replace(ASKED, spacing=5.5 * NM)
    assert clearance_text(asked) == "CLEARED CAPTURE AND MAINTAIN 5.5 NM BEHIND BAW12"


def test_a_refusal_says_its_cause():
    assert unable_text("separation", ["BAW12"]) == "UNABLE DUE TO TRAFFIC BAW12"
    assert unable_text("airspace", ["R1"]) == "UNABLE DUE TO AIRSPACE RESTRICTION R1"
    assert unable_text("bank") == "UNABLE DUE TO AIRCRAFT PERFORMANCE"
    assert unable_text("controller") == "UNABLE"

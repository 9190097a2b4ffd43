"""A campaign's file says all, and what is wrong with it is said by name."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from relguide.campaign.campaign_file import load_campaign, read_campaign
from relguide.campaign.distribution import Choice, Fixed, Normal, Uniform
from relguide.campaign.draw import draw_flight
from relguide.campaign.keys import KEYS
from relguide.campaign.row import Row
from relguide.flying.orders import SetEngagement
from relguide.flying.scripted_crew import CrewOrder

HEAD: dict[str, Any] = {"flights": 3, "family": "declared"}
UNITS = ("_m", "_mps", "_deg", "_s", "_k", "_kg", "_share", "_factor", "_radps")
ROOT = Path(__file__).parents[3]


def test_a_file_is_read_and_written_the_same() -> None:
    content = {
        "campaign": {"name": "gusts", "seed": 7, **HEAD, "limit_s": 600, "after_joining_s": 30},
        "vary": {
            "leader_tas_share": {"uniform": [0.6, 0.98]},
            "wind_error_mps": {"normal": [0, 3]},
            "wind_mps": {"choice": [0, 20]},
            "max_bank_deg": {"fixed": 20},
            "isa_error_k": 5,
        },
        "sweep": {"roll_rate_factor": [1, 0.7]},
    }
    found = read_campaign(content)
    assert dict(found.vary) == {
        "leader_tas_share": Uniform(0.6, 0.98),
        "wind_error_mps": Normal(0.0, 3.0),
        "wind_mps": Choice((0.0, 20.0)),
        "max_bank_deg": Fixed(20.0),
        "isa_error_k": Fixed(5.0),
    }
    assert [dict(point.values) for point in found.points] == [
        {"roll_rate_factor": 1.0}, {"roll_rate_factor": 0.7},
    ]  # fmt: skip
    assert (found.total, found.limit, found.after_joining) == (6, 600.0, 30.0)
    assert read_campaign(found.as_tables()) == found
    case = draw_flight(found, 0).case
    assert (case.scenario.duration_limit, case.scenario.after_joining) == (600.0, 30.0)


def test_the_example_is_the_campaign_of_the_page() -> None:
    assert load_campaign(ROOT / "examples" / "mixed.toml").total == 2_000
    found = load_campaign(ROOT / "examples" / "campaign.toml")
    assert (found.seed, found.flights, len(found.points)) == (0, 100, 8)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ({}, "campaign.flights is missing; it must be a whole number."),
        ({"campaign": {"flights": 3}}, "campaign.family is missing; it must be one of declared, "),
        ({"campaign": {**HEAD, "flights": 0}}, "campaign.flights must be a whole number of 1 or "),
        ({"campaign": {**HEAD, "family": "follows"}}, "family of a campaign; did you mean follow?"),
        (
            {"campaign": {**HEAD, "sed": 1}},
            "campaign.sed is not a key of a campaign; did you mean seed?",
        ),
        ({"campaign": HEAD, "vari": {}}, "vari is not a key of a campaign; did you mean vary?"),
        ({"campaign": HEAD, "vary": 3}, "vary must be a table: write [vary]."),
        (
            {"campaign": HEAD, "vary": {"wind_eror_mps": 3}},
            "vary.wind_eror_mps is not a key of a campaign; did you mean wind_error_mps?",
        ),
        (
            {"campaign": HEAD, "vary": {"wind_mps": {"uniform": [3]}}},
            "vary.wind_mps must be { uniform = [LOW, HIGH] }, { normal = [MEAN, DEVIATION] }",
        ),
        (
            {"campaign": HEAD, "vary": {"wind_mps": {"uniform": [30, 3]}}},
            "vary.wind_mps: uniform must be [LOW, HIGH], not from 30 down to 3.",
        ),
        (
            {"campaign": HEAD, "vary": {"wind_mps": {"normal": [5, -1]}}},
            "vary.wind_mps: the deviation of normal must be 0 or more.",
        ),
        (
            {"campaign": HEAD, "sweep": {"wind_mps": [0, 500]}},
            "sweep.wind_mps must lie in 0 … 150 m/s, not 500 m/s.",
        ),
        ({"campaign": HEAD, "sweep": {"wind_mps": 5}}, "sweep.wind_mps must be a list of numbers"),
        ({"campaign": HEAD, "sweep": {"wind_mps": [5, 5]}}, "sweep.wind_mps has a value twice"),
        (
            {"campaign": HEAD, "sweep": {"wind_mps": [5]}, "vary": {"wind_mps": 3}},
            "wind_mps is in [vary] and in [sweep]: leave out one of them.",
        ),
        (
            {"campaign": {**HEAD, "family": "recorded"}, "vary": {"leader_tas_mps": 200}},
            "leader_tas_mps says nothing of recorded leaders: leave it out.",
        ),
    ],
)
def test_what_is_wrong_is_said_with_its_key(content: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValueError, match=re.escape(sentence)):
        read_campaign(content)


def test_the_file_is_named(tmp_path: Path) -> None:
    file = tmp_path / "run.toml"
    file.write_text("[campaign\n")
    with pytest.raises(ValueError, match=r"run.toml must be TOML: Expected ']'"):
        load_campaign(file)
    file.write_text("[campaign]\nflights = 3\n")
    with pytest.raises(ValueError, match=r"run.toml: campaign.family is missing"):
        load_campaign(file)


def test_a_key_is_no_figure_and_names_its_unit() -> None:
    assert not set(KEYS) & set(Row.__dataclass_fields__)
    for name in KEYS:
        assert name in ("nacp", "nacv") or name.endswith(UNITS)


CREW = [
    {"t_s": 0.0, "engagement": "designated"},
    {"on": "proposed", "after_s": 5.0, "engagement": "armed"},
    {"on": "armed", "after_s": 10.0, "engagement": "engaged"},
]


def test_a_crew_is_read_as_its_script_and_written_back() -> None:
    about = {"flights": 3, "family": "declared"}
    campaign = read_campaign({"campaign": about, "crew": CREW})
    assert campaign.crew == (
        CrewOrder(command=SetEngagement(engagement="designated")),
        CrewOrder(command=SetEngagement(engagement="armed"), on="proposed", after=5.0),
        CrewOrder(command=SetEngagement(engagement="engaged"), on="armed", after=10.0),
    )
    assert read_campaign(campaign.as_tables()) == replace(campaign, script=tuple(CREW))
    assert "crew" not in read_campaign({"campaign": about}).as_tables()


@pytest.mark.parametrize(
    ("crew", "said"),
    [
        ([{"engagement": "armed"}], "crew, order 1: "),
        ([CREW[0], {"t_s": 1.0, "leader_tas_mps": 200.0}], "crew, order 2: "),
        ({"t_s": 0.0}, "crew must be a list of tables"),
        ([3], "crew must be a list of tables"),
        ([], r"crew is empty, and a crew's script has one order or more: leave it out\."),
        (
            [*CREW, {"t_s": 5.0, "director": True}, {"t_s": 4.0, "director": True}],
            r"crew, order 5: t_s: must be at least 5, that of the order before, not 4\.",
        ),
    ],
)
def test_what_is_no_script_is_refused(crew: object, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        read_campaign({"campaign": {"flights": 3, "family": "declared"}, "crew": crew})

"""Queues of a flight as outsiders send them: there, placed, and refused by their paths."""

from typing import Any

import pytest

from relguide.contract.flown_bodies import FlownSituationBody, scenario_from_body
from relguide.contract.refusal import ContractError, parse
from relguide.flying.flight import world_of
from relguide.units import DEG

BODY: dict[str, Any] = {
    "pursuer": {"x_m": -45e3, "y_m": 15e3, "heading_deg": 90, "tas_mps": 235, "max_bank_deg": 25},
    "leader": {"x_m": 0, "y_m": 0, "heading_deg": 90, "tas_mps": 200},
    "slot_distance_m": 12_000,
    "min_separation_m": 9_260,
}
ONE: dict[str, Any] = {
    "ident": "SECOND", "x_m": -80e3, "y_m": -10e3, "heading_deg": 80, "tas_mps": 230,
    "max_bank_deg": 20,
}  # fmt: skip


def scenario_of(**fields: Any) -> Any:
    return scenario_from_body(parse(FlownSituationBody, BODY | fields))[0]


def test_a_queue_is_flown_as_it_is_sent() -> None:
    first = ONE | {"ident": "FIRST", "x_m": -20e3}
    links = world_of(scenario_of(ahead=[first], followers=[ONE])).links
    assert [(link.pursuer, link.leader) for link in links] == [
        ("PURSUER", "FIRST"),
        ("FIRST", "LEADER"),
        ("SECOND", "PURSUER"),
    ]
    (found,) = scenario_of(followers=[ONE]).followers
    own = found.pursuer
    assert (found.ident, own.x, own.y, own.tas) == ("SECOND", -80e3, -10e3, 230.0)
    assert (own.heading, own.max_bank) == pytest.approx((80.0 * DEG, 20.0 * DEG))


def test_without_one_it_is_the_flight_of_the_pair() -> None:
    assert scenario_of() == scenario_of(ahead=[], followers=[])
    assert scenario_of().followers == ()


def test_on_the_earth_it_is_placed_as_the_pursuer_is() -> None:
    placed = {"lat_deg": 48.0, "lon_deg": 2.0}
    north = {"lat_deg": 48.5, "lon_deg": 2.0}

    def on_earth(body: dict[str, Any], place: dict[str, float]) -> dict[str, Any]:
        return {name: value for name, value in body.items() if name[1:] != "_m"} | place

    found = scenario_of(
        pursuer=on_earth(BODY["pursuer"], north),
        leader=on_earth(BODY["leader"], placed),
        followers=[on_earth(ONE, north)],
    )
    own, follower = found.situation.pursuer, found.followers[0].pursuer
    assert (follower.x, follower.y) == (own.x, own.y)
    assert follower.y == pytest.approx(55_600.0, abs=100.0)


@pytest.mark.parametrize(
    ("fields", "path", "sentence"),
    [
        ({"followers": [ONE, ONE]}, "followers[1].ident", "the follower of a flight is called"),
        ({"followers": [ONE | {"ident": "LEADER"}]}, "followers[0].ident", "the leader of a fli"),
        ({"ahead": [ONE], "followers": [ONE]}, "followers[0].ident", "choose another"),
        (
            {"followers": [{**ONE, "tas_mps": 900}]},
            "followers[0].tas_mps",
            "must lie in 30 … 400 m/s",
        ),
        (
            {"ahead": [{"lat_deg": 1, "lon_deg": 1} | {n: ONE[n] for n in ONE if n[1:] != "_m"}]},
            "ahead[0]",
            "must have x_m, y_m or lat_deg, lon_deg as the pursuer",
        ),
        ({"followers": [ONE] * 10}, "followers", "at most 9"),
        ({"followers": [ONE | {"colour": 1}]}, "followers[0].colour", "not a field of the contr"),
    ],
)
def test_a_wrong_one_is_refused_by_its_path(
    fields: dict[str, Any], path: str, sentence: str
) -> None:
    with pytest.raises(ContractError) as refused:
        scenario_of(**fields)
    (at, said), *_ = refused.value.problems
    assert at == path
    assert sentence in said

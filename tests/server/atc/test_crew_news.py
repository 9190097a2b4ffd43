"""What a crew is told of its clearance, in its flight's own documents."""

from collections.abc import Iterator

import pytest
from relguide_server.app import create_app
from relguide_server.settings import ServiceSettings

from relguide.flying.documents import ClearanceNews
from tests.server.atc.asking import CLEARANCES
from tests.server.atc.test_watching import FLIGHTS, cleared, desk_of, start, tell, wait_for
from tests.server.serving import TestClient


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    """A service that really flies, and whose automation answers."""
    with TestClient(create_app(ServiceSettings(workers=0))) as client:
        yield client


def told(client: TestClient, flight: str) -> list[ClearanceNews]:
    """The newest that the crew of a flight was told; none if it was told nothing."""
    found = desk_of(client).skies.flight(flight)
    assert found is not None
    return [d for d in found.history.documents() if isinstance(d, ClearanceNews)]


def test_a_crew_is_told_step_by_step_what_becomes_of_its_request(client: TestClient) -> None:
    flight = start(client)
    case = cleared(client, flight)
    wait_for(lambda: [one.clearance for one in told(client, flight)] == ["validated"])
    (news,) = told(client, flight)
    assert (news.clearance_id, news.automated, news.level) == (case.clearance.id, True, "none")
    assert news.message == case.clearance.history[-1].message
    client.post(f"{CLEARANCES}/{case.clearance.id}/replies", json={"reply": "WILCO"})
    wait_for(lambda: told(client, flight)[0].clearance == "wilco")
    assert not told(client, flight)[0].automated
    tell(client, flight, command="set_engagement", engagement="armed")
    wait_for(lambda: client.get(f"{FLIGHTS}/{flight}").json()["engagement"] == "armed")
    tell(client, flight, command="set_engagement", engagement="engaged")
    wait_for(lambda: told(client, flight)[0].clearance == "flying")
    client.post(f"{CLEARANCES}/{case.clearance.id}/replies", json={"reply": "CANCEL"})
    wait_for(lambda: told(client, flight)[0].clearance == "over")


def test_a_request_in_place_of_another_is_all_that_a_crew_hears_of(client: TestClient) -> None:
    flight = start(client)
    first, second = cleared(client, flight), cleared(client, flight)
    assert first.state == "superseded"
    new = [second.clearance.id]
    wait_for(lambda: [one.clearance_id for one in told(client, flight)] == new)

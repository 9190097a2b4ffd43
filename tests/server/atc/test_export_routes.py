"""Clearances as files over REST, of this run of the service and of an earlier one."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from relguide_server.atc.export_routes import MEDIA
from relguide_server.atc.feeds.asterix_records import decode

from tests.server.atc.asking import CLEARANCES, LEADER, ask
from tests.server.atc.test_clearance_routes import opened, recording
from tests.server.serving import TestClient, ideal_app
from tests.server.test_api import is_problem


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(ideal_app(atc_auto_answer="off")) as client:
        yield client


def test_each_form(client: TestClient) -> None:
    card = ask(client)
    path = f"{CLEARANCES}/{card['id']}/export"
    for form, media in MEDIA.items():
        answer = client.get(f"{path}?format={form}")
        assert answer.status_code == 200, answer.text
        assert answer.headers["content-type"].partition(";")[0] == media
        assert card["id"] in answer.headers["content-disposition"]
        assert form == "asterix" or card["id"] in answer.text
    said = client.get(path).json()
    assert said["asked_at"] == card["history"][0]["at"]
    first = said["features"][0]["geometry"]["coordinates"][0]
    assert first[:2] == pytest.approx([card["route"]["lon_deg"][0], card["route"]["lat_deg"][0]],
                                      abs=1e-6)  # fmt: skip
    begins = said["features"][0]["properties"]["t_s"][0]
    idents = {
        one.ident for one in decode(client.get(f"{path}?format=asterix").content, begins).found
    }
    assert idents == {"RG 06", LEADER}
    is_problem(client.get(f"{path}?format=pdf"), 422, path)
    is_problem(client.get(f"{CLEARANCES}/none/export"), 404, f"{CLEARANCES}/none/export")


@pytest.mark.slow
def test_one_of_an_earlier_run(tmp_path: Path) -> None:
    with recording(tmp_path) as client:
        opened(client)
        path = f"{CLEARANCES}/{ask(client)['id']}/export"
        before = client.get(path).json()
    with recording(tmp_path) as client:
        opened(client)
        after = client.get(path).json()
    for one, other in zip(before["features"][:2], after["features"][:2], strict=True):
        assert one["properties"] == other["properties"]
        for place, again in zip(
            one["geometry"]["coordinates"], other["geometry"]["coordinates"], strict=True
        ):
            assert again == pytest.approx(place, abs=2e-7)

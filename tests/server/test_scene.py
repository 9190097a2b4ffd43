"""The picture in 3D: every kind of document is drawn, on a real viser server."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from relguide_server import scene_paint as paint
from relguide_server.scene import Scene
from relguide_server.scene_shapes import ALTITUDE_SCALE
from viser import ViserServer

from relguide.flying.documents import Document, PlanUnavailable, Sample
from relguide.flying.plan_documents import NoPlanCard
from relguide.planning.plan import Reason
from tests.documents import rare_documents
from tests.server.flown import LEADER, OWN, ideal_flight


@pytest.fixture
def viser_server() -> Iterator[ViserServer]:
    server = ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


@pytest.fixture
def documents() -> list[Document]:
    return list(ideal_flight(duration=20.0, step=1.0))


def nodes(server: ViserServer) -> dict:
    return server.scene._handle_from_node_name


def test_a_flight_is_drawn_whole(viser_server: ViserServer, documents: list[Document]) -> None:
    Scene(viser_server).draw(documents)
    for name in (
        "pursuer/body/mesh",
        "leader/min_separation",
        "plan",
        "route",
        "slot/gate",
        "grid",
    ):
        assert f"/world/{name}" in nodes(viser_server)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    place = nodes(viser_server)["/world/leader"].position
    _, leader = sample.aircraft
    altitude = leader.altitude / 1000.0 * ALTITUDE_SCALE
    assert place == pytest.approx([leader.x / 1000, leader.y / 1000, altitude])


def test_the_middle_of_the_two_stays_at_the_origin(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = Scene(viser_server)
    for document in documents:
        scene.draw([document])
    known = nodes(viser_server)
    both = known["/world/pursuer"].position + known["/world/leader"].position
    assert known["/world"].position[:2] == pytest.approx(-both[:2] / 2.0)


def test_what_is_about_others_or_only_for_the_crew_changes_nothing(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = Scene(viser_server)
    scene.draw(documents)
    before = set(nodes(viser_server))
    answer = NoPlanCard(reason=Reason.SLOT_UNREACHABLE, message="Too fast a leader.")
    scene.draw(
        [*rare_documents(20.0, OWN, LEADER), PlanUnavailable(t=20.0, ident="OTHER", answer=answer)]
    )
    assert set(nodes(viser_server)) == before


def test_without_a_plan_none_is_shown(viser_server: ViserServer, documents: list[Document]) -> None:
    scene = Scene(viser_server)
    scene.draw(documents)
    answer = NoPlanCard(reason=Reason.SLOT_UNREACHABLE, message="Too fast a leader.")
    scene.draw([PlanUnavailable(t=20.0, ident=OWN, answer=answer)])
    assert not [name for name in nodes(viser_server) if name.startswith("/world/plan")]


def test_a_lost_limit_and_a_joined_slot_change_colour(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = Scene(viser_server)
    scene.draw(documents)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    assert tuple(nodes(viser_server)["/world/leader/min_separation"].color) == paint.LEADER
    close = replace(sample.guidance[0], separation=1000.0, joined=True)
    scene.draw([replace(sample, guidance=(close,))])
    assert tuple(nodes(viser_server)["/world/leader/min_separation"].color) == paint.ALERT
    gate = np.asarray(nodes(viser_server)["/world/slot/gate"].colors)
    assert tuple(gate.reshape(-1, 3)[0]) == paint.PLAN


def test_the_first_picture_has_both_aircraft_in_it(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    Scene(viser_server).draw(documents)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    away = np.linalg.norm(viser_server.initial_camera.position)
    assert away > sample.guidance[0].separation / 1000.0

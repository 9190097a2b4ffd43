"""The picture in 3D: every kind of document is drawn, on a real viser server."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from relguide_server.scene import paint as paint
from relguide_server.scene.aircraft import enlargement, place_of
from relguide_server.scene.camera import ROOM, SHAPE
from relguide_server.scene.flight_scene import FlightScene
from relguide_server.scene.shapes import ALTITUDE_SCALE
from viser import ViserServer

from relguide.flying.aircraft_documents import CellCard
from relguide.flying.documents import (
    Alert,
    Document,
    FlightEnded,
    FlightStarted,
    ForecastChanged,
    ModeChanged,
    PlanUnavailable,
    Sample,
)
from relguide.flying.modes import Mode
from relguide.flying.plan_documents import NoPlanCard, PathPoint
from relguide.planning.outcome import Reason
from tests.documents import rare_documents
from tests.server.flown import LEADER, OWN, ideal_flight
from tests.server.scene.test_camera import pictured


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


def middle_of_both(known: dict) -> np.ndarray:
    both = known["/world/pursuer"].position + known["/world/leader"].position
    return both[:2] / 2.0


def test_a_flight_is_drawn_whole(viser_server: ViserServer, documents: list[Document]) -> None:
    FlightScene(viser_server).draw(documents)
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
    scene = FlightScene(viser_server)
    for document in documents:
        scene.draw([document])
    known = nodes(viser_server)
    assert known["/world"].position[:2] == pytest.approx(-middle_of_both(known))


def test_what_is_about_others_or_only_for_the_crew_changes_nothing(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    before = set(nodes(viser_server))
    answer = NoPlanCard(reason=Reason.SLOT_UNREACHABLE, message="Too fast a leader.")
    rare = [d for d in rare_documents(20.0, OWN, LEADER) if not isinstance(d, ForecastChanged)]
    others = [d for d in rare_documents(20.0, "OTHER", LEADER) if isinstance(d, ForecastChanged)]
    scene.draw([*rare, *others, PlanUnavailable(t=20.0, ident="OTHER", answer=answer)])
    assert set(nodes(viser_server)) == before


def forecast(documents: list[Document], *, t: float, until: float) -> ForecastChanged:
    """Straight east from where own ship is in the last sample, a point each ten seconds."""
    own, leader = next(d for d in reversed(documents) if isinstance(d, Sample)).aircraft
    times = np.arange(t, until + 1.0, 10.0)
    return ForecastChanged(
        t=t,
        ident=OWN,
        times=tuple(times),
        x=tuple(own.x + 240.0 * (times - t)),
        y=(own.y,) * len(times),
        heading=(np.pi / 2.0,) * len(times),
        least_separation=10_000.0,
        pursuer_at_closest=PathPoint(t=until, x=own.x, y=own.y, heading=0.0),
        leader_at_closest=PathPoint(t=until, x=leader.x, y=leader.y, heading=0.0),
    )


def test_the_path_that_will_be_flown_is_drawn_at_the_height_of_own_ship(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    own, leader = sample.aircraft
    higher = replace(sample, aircraft=(replace(own, altitude=own.altitude + 1_000.0), leader))
    ahead = forecast(documents, t=20.0, until=900.0)
    scene.draw([*documents, higher, ahead])
    points = np.asarray(nodes(viser_server)["/world/forecast"].points)
    assert points[..., 2] == pytest.approx((own.altitude / 1000.0 + 1.0) * ALTITUDE_SCALE)
    assert points[-1, 1, 0] == pytest.approx(ahead.x[-1] / 1000.0, abs=0.01)
    assert nodes(viser_server)["/world/plan"].thickness < 1.5


def test_the_flown_part_of_the_path_goes(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    ahead = forecast(documents, t=20.0, until=900.0)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    scene.draw([*documents, ahead])
    guidance = replace(sample.guidance[0], time_to_go=501.0)
    scene.draw([replace(sample, t=120.0, guidance=(guidance,))])
    points = np.asarray(nodes(viser_server)["/world/forecast"].points)
    assert points[0, 0, 0] == pytest.approx((ahead.x[0] + 24_000.0) / 1000.0, abs=0.01)
    assert points[-1, 1, 0] == pytest.approx((ahead.x[0] + 240.0 * 601.0) / 1000.0, abs=0.01)
    joined = replace(guidance, time_to_go=0.0)
    scene.draw([replace(sample, t=901.0, guidance=(joined,))])
    assert "/world/forecast" not in nodes(viser_server)


@pytest.mark.parametrize("mode", ["heading", "escape", "follow"])
def test_the_ideal_path_goes_when_the_plan_is_flown_no_more(
    viser_server: ViserServer, documents: list[Document], mode: Mode
) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    scene.draw([ModeChanged(t=20.0, ident=OWN, mode=mode, previous="converge", message="Why.")])
    assert "/world/plan" not in nodes(viser_server)


def test_without_a_plan_none_is_shown(viser_server: ViserServer, documents: list[Document]) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    answer = NoPlanCard(reason=Reason.SLOT_UNREACHABLE, message="Too fast a leader.")
    scene.draw([PlanUnavailable(t=20.0, ident=OWN, answer=answer)])
    assert not [name for name in nodes(viser_server) if name.startswith("/world/plan")]


def test_a_lost_limit_and_an_escape_change_colour(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    assert tuple(nodes(viser_server)["/world/leader/min_separation"].color) == paint.LEADER
    gate = np.asarray(nodes(viser_server)["/world/slot/gate"].colors)
    assert tuple(gate.reshape(-1, 3)[0]) == paint.PLAN
    unable = replace(sample.guidance[0], mode="heading", engagement="engaged")
    scene.draw([replace(sample, guidance=(unable,))])
    gate = np.asarray(nodes(viser_server)["/world/slot/gate"].colors)
    assert tuple(gate.reshape(-1, 3)[0]) == paint.CAUTION
    close = replace(sample.guidance[0], separation=1000.0, mode="escape")
    scene.draw([replace(sample, guidance=(close,))])
    assert tuple(nodes(viser_server)["/world/leader/min_separation"].color) == paint.ALERT
    gate = np.asarray(nodes(viser_server)["/world/slot/gate"].colors)
    assert tuple(gate.reshape(-1, 3)[0]) == paint.CAUTION


def test_the_first_picture_has_both_aircraft_in_it(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    FlightScene(viser_server).draw(documents)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    camera = viser_server.initial_camera
    own, leader = (np.array(place_of(each)) for each in sample.aircraft)
    middle = (own + leader) / 2.0 * (1.0, 1.0, 0.0)
    places = np.array([own, leader]) - middle
    seen = pictured(np.array(camera.position), np.array(camera.look_at), places, SHAPE)
    assert np.abs(seen).max() <= ROOM + 1e-9


def test_it_glides_on_from_the_newest_sample(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    own, leader = sample.aircraft
    scene.glide(0.5)
    known = nodes(viser_server)
    for aircraft, name in ((own, "pursuer"), (leader, "leader")):
        x, y, _ = known[f"/world/{name}"].position
        moved = np.hypot(x - aircraft.x / 1000.0, y - aircraft.y / 1000.0) * 1000.0
        assert moved == pytest.approx(0.5 * aircraft.ground_speed, abs=0.1)
    assert known["/world"].position[:2] == pytest.approx(-middle_of_both(known))


def test_the_closest_approach_is_drawn_until_it_is_passed(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    ahead = forecast(documents, t=20.0, until=900.0)
    own, leader = ahead.pursuer_at_closest, ahead.leader_at_closest
    soon = replace(
        ahead, pursuer_at_closest=replace(own, t=100.0), leader_at_closest=replace(leader, t=100.0)
    )
    scene.draw([*documents, soon])
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    guided = replace(sample.guidance[0], time_to_go=500.0)
    scene.draw([replace(sample, t=50.0, guidance=(guided,))])
    points = np.asarray(nodes(viser_server)["/world/closest"].points).reshape(-1, 3)
    assert np.array((own.x / 1000.0, own.y / 1000.0)) == pytest.approx(points[-2, :2], abs=1e-3)
    assert np.array((leader.x / 1000.0, leader.y / 1000.0)) == pytest.approx(
        points[-1, :2], abs=1e-3
    )
    scene.draw([replace(sample, t=101.0, guidance=(guided,))])
    assert "/world/closest" not in nodes(viser_server)


def test_the_past_is_marks(viser_server: ViserServer, documents: list[Document]) -> None:
    FlightScene(viser_server).draw(documents)
    marks = np.asarray(nodes(viser_server)["/world/leader_past"].points)
    assert marks.shape == (3, 2, 3)  # at 0, 10 and 20 s
    assert np.linalg.norm(marks[0, 1] - marks[0, 0]) < 0.2 * np.linalg.norm(marks[1] - marks[0])


def test_the_gate_of_a_joined_aircraft_leaves_its_middle_free(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    scene.draw([replace(sample, guidance=(replace(sample.guidance[0], joined=True),))])
    held = np.asarray(nodes(viser_server)["/world/slot/gate"].points)
    reach = np.abs(held).max(axis=(0, 1))
    assert (np.abs(held) > 0.5 * reach).any(axis=2).all()
    assert (np.abs(held).min(axis=1) / reach > 0.5).sum(axis=1).min() >= 2  # edges only


def test_aircraft_that_come_close_are_drawn_smaller_before_they_touch(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    for separation in (60_000.0, 9_000.0, 3_000.0, 900.0):
        guided = replace(sample.guidance[0], separation=separation)
        scene.draw([replace(sample, guidance=(guided,))])
        for name in ("pursuer", "leader"):
            length = 1000.0 * nodes(viser_server)[f"/world/{name}/body/mesh"].scale
            assert length <= 0.3 * separation + 1e-6
    assert enlargement(60_000.0) == 100.0


def test_a_lost_minimum_paints_the_leader_and_silence_takes_it_away(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    known = nodes(viser_server)
    for changed, colour in (
        ({}, paint.LEADER),
        ({"separation": 1000.0}, paint.ALERT),
        ({"leader_age": 7.0}, paint.CAUTION),
    ):
        scene.draw([replace(sample, guidance=(replace(sample.guidance[0], **changed),))])
        assert tuple(known["/world/leader/body/mesh"].color) == colour
    before = known["/world/leader/min_separation"].radius
    silent = replace(sample.guidance[0], leader_age=15.0, engagement="designated")
    scene.draw([replace(sample, guidance=(silent,))])
    assert not known["/world/slot"].visible
    assert not known["/world/route"].visible
    assert known["/world/leader/min_separation"].radius > before
    assert known["/world/leader"].visible
    scene.draw([replace(sample, guidance=(replace(silent, leader_age=25.0),))])
    assert not known["/world/leader"].visible


def test_what_is_kept_beside_the_minimum_is_a_circle_of_its_own(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    scene.draw(documents)
    assert "/world/leader/margin" not in nodes(viser_server)
    sample = next(d for d in reversed(documents) if isinstance(d, Sample))
    wary = replace(sample.guidance[0], margin=900.0)
    scene.draw([replace(sample, guidance=(wary,))])
    margin = np.asarray(nodes(viser_server)["/world/leader/margin"].points)
    minimum = nodes(viser_server)["/world/leader/min_separation"].radius
    assert np.hypot(margin[..., 0], margin[..., 1]).max() == pytest.approx(minimum + 0.9)
    scene.draw([sample])
    assert "/world/leader/margin" not in nodes(viser_server)


def among_others(documents: list[Document]) -> list[Document]:
    """The same flight with an aircraft 3,000 m below the leader, and two cells."""
    disc = CellCard(ident="CB1", x=(30e3,), y=(0.0,), radius=8e3, east=10.0, north=0.0, growth=20.0)
    square = CellCard(
        ident="CB2", x=(0.0, 9e3, 9e3, 0.0), y=(0.0, 0.0, 9e3, 9e3), radius=0.0, east=0.0,
        north=0.0, growth=0.0,
    )  # fmt: skip
    met: list[Document] = []
    for document in documents:
        if isinstance(document, FlightStarted):
            met.append(replace(document, cells=(disc, square)))
        elif isinstance(document, Sample):
            leader = document.aircraft[1]
            other = replace(leader, ident="BAW12", y=leader.y + 9e3, altitude=leader.altitude - 3e3)
            met.append(replace(document, aircraft=(*document.aircraft, other)))
        else:
            met.append(document)
    return met


def test_others_are_drawn_at_their_levels_and_cells_as_columns_that_move_and_grow(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    FlightScene(viser_server).draw(among_others(documents))
    known = nodes(viser_server)
    leader, other = (known[f"/world/{name}"].position for name in ("leader", "others/0"))
    assert leader[2] - other[2] == pytest.approx(3.0 * ALTITUDE_SCALE)
    assert other[1] - leader[1] == pytest.approx(9.0)
    assert known["/world/cells/0"].position[0] == pytest.approx(10.0 * 20.0 / 1000.0)
    walls = known["/world/cells/0/walls"].vertices
    assert np.hypot(walls[:, 0] - 30.0, walls[:, 1]) == pytest.approx(8.4, abs=0.1)
    assert len(known["/world/cells/1/walls"].vertices) == 8


def test_an_alert_on_another_aircraft_colours_that_one_alone(
    viser_server: ViserServer, documents: list[Document]
) -> None:
    scene = FlightScene(viser_server)
    flight = among_others(documents)
    *before, last = (d for d in flight if not isinstance(d, FlightEnded))
    assert isinstance(last, Sample)
    warned = replace(last, guidance=(replace(last.guidance[0], alert="caution"),))
    alert = next(d for d in rare_documents(last.t, OWN, "BAW12") if isinstance(d, Alert))
    scene.draw([*before, replace(alert, other="BAW12", level="caution", cleared=False), warned])
    known = nodes(viser_server)
    assert known["/world/others/0/body/mesh"].color == paint.CAUTION
    assert known["/world/leader/min_separation"].color == paint.LEADER
    scene.draw([replace(alert, other="BAW12", level="caution", cleared=True), last])
    assert known["/world/others/0/body/mesh"].color == paint.TRAFFIC

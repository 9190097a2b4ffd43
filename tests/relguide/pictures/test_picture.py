"""Pictures of flights: the same from each engine, of what was known then, and refusals."""

import gzip
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest

from relguide import Flight, Picture, fly, picture, plan, record, replay, scenario
from relguide.flying.documents import Document, ModeChanged
from relguide.pictures import bundles
from tests.relguide.pictures.engines import by_node, by_quickjs, recordings, view_of

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Of Fig. 6b, a sample a second."""
    file = tmp_path_factory.mktemp("flown") / "fig_6b.jsonl"
    for _ in record(fly(scenario("fig_6b"), plan, sample_period=1.0), file):
        pass
    return file


@pytest.mark.slow
def test_node_draws_the_same_bytes(tmp_path: Path) -> None:
    for file, seconds in recordings(tmp_path, 4):
        views = [
            view_of(t, mode=mode, palette=palette)
            for t in range(0, seconds, seconds // 4)
            for mode, palette in (("ARC", "dark"), ("ROSE", "light"))
        ]
        for ours, theirs, view in zip(
            by_quickjs(file, views), by_node(file, views), views, strict=True
        ):
            assert ours == theirs, f"{file.name}, {view}"


def test_it_is_one_drawing_with_title_and_words(recording: Path) -> None:
    drawn = picture(recording, 560, caption="made <here>")
    root = ElementTree.fromstring(drawn)
    assert (root.tag, root.get("viewBox")) == (f"{SVG}svg", "0 0 768 824")
    title, words = root.findtext(f"{SVG}title"), root.findtext(f"{SVG}desc")
    assert title is not None
    assert title.startswith("Fig. 6b: the leader's intent is known · 09:20 · ARC 80 NM · relguide ")
    assert words is not None
    assert words.startswith("Own ship converging, heading 107.")
    assert "made <here>" in [text.text for text in root.iter(f"{SVG}text")]
    assert "var(" not in drawn


def test_a_flight_flown_now_and_its_recording_are_the_same(recording: Path) -> None:
    """Twenty samples a second or one: taken is one a second."""
    flown = picture(fly(scenario("fig_6b"), plan), 60.0)
    assert flown == picture(recording, 60.0) == picture(replay(recording), 60.0)


def test_packed_files_are_read(recording: Path, tmp_path: Path) -> None:
    packed = tmp_path / "flight.jsonl.gz"
    packed.write_bytes(gzip.compress(recording.read_bytes()))
    assert picture(packed, 300.0) == picture(recording, 300.0)


def test_a_flight_is_flown_no_further_than_is_drawn() -> None:
    seen: list[float] = []

    def watched() -> Iterator[Document]:
        for document in fly(scenario("fig_6b"), plan, sample_period=1.0):
            seen.append(document.t)
            yield document

    picture(watched(), 30.0)
    assert seen[-1] == 31.0


def test_between_two_samples_both_are_moved_on(recording: Path) -> None:
    at = {t: picture(recording, t, range_nm=10) for t in (560.0, 560.5, 561.0)}
    assert len(set(at.values())) == 3
    flown = list(replay(recording))
    news = next(d for d in flown if isinstance(d, ModeChanged))
    later = flown.index(next(d for d in flown if d.t == 561.0))
    flown.insert(later, replace(news, t=560.7))  # not known yet, and no sample to move towards
    assert picture(flown, 560.5, range_nm=10) == at[560.5]


@pytest.mark.parametrize(("t", "said"), [(-1.0, "-1"), (1e6, "1e+06")])
def test_an_instant_outside_is_refused_with_the_span(recording: Path, t: float, said: str) -> None:
    expected = (
        rf"^t = {said.replace('+', '.')} s is outside the flight, which goes from 0 s to 1036 s\.$"
    )
    with pytest.raises(ValueError, match=expected):
        picture(recording, t)


def test_a_view_that_is_none_is_refused(recording: Path) -> None:
    with pytest.raises(ValueError, match=r"^mode must be ARC or ROSE, not 'PLAN'"):
        picture(recording, 1.0, mode="PLAN")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^palette must be dark or light, not 'red'"):
        picture(recording, 1.0, palette="red")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^range_nm must be one of 10, 20, 40, .* NM, not 50"):
        picture(recording, 1.0, range_nm=50)


def test_a_broken_file_is_refused_with_its_line(recording: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.jsonl"
    lines = recording.read_text().splitlines(keepends=True)
    broken.write_text("".join([*lines[:200], '{"kind":\n', *lines[200:]]))
    with pytest.raises(ValueError, match=r"broken\.jsonl, line 201: "):
        picture(broken, 560.0)
    assert picture(broken, 100.0) == picture(recording, 100.0)


def test_nothing_is_no_flight() -> None:
    with pytest.raises(ValueError, match="the flight has no documents"):
        picture([], 0.0)
    with pytest.raises(ValueError, match="FlightStarted"):
        Flight([])


def test_in_pixels(recording: Path) -> None:
    png = picture(recording, 560.0).png(zoom=1)
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert (int.from_bytes(png[16:20]), int.from_bytes(png[20:24])) == (768, 803)
    with pytest.raises(ValueError, match="zoom must be a whole number from 1 to 8, not 0"):
        Picture("<svg/>").png(zoom=0)


def test_a_notebook_shows_a_flight_half_way_to_its_join(
    recording: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    flight = Flight(replay(recording))
    assert (flight.duration, flight.join_time) == (1036.0, 916.0)
    assert repr(flight).startswith("Flight(Fig. 6b: the leader's intent is known: ")
    assert flight._repr_svg_() == picture(recording, 458.0, palette="light")
    assert flight.picture()._repr_svg_() == picture(recording, 458.0)
    monkeypatch.setattr(bundles, "FOLDERS", ())
    assert flight._repr_svg_() is None


def test_a_relguide_without_its_page_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bundles, "FOLDERS", ())
    with pytest.raises(ValueError, match=r"^picture\.js is missing: .*python web/build_page\.py"):
        bundles.bundle("picture.js")

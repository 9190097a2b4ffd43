"""Recordings: a line a document, whole or damaged."""

import gzip
import json
from dataclasses import replace
from math import nan, remainder, tau
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide.contract.recorder import RecordingError, record, recording_of, replay
from relguide.flying.documents import Document, FlightEnded, LeaderChanged, Sample
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.planning.plan import plan
from tests.documents import documents
from tests.pages import ROOT
from tests.relguide.contract.test_wire import SAMPLE, assert_equal

SAID = LeaderChanged(
    t=3.0, ident="LDR 01", change="heading", message="The leader turns right.\nÜber λ"
)


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    file = tmp_path / "flight.jsonl"
    assert len(list(record([SAMPLE, SAID, SAMPLE], file, sample_rate=None))) == 3
    return file


def read_until_bad(file: Path) -> tuple[list[Document], str]:
    good: list[Document] = []
    try:
        for document in replay(file):
            good.append(document)
    except RecordingError as error:
        return good, str(error)
    return good, ""


@given(flown=st.lists(documents(), max_size=5), ending=st.sampled_from([".jsonl", ".jsonl.gz"]))
@settings(max_examples=40)
def test_a_replay_gives_what_was_recorded(
    tmp_path_factory: pytest.TempPathFactory, flown: list[Any], ending: str
) -> None:
    file = tmp_path_factory.mktemp("flight") / f"a{ending}"
    assert list(record(flown, file, sample_rate=None)) == flown
    read = list(replay(file))
    assert len(read) == len(flown)
    for one, other in zip(read, flown, strict=True):
        assert_equal(one, other)


@given(flown=st.lists(documents(), max_size=5))
@settings(max_examples=40)
def test_of_the_samples_what_can_be_seen_is_recorded(
    tmp_path_factory: pytest.TempPathFactory, flown: list[Any]
) -> None:
    """One each second, to 1 mm; all else is there with all its digits."""
    file = tmp_path_factory.mktemp("flight") / "a.jsonl"
    flown = [replace(d, t=float(i)) if isinstance(d, Sample) else d for i, d in enumerate(flown)]
    assert list(record(flown, file)) == flown
    for read, given_ in zip(replay(file), flown, strict=True):
        if not isinstance(given_, Sample):
            assert_equal(read, given_)
            continue
        assert isinstance(read, Sample)
        assert (read.t, len(read.aircraft)) == (given_.t, len(given_.aircraft))
        for one, other in zip(read.aircraft, given_.aircraft, strict=True):
            assert (one.x, one.y) == pytest.approx((other.x, other.y), rel=1e-12, abs=6e-4)
            assert abs(remainder(one.heading - other.heading, tau)) < 1e-8 + 1e-12 * abs(
                other.heading
            )
            assert 0.0 <= one.heading < tau
            assert one.bank == pytest.approx(other.bank, rel=1e-12, abs=1e-8)
            assert one.tas == pytest.approx(other.tas, rel=1e-12, abs=6e-5)


@pytest.mark.parametrize(("rate", "kept"), [(1.0, [0, 1, 2]), (2.0, [0, 0.5, 1, 1.5, 2])])
def test_samples_are_as_frequent_as_asked_and_the_last_is_there(
    tmp_path: Path, rate: float, kept: list[float]
) -> None:
    file = tmp_path / "a.jsonl"
    end = FlightEnded(t=2.25, reason="time_over", message="It ends.", results=())
    flown = [*(replace(SAMPLE, t=0.05 * k) for k in range(46)), end]
    list(record(flown, file, sample_rate=rate))
    *samples, last = replay(file)
    assert last == end
    assert [sample.t for sample in samples] == pytest.approx([*kept, 2.25], abs=1e-9)


@pytest.mark.slow
def test_a_flight_of_a_quarter_of_an_hour_has_less_than_a_megabyte(tmp_path: Path) -> None:
    file = tmp_path / "a.jsonl"
    *_, end = record(fly(scenario("fig_6b"), plan), file)
    assert end.t > 17 * 60.0
    assert file.stat().st_size < 1e6
    (*_, last) = replay(file)
    assert last == end


@pytest.mark.parametrize("rate", [0.0, -1.0, nan, True, "often"])
def test_a_rate_that_is_none_is_refused(tmp_path: Path, rate: Any) -> None:
    with pytest.raises(ValueError, match="sample_rate"):
        record([], tmp_path / "a.jsonl", sample_rate=rate)


def test_the_first_line_says_what_the_file_is(recording: Path) -> None:
    lines = recording.read_text().splitlines()
    assert json.loads(lines[0]) == {"format": "relguide-flight", "version": 3}
    assert [json.loads(line)["kind"] for line in lines[1:]] == [
        "sample",
        "leader_changed",
        "sample",
    ]


def test_gz_is_compressed(tmp_path: Path) -> None:
    file = tmp_path / "a.jsonl.gz"
    list(record([SAID], file))
    assert gzip.decompress(file.read_bytes()).count(b"\n") == 2


def test_documents_pass_while_they_are_written(tmp_path: Path) -> None:
    file = tmp_path / "a.jsonl"
    passing = record(iter([SAID, SAMPLE]), file)
    assert not file.exists()
    assert next(passing) is SAID
    passing.close()  # type: ignore[attr-defined]  # what Ctrl-C does
    assert read_until_bad(file) == ([SAID], "")


@pytest.mark.parametrize("name", ["a.json", "a", "a.gz", "a.jsonl.zip"])
def test_another_ending_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(RecordingError, match=r"must end in \.jsonl or \.jsonl\.gz"):
        record([], tmp_path / name)


@pytest.mark.parametrize("cut", [1, 100, 400])
def test_of_a_file_cut_short_the_good_part_is_kept(recording: Path, cut: int) -> None:
    recording.write_bytes(recording.read_bytes()[:-cut])
    good, said = read_until_bad(recording)
    assert len(good) == 2
    assert said == f"{recording}, line 4: the file is cut short here; what comes before is good."


def test_of_a_compressed_file_cut_short_too(tmp_path: Path) -> None:
    file = tmp_path / "a.jsonl.gz"
    list(record([SAMPLE] * 500, file, sample_rate=None))
    file.write_bytes(file.read_bytes()[:-600])
    good, said = read_until_bad(file)
    assert 0 < len(good) < 500
    assert "damaged or cut short" in said


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        (b"\n", "line 3: This is not JSON"),
        (b"{]\n", "line 3: This is not JSON"),
        (b'"sample"\n', "line 3: This must be"),
        (b'{"kind":"sample"}\n', "line 3: t_s: is missing: it must be a number [s]."),
        (b'{"kind":"dive"}\n', "line 3: kind: must be one of"),
        (b"\xff\xff\n", "line 3: This is not UTF-8 text"),
        (b"[" * 100_000 + b"\n", "line 3: This is nested too deeply"),
        (b'{"kind":1e999}\n', "line 3: kind"),
    ],
)
def test_a_damaged_line_is_named(recording: Path, line: bytes, sentence: str) -> None:
    lines = recording.read_bytes().splitlines(keepends=True)
    recording.write_bytes(b"".join([*lines[:2], line, *lines[3:]]))
    good, said = read_until_bad(recording)
    assert len(good) == 1
    assert sentence in said
    assert said.endswith("What comes before is good.")


@pytest.mark.parametrize(
    "content",
    [b"", b"\n", b"{}\n", b"[1]\n", b"\x7fELF\x00\x01", b'{"format":"other","version":1}\n'],
)
def test_another_file_is_refused(tmp_path: Path, content: bytes) -> None:
    file = tmp_path / "a.jsonl"
    file.write_bytes(content)
    with pytest.raises(RecordingError, match="is not a recording"):
        next(replay(file))


def test_a_file_that_is_not_compressed_though_named_so(tmp_path: Path) -> None:
    file = tmp_path / "a.jsonl.gz"
    file.write_bytes(b"{}")
    with pytest.raises(RecordingError, match="is damaged or cut short after line 0"):
        next(replay(file))


@pytest.mark.parametrize("version", [2, 4])
def test_another_version_is_refused(recording: Path, version: int) -> None:
    lines = recording.read_bytes().splitlines(keepends=True)
    lines[0] = b'{"format":"relguide-flight","version":%d}\n' % version
    recording.write_bytes(b"".join(lines))
    with pytest.raises(RecordingError, match=f"of version {version}; this program reads 3"):
        next(replay(recording))


def test_a_missing_file_is_an_os_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        next(replay(tmp_path / "none.jsonl"))


def test_a_recording_in_memory_is_that_of_a_file(tmp_path: Path) -> None:
    flown = [SAMPLE, SAID, SAMPLE]
    file = tmp_path / "flight.jsonl"
    list(record(flown, file))
    assert recording_of(flown) == file.read_bytes()


def test_a_recording_of_an_earlier_release_is_replayed() -> None:
    """Of 0.2.0, with a sample each three minutes: what it does not say reads as nothing."""
    file = ROOT / "tests" / "golden" / "flight-0.2.0.jsonl"
    flown = list(replay(file))
    assert len(flown) == len(file.read_text().splitlines()) - 1
    samples = [document for document in flown if isinstance(document, Sample)]
    assert {sample.guidance[0].margin for sample in samples} == {0.0}
    ended = flown[-1]
    assert isinstance(ended, FlightEnded)
    (result,) = ended.results
    assert (result.join_time, result.optimum, result.along_error) == (917.0, 0.0, 0.0)

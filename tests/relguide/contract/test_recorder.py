"""Recordings: a line a document, whole or damaged."""

import gzip
import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide.contract.recorder import RecordingError, record, replay
from relguide.flying.documents import Document, LeaderChanged
from tests.documents import documents
from tests.relguide.contract.test_wire import SAMPLE, assert_equal

SAID = LeaderChanged(
    t=3.0, ident="LDR 01", change="heading", message="The leader turns right.\nÜber λ"
)


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    file = tmp_path / "flight.jsonl"
    assert len(list(record([SAMPLE, SAID, SAMPLE], file))) == 3
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
    assert list(record(flown, file)) == flown
    read = list(replay(file))
    assert len(read) == len(flown)
    for one, other in zip(read, flown, strict=True):
        assert_equal(one, other)


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
    list(record([SAMPLE] * 500, file))
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
        (b'{"kind":"sample"}\n', "line 3: t_s: is missing."),
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

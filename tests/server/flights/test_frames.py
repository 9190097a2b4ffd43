"""What a client may send up a stream, and why its socket is closed for all else."""

import json

import pytest
from relguide_server.flights.frames import (
    LONGEST,
    LONGEST_REASON,
    MOST,
    NOT_UNDERSTOOD,
    TOO_FAST,
    FrameReader,
    UnwelcomeFrame,
)

from relguide.contract.upstream import GiveBack, StickMove, TakeControl

STICK = {"text": '{"kind":"stick","roll":0.5,"pitch":-1}'}


def refused(event: dict[str, object]) -> UnwelcomeFrame:
    with pytest.raises(UnwelcomeFrame) as found:
        FrameReader().read(event)
    assert len(found.value.reason.encode()) <= LONGEST_REASON
    return found.value


def test_each_frame_of_the_protocol_is_read() -> None:
    reader = FrameReader()
    assert reader.read(STICK) == StickMove(kind="stick", roll=0.5, pitch=-1.0)
    assert reader.read({"text": '{"kind":"take_control"}'}) == TakeControl(kind="take_control")
    assert reader.read({"text": '{"kind":"give_back"}'}) == GiveBack(kind="give_back")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("hello", "not JSON"),
        ("[1]", "must be an object"),
        ('{"kind":"autopilot"}', "kind: must be one of"),
        ('{"kind":"stick","roll":1.2}', "roll: must lie in -1 … 1 of full deflection, not 1.2"),
        ('{"kind":"stick","roll":"left"}', "roll: must be a number"),
        ('{"kind":"stick","roll":0,"yaw":1}', "yaw"),
        ('{"kind":"stick","roll":NaN}', "NaN is not a number"),
        ('{"kind":"stick","roll":0' + " " * LONGEST + "}", f"at most {LONGEST} bytes"),
    ],
)
def test_anything_else_is_told_what_is_wrong(text: str, said: str) -> None:
    found = refused({"text": text})
    assert (found.code, said in found.reason) == (NOT_UNDERSTOOD, True), found.reason


def test_binary_frames_are_refused() -> None:
    assert "must be text" in refused({"bytes": b"\x00"}).reason


def test_a_long_sentence_is_cut_between_letters() -> None:
    found = refused({"text": json.dumps({"kind": "é" * 60}, ensure_ascii=False)})
    assert found.reason.endswith("…")


def test_twenty_a_second_are_fine_for_ever_and_a_flood_is_not() -> None:
    now = 100.0
    reader = FrameReader(lambda: now)
    for _ in range(500):
        now += 1.0 / 20.0
        reader.read(STICK)
    for _ in range(MOST - 1):  # the last one was a twentieth of a second ago
        reader.read(STICK)
    with pytest.raises(UnwelcomeFrame) as found:
        reader.read(STICK)
    assert found.value.code == TOO_FAST
    now += 1.0
    reader.read(STICK)

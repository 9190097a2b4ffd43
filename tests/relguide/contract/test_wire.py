"""Documents go out as JSON with units in its names and come back equal."""

import json
from dataclasses import fields, is_dataclass, replace
from math import inf, nan, pi
from timeit import repeat
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from relguide.contract.document_models import from_wire
from relguide.contract.messages import Tick
from relguide.contract.refusal import ContractError, parse
from relguide.contract.wire import dumps, tick, to_wire
from relguide.flying.aircraft_documents import AircraftSample, GuidanceSample, HeadingReference
from relguide.flying.documents import ForecastChanged, PromiseChanged, Sample, SeparationLost
from relguide.flying.plan_documents import PathPoint
from tests.documents import documents
from tools.display_flights import FOLDER, SITUATIONS, display_flight

AIRCRAFT = AircraftSample(
    ident="RG 06",
    x=-40000.0,
    y=1.0,
    heading=0.5 * pi,
    track=0.5 * pi,
    bank=-0.25 * pi,
    turn_rate=pi / 180.0,
    tas=240.0,
    ground_speed=239.0,
    altitude=9000.0,
)
GUIDANCE = GuidanceSample(
    ident="RG 06",
    leader="LDR 01",
    mode="converge",
    reference=HeadingReference(heading=pi),
    commanded_tas=240.0,
    separation=50000.0,
    closure=30.0,
    least_separation=49000.0,
    slot=PathPoint(t=12.05, x=1.0, y=2.0, heading=0.0),
    slot_open=True,
    spacing_error=1.0,
    cross_track=-2.0,
    time_to_go=500.0,
    joined=False,
    alert="caution",
    margin=120.0,
)
SAMPLE = Sample(
    t=12.05,
    aircraft=(AIRCRAFT, replace(AIRCRAFT, ident="LDR 01")),
    guidance=(GUIDANCE,),
)


SLOT = to_wire(GUIDANCE.slot)


def test_a_sample_in_full() -> None:
    aircraft = {
        "ident": "RG 06",
        "x_m": -40000.0,
        "y_m": 1.0,
        "heading_deg": 90.0,
        "track_deg": 90.0,
        "bank_deg": -45.0,
        "turn_rate_degps": 1.0,
        "tas_mps": 240.0,
        "ground_speed_mps": 239.0,
        "altitude_m": 9000.0,
    }
    assert to_wire(SAMPLE) == {
        "kind": "sample",
        "t_s": 12.05,
        "aircraft": [aircraft, {**aircraft, "ident": "LDR 01"}],
        "guidance": [
            {
                "ident": "RG 06",
                "leader": "LDR 01",
                "mode": "converge",
                "reference": {"kind": "hold_heading", "heading_deg": 180.0},
                "commanded_tas_mps": 240.0,
                "separation_m": 50000.0,
                "closure_mps": 30.0,
                "least_separation_m": 49000.0,
                "slot": {"t_s": 12.05, "x_m": 1.0, "y_m": 2.0, "heading_deg": 0.0},
                "slot_open": True,
                "spacing_error_m": 1.0,
                "cross_track_m": -2.0,
                "time_to_go_s": 500.0,
                "joined": False,
                "alert": "caution",
                "leader_age_s": 0.0,
                "margin_m": 120.0,
                "engagement": "engaged",
            }
        ],
    }
    assert next(iter(to_wire(SAMPLE))) == "kind"


def test_columns_and_times_that_may_be_missing() -> None:
    forecast = ForecastChanged(
        t=5.0,
        ident="RG 06",
        times=(5.0, 10.0),
        x=(0.0, 1.0),
        y=(2.0, 3.0),
        heading=(0.0, -pi),
        least_separation=9e3,
        pursuer_at_closest=PathPoint(t=10.0, x=1.0, y=3.0, heading=0.0),
        leader_at_closest=PathPoint(t=10.0, x=1.0, y=9e3, heading=0.0),
    )
    assert to_wire(forecast) == {
        "kind": "forecast_changed",
        "t_s": 5.0,
        "ident": "RG 06",
        "times_s": [5.0, 10.0],
        "x_m": [0.0, 1.0],
        "y_m": [2.0, 3.0],
        "heading_deg": [0.0, 180.0],
        "least_separation_m": 9e3,
        "pursuer_at_closest": {"t_s": 10.0, "x_m": 1.0, "y_m": 3.0, "heading_deg": 0.0},
        "leader_at_closest": {"t_s": 10.0, "x_m": 1.0, "y_m": 9e3, "heading_deg": 0.0},
        "aside_m": [],
    }
    lost = SeparationLost(
        t=5.0, ident="RG 06", other="LDR 01", separation=9e3, x=0.0, y=1.0, cause="", announced=()
    )
    assert to_wire(lost)["announced_s"] == []
    assert to_wire(replace(lost, announced=(3.0,)))["announced_s"] == [3.0]


@given(document=documents())
@settings(max_examples=150)
def test_every_document_comes_back_equal(document: Any) -> None:
    assert_equal(from_wire(dumps(document)), document)


@given(document=documents())
@settings(max_examples=50)
def test_the_fast_encoder_writes_what_the_models_read(document: Any) -> None:
    frame = tick("f", t=1.0, rate=10.0, paused=False, ended=False, documents=[document])
    assert parse(Tick, frame).model_dump(exclude_unset=True) == json.loads(frame)


def test_a_field_that_recordings_did_not_always_have_may_be_missing() -> None:
    promise = PromiseChanged(t=5.0, ident="OWN", promised=60.0, was=20.0, message="Later.")
    written = to_wire(promise)
    assert written.pop("was_s") == 20.0
    assert from_wire(written) == replace(promise, was=0.0)
    del written["message"]
    with pytest.raises(ContractError, match="message"):
        from_wire(written)


@pytest.mark.parametrize("heading", [-1e-20, -0.0, 2.0 * pi, 4.0 * pi])
def test_north_is_0_and_never_360(heading: float) -> None:
    point = PathPoint(t=0.0, x=0.0, y=0.0, heading=heading)
    assert to_wire(point)["heading_deg"] == 0.0


@given(heading=st.floats(-1e6, 1e6))
def test_headings_lie_below_360(heading: float) -> None:
    assert 0.0 <= to_wire(PathPoint(t=0.0, x=0.0, y=0.0, heading=heading))["heading_deg"] < 360.0


@pytest.mark.parametrize("number", [nan, inf, -inf])
def test_a_number_that_json_has_not_is_refused(number: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        dumps(replace(SAMPLE, guidance=(replace(GUIDANCE, separation=number),)))
    with pytest.raises(ValueError, match="finite"):
        tick("f", t=number, rate=1.0, paused=False, ended=False, documents=[])


def test_a_sample_is_encoded_fast() -> None:
    dumps(SAMPLE)
    best = min(repeat(lambda: dumps(SAMPLE), number=200, repeat=20)) / 200.0
    assert best < 60e-6  # 13 µs on a free core; twice the 25 µs asked for, for a busy one


@pytest.mark.parametrize("name", SITUATIONS)
def test_the_flights_that_the_display_is_tested_with_are_fresh(name: str) -> None:
    written = json.loads((FOLDER / f"{name}.json").read_text("utf-8"))
    for document, expected in zip(written, display_flight(name), strict=True):
        # searches end a little differently on other processors
        assert_equal(from_wire(document), expected, 1e-5)  # if not: python -m tools.display_flights


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=8,
)


@given(content=json_values, document=documents(), data=st.data())
@settings(max_examples=100)
def test_garbage_in_a_document_is_refused_in_a_sentence(
    content: Any, document: Any, data: st.DataObject
) -> None:
    body = to_wire(document)
    body[data.draw(st.sampled_from(sorted(body)))] = content
    try:
        from_wire(body)
    except ContractError as error:
        assert error.problems  # noqa: PT017


@pytest.mark.parametrize(
    ("change", "path", "sentence"),
    [
        ({"kind": "samples"}, "kind", "must be one of"),
        ({"aircraft": {}}, "aircraft", "must be a list"),
        ({"joined": 0}, "guidance[0].joined", "must be true or false, not 0."),
        (
            {"mode": "dive"},
            "guidance[0].mode",
            "must be 'heading', 'converge', 'capture', 'follow' or 'escape'",
        ),
        ({"reference": {"kind": "hold"}}, "guidance[0].reference.kind", "must be one of"),
        ({"slot": {**SLOT, "x_m": "1"}}, "guidance[0].slot.x_m", "must be a number"),
        (
            {"separation_km": 1},
            "guidance[0].separation_km",
            "is not a field of the contract: leave it out.",
        ),
    ],
)
def test_each_defect_is_named(change: dict[str, Any], path: str, sentence: str) -> None:
    body = to_wire(SAMPLE)
    whole = body if path in body else body["guidance"][0]
    whole.update(change)
    with pytest.raises(ContractError) as caught:
        from_wire(body)
    (problem,) = caught.value.problems
    assert problem[0] == path
    assert problem[1].startswith(sentence)


def assert_equal(one: Any, other: Any, tolerance: float = 1e-9) -> None:
    """Equal, numbers to `tolerance` of their size: degrees and back costs the last digit."""
    assert type(one) is type(other)
    if is_dataclass(one):
        for f in fields(one):
            assert_equal(getattr(one, f.name), getattr(other, f.name), tolerance)
    elif isinstance(one, tuple):
        assert len(one) == len(other)
        for a, b in zip(one, other, strict=True):
            assert_equal(a, b, tolerance)
    elif isinstance(one, float):
        assert one == pytest.approx(other, rel=tolerance, abs=tolerance)
    else:
        assert one == other

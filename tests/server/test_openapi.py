"""The OpenAPI document, held to what the service really does by schemathesis."""

import schemathesis
from hypothesis import HealthCheck, settings
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from tests.server.serving import TestClient, ideal_app

app = ideal_app(max_flights=2, spare_after=1e-6, hosts="testserver")
client = TestClient(app)
schema = schemathesis.openapi.from_asgi("/openapi.json", app)
CHECKS = (
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_schema_conformance,
)


@schemathesis.serializer("application/x-ndjson")
def write_lines(context: schemathesis.SerializationContext, value: object) -> bytes:
    return b"\n".join(
        line if isinstance(line, bytes) else str(line).encode()
        for line in (value if isinstance(value, list) else [value])
    )


@schema.parametrize()
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
def test_the_service_does_what_its_document_says(case: schemathesis.Case) -> None:
    case.call_and_validate(checks=CHECKS, timeout=120)


def test_every_reference_leads_somewhere() -> None:
    document = app.openapi()
    known = document["components"]["schemas"]

    def walk(node: object) -> None:
        match node:
            case {"$ref": str() as reference}:
                assert reference.removeprefix("#/components/schemas/") in known
            case dict():
                for child in node.values():
                    walk(child)
            case list():
                for child in node:
                    walk(child)

    walk(document)
    assert {"SituationBody", "Answer", "FlightStatus", "Problem"} <= set(known)

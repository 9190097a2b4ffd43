"""The routes of the records, held to what their document says."""

import tempfile
from collections.abc import Iterator

import pytest
import schemathesis
from hypothesis import HealthCheck, settings
from relguide_server.app import create_app
from relguide_server.records.service import records_service
from relguide_server.settings import ServiceSettings

from tests.server.http.test_openapi import CHECKS
from tests.server.records.test_writer import wait_for
from tests.server.serving import ideal_catalogue

FOLDER = tempfile.TemporaryDirectory(prefix="relguide-records-")
records = records_service(
    records="on", database_url="", data=FOLDER.name, record_plans=5, keep_days=1.0, keep_mb=10.0
)
app = create_app(ServiceSettings(workers=0, hosts="testserver"), catalogue=ideal_catalogue())
# each case starts and stops the service: the records are to stay open
app.state.records = records
schema = schemathesis.openapi.from_asgi("/openapi.json", app)


@pytest.fixture(scope="module")
def _open() -> Iterator[None]:
    records.start()
    wait_for(records.opened)
    yield
    records.stop()
    FOLDER.cleanup()


@schema.include(path_regex="/records/").parametrize()
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@pytest.mark.usefixtures("_open")
def test_the_records_do_what_their_document_says(case: schemathesis.Case) -> None:
    case.call_and_validate(checks=CHECKS, timeout=120)

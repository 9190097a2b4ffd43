"""The routes of the records, held to what their document says."""

import tempfile
from collections.abc import Iterator

import pytest
import schemathesis
from hypothesis import HealthCheck, settings
from relguide_server.app import create_app
from relguide_server.records.keeper import keep
from relguide_server.settings import Settings

from tests.server.records.test_writer import wait_for
from tests.server.serving import ideal_departures
from tests.server.test_openapi import CHECKS

FOLDER = tempfile.TemporaryDirectory(prefix="relguide-records-")
keeper = keep(
    records="on", database_url="", data=FOLDER.name, record_plans=5, keep_days=1.0, keep_mb=10.0
)
app = create_app(Settings(workers=0, hosts="testserver"), departures=ideal_departures())
# each case starts and stops the service: the records are to stay open
app.state.keeper = keeper
schema = schemathesis.openapi.from_asgi("/openapi.json", app)


@pytest.fixture(scope="module")
def _open() -> Iterator[None]:
    keeper.start()
    wait_for(keeper.opened)
    yield
    keeper.stop()
    FOLDER.cleanup()


@schema.include(path_regex="/records/").parametrize()
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@pytest.mark.usefixtures("_open")
def test_the_records_do_what_their_document_says(case: schemathesis.Case) -> None:
    case.call_and_validate(checks=CHECKS, timeout=120)

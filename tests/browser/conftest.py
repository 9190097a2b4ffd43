"""One Chromium and one service for all, a page for each."""

import json
from collections.abc import Iterator
from pathlib import Path
from urllib.request import Request, urlopen

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.service import Service, Watch, running_chromium, running_service, watch

PATIENCE = 30_000
"""For whatever a browser with software WebGL does on a busy machine [ms]."""
expect.set_options(timeout=PATIENCE)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.browser)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with running_chromium() as chromium:
        yield chromium


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with running_service(tmp_path_factory.mktemp("service")) as started:
        yield started


@pytest.fixture
def sky(service: Service) -> Iterator[Service]:
    """The service, with no flight left in the air by a test: two cores draw the scene as well."""
    yield service
    with urlopen(f"{service.url}/api/v1/flights") as answer:
        flights = json.load(answer)["flights"]
    for flight in flights:
        urlopen(Request(f"{service.url}/api/v1/flights/{flight['id']}", method="DELETE")).close()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    page.set_default_timeout(PATIENCE)
    yield page
    page.close()


@pytest.fixture
def watched(page: Page) -> Watch:
    return watch(page)

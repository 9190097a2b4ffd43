"""Every database that the records can be kept in."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.server.records.places import HAS_POSTGRES, NO_POSTGRES, Home, Postgres, postgres


@pytest.fixture(scope="session")
def server() -> Iterator[Postgres]:
    with postgres() as running:
        yield running


@pytest.fixture(
    params=[
        "sqlite",
        pytest.param("postgresql", marks=pytest.mark.skipif(not HAS_POSTGRES, reason=NO_POSTGRES)),
    ]
)
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """The address of an empty database."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path}/records.sqlite3"
    server: Postgres = request.getfixturevalue("server")
    return server.empty_database()


@pytest.fixture
def home(url: str) -> Iterator[Home]:
    """An empty database, and what is opened on it."""
    home = Home(url)
    yield home
    home.close()

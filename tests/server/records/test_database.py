"""The tables: made by revisions, brought up to date with all that is in them, and left alone."""

import zlib
from operator import itemgetter
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa
from alembic import command
from alembic.config import Config
from alembic.script import ScriptDirectory
from relguide_server.records import database
from relguide_server.records.entries import RecordSearch, Unavailable
from relguide_server.records.queries import (
    each_chunk,
    find_flights,
    find_plans,
    read_flight,
    remove_flight,
)
from relguide_server.records.schema import HEAD, metadata

from tests.server.records.places import Home


def alembic_to(url: str, revision: str) -> sa.Engine:
    engine = sa.create_engine(database.url_of(url, Path("unused")))
    config = Config()
    config.set_main_option("script_location", str(database.MIGRATIONS))
    with engine.begin() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, revision)
    return engine


def revisions() -> list[str]:
    """Every revision that a database may be found at, the first one first."""
    steps = ScriptDirectory(str(database.MIGRATIONS)).walk_revisions()
    return [step.revision for step in steps][::-1]


def fill(engine: sa.Engine) -> dict[str, list[dict[str, Any]]]:
    """Put rows into every table that is there.

    Returns:
        them, by table.
    """
    tables = sa.MetaData()
    tables.reflect(engine)
    filled = {}
    with engine.begin() as connection:
        for table in tables.sorted_tables:
            if table.name != "alembic_version":
                rows = [{column.name: value(column, k) for column in table.c} for k in range(3)]
                connection.execute(table.insert(), rows)
                filled[table.name] = rows
    return filled


def value(column: sa.Column[Any], number: int) -> object:
    """What a row has in a column: of its own, but for what another table names."""
    for key in column.foreign_keys:
        return value(key.column, number)
    match column.type:
        case sa.LargeBinary():
            return zlib.compress(b"[%d]\n" % number)
        case sa.Boolean():
            return number == 0
        case sa.Integer():
            return number
        case sa.Double() | sa.Float():
            return 1e9 + number
        case sa.Text() | sa.TEXT():
            return f'{{"row":{number}}}'
        case _:
            return f"{column.table.name[:12]}-{number}"


@pytest.mark.parametrize("revision", revisions())
def test_older_tables_keep_all_that_is_in_them(home: Home, revision: str) -> None:
    engine = alembic_to(home.url, revision)
    filled = fill(engine)
    engine.dispose()
    store = home.store()
    with database.reading(store.engine) as connection:
        assert connection.scalar(sa.text("SELECT version_num FROM alembic_version")) == HEAD
        assert set(sa.inspect(connection).get_table_names()) >= set(metadata.tables)
        for name, rows in filled.items():
            columns = [metadata.tables[name].c[column] for column in rows[0]]
            found = connection.execute(sa.select(*columns)).mappings().all()
            key = next(iter(rows[0]))
            assert sorted(map(dict, found), key=itemgetter(key)) == rows


def test_what_the_first_version_kept_is_read(home: Home) -> None:
    engine = alembic_to(home.url, "0001")
    fill(engine)
    engine.dispose()
    store = home.store()
    assert [row["id"] for row in find_flights(store, RecordSearch()).rows] == [
        "flights-2", "flights-1", "flights-0"
    ]  # fmt: skip
    flight = read_flight(store, "flights-1")
    assert flight is not None
    assert flight["request"] == {"row": 1}
    assert [order["command"] for order in flight["commands"]] == [{"row": 1}]
    assert list(each_chunk(store, "flights-1")) == [[b"[1]\n"]]
    assert find_plans(store, RecordSearch()).rows == []
    assert remove_flight(store, "flights-1") == "flights-1"  # its outcome, as it was filled
    assert list(each_chunk(store, "flights-1")) == []


def test_the_tables_are_those_that_the_revisions_make(url: str) -> None:
    from alembic.autogenerate import compare_metadata
    from alembic.migration import MigrationContext

    engine = alembic_to(url, "head")
    with engine.connect() as connection:
        assert compare_metadata(MigrationContext.configure(connection), metadata) == []
    engine.dispose()


def test_tables_of_a_newer_version_are_left_alone(url: str) -> None:
    engine = alembic_to(url, "head")
    with engine.begin() as connection:
        connection.execute(sa.text("UPDATE alembic_version SET version_num = '9999'"))
    engine.dispose()
    home = Home(url)
    with pytest.raises(Unavailable, match="newer version"):
        home.store()
    home.close()


def test_what_a_start_would_do_is_said_and_not_done(url: str) -> None:
    where = database.url_of(url, Path("unused"))
    first = database.outlook(where)
    assert "at the start" in first
    assert database.outlook(where) == first
    for revision, said in (("0001", f"tables of revision 0001, brought up to {HEAD}"),
                           ("head", f"the tables of this version (revision {HEAD})")):  # fmt: skip
        alembic_to(url, revision).dispose()
        assert said in database.outlook(where)
        assert said in database.outlook(where)
    engine = alembic_to(url, "head")
    with engine.begin() as connection:
        connection.execute(sa.text("UPDATE alembic_version SET version_num = '9999'"))
    engine.dispose()
    with pytest.raises(Unavailable, match="newer version"):
        database.outlook(where)

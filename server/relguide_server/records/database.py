"""The database: SQLite or PostgreSQL, its tables up to date, and its errors as sentences."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import sqlalchemy as sa
from sqlalchemy import event
from sqlalchemy.engine import URL, Connection, Engine, make_url
from sqlalchemy.exc import SQLAlchemyError

from relguide_server.records.entries import Unavailable
from relguide_server.records.schema import HEAD

MIGRATIONS = Path(__file__).with_name("migrations")
PATIENCE = 5.0
"""How long a database may take to let us connect or write [s]."""
UPGRADE_LOCK = 7_734_433
"""Number of the advisory lock under which PostgreSQL's tables are brought up to date."""

NEWER = (
    "The tables were made by a newer version of relguide: update this one, or give another "
    "RELGUIDE_DATABASE_URL."
)
_POSTGRESQL = {
    "connect_timeout": int(PATIENCE),
    "options": f"-c statement_timeout={1000 * int(PATIENCE)}",
    "tcp_user_timeout": 1000 * int(PATIENCE),
}


def url_of(text: str, folder: Path) -> URL:
    """The address of the database.

    Args:
        text: as SQLAlchemy writes addresses; empty for a file of its own.
        folder: where that file is.

    Raises:
        Unavailable: if it is neither SQLite's nor PostgreSQL's.
    """
    if not text:
        return URL.create("sqlite", database=str(folder / "records.sqlite3"))
    try:
        url = make_url(text)
    except SQLAlchemyError:
        url = URL.create("unknown")
    if url.drivername in ("postgresql", "postgres"):
        return url.set(drivername="postgresql+psycopg")
    if url.drivername not in ("sqlite", "postgresql+psycopg"):
        raise Unavailable(
            "RELGUIDE_DATABASE_URL must begin with postgresql:// or "
            "sqlite:///, e.g. postgresql://relguide:secret@localhost/relguide."
        )
    return url


def connect(url: URL) -> Engine:
    """The way to a database, whose tables are made or brought up to date.

    Raises:
        Unavailable: if it cannot be reached, or was made by a newer version.
    """
    with sentences(url):
        if url.drivername != "sqlite":
            engine = sa.create_engine(url, pool_pre_ping=True, connect_args=_POSTGRESQL)
        else:
            Path(url.database or "").parent.mkdir(parents=True, exist_ok=True)
            engine = sa.create_engine(url, connect_args={"timeout": PATIENCE})
            event.listen(engine, "connect", _prepare_sqlite)
            event.listen(engine, "begin", _begin_sqlite)
        try:
            _bring_up_to_date(engine)
        except BaseException:
            engine.dispose()
            raise
        return engine


def outlook(url: URL) -> str:
    """What `connect` would do to a database, in a sentence; nothing is changed.

    Raises:
        Unavailable: if it cannot be reached, or was made by a newer version.
    """
    where = url.render_as_string(hide_password=True)
    with sentences(url):
        if url.drivername != "sqlite":
            engine = sa.create_engine(url, connect_args=_POSTGRESQL)
        elif (file := Path(url.database or "")).exists():
            readable = f"{file.resolve().as_uri()}?mode=ro"
            engine = sa.create_engine(
                "sqlite://", creator=lambda: sqlite3.connect(readable, uri=True)
            )
        else:
            return f"{where} does not exist: it is made at the start."
        try:
            revision = _revision(engine)
        finally:
            engine.dispose()
    if not revision:
        return f"{where} has no tables: they are made at the start."
    if revision > HEAD:
        raise Unavailable(NEWER)
    if revision < HEAD:
        return f"{where} has tables of revision {revision}, brought up to {HEAD} at the start."
    return f"{where} has the tables of this version (revision {HEAD})."


@contextmanager
def reading(engine: Engine) -> Iterator[Connection]:
    """A connection to read by, which no writer waits for.

    Raises:
        Unavailable: if the database cannot be read.
    """
    with sentences(engine.url), engine.connect() as plain:
        yield plain.execution_options(relguide_reads=True)


@contextmanager
def sentences(url: URL) -> Iterator[None]:
    """Whatever goes wrong with a database within, as one sentence.

    Raises:
        Unavailable: with it.
    """
    where = url.render_as_string(hide_password=True)
    try:
        yield
    except ModuleNotFoundError as error:
        raise Unavailable(
            f"{where} needs the package {error.name}, which is not installed: "
            "pip install 'relguide[postgres]' brings it."
        ) from None
    except SQLAlchemyError as error:
        said = str(getattr(error, "orig", None) or error).strip()
        first = said.splitlines()[0] if said else type(error).__name__
        raise Unavailable(f"{where}: {first}.") from None
    except sqlite3.Error as error:
        raise Unavailable(f"{where}: {error}.") from None
    except Unavailable:
        raise
    except OSError as error:
        raise Unavailable(f"{where}: {error.strerror or error}.") from None


def _prepare_sqlite(connection: sqlite3.Connection, record: object) -> None:
    del record
    connection.isolation_level = None  # transactions begin where `_begin_sqlite` says
    for pragma in (
        "auto_vacuum=INCREMENTAL",  # holds for a new file only
        "journal_mode=WAL",
        "synchronous=FULL",  # what was acknowledged survives a power cut as well
        "foreign_keys=ON",
    ):
        connection.execute(f"PRAGMA {pragma}")


def _begin_sqlite(connection: Connection) -> None:
    # who will write takes the lock at once: two that read first would wait for each other
    reads = connection.get_execution_options().get("relguide_reads", False)
    connection.exec_driver_sql("BEGIN" if reads else "BEGIN IMMEDIATE")


def _bring_up_to_date(engine: Engine) -> None:
    if _revision(engine) == HEAD:
        return
    # alembic takes a fifth of a second to import, which a start with good tables need not wait for
    from alembic import command
    from alembic.config import Config
    from alembic.util import CommandError

    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS).replace("%", "%%"))
    with engine.begin() as connection:
        if engine.dialect.name == "postgresql":
            connection.execute(sa.select(sa.func.pg_advisory_xact_lock(UPGRADE_LOCK)))
        config.attributes["connection"] = connection
        try:
            command.upgrade(config, "head")
        except CommandError:
            raise Unavailable(NEWER) from None


def _revision(engine: Engine) -> str:
    with engine.connect() as plain:
        connection = plain.execution_options(relguide_reads=True)
        if not sa.inspect(connection).has_table("alembic_version"):
            return ""
        return str(connection.execute(sa.text("SELECT version_num FROM alembic_version")).scalar())

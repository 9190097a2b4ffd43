"""Databases for the tests: a file of SQLite, and a server of PostgreSQL's own where installed."""

import os
import pwd
import shutil
import signal
import socket
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import psycopg
from psycopg import sql
from relguide_server.records.clock import Clock
from relguide_server.records.database import url_of
from relguide_server.records.store import Store
from relguide_server.records.writer import RetentionLimits, Writer

PROGRAMS = sorted(Path("/usr/lib/postgresql").glob("*/bin"))[-1:]
"""Where Debian's package puts PostgreSQL's programs."""
HAS_POSTGRES = bool(PROGRAMS) or bool(shutil.which("initdb"))
NO_POSTGRES = "needs PostgreSQL's initdb and postgres: apt-get install postgresql"


def program(name: str) -> str:
    return str(PROGRAMS[0] / name) if PROGRAMS else str(shutil.which(name))


def as_whom() -> dict[str, object]:
    """PostgreSQL refuses to run as root: then it runs as somebody else."""
    if os.geteuid() != 0:
        return {}
    user = pwd.getpwnam("postgres" if _has_user("postgres") else "nobody")
    return {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []}


def _has_user(name: str) -> bool:
    return any(entry.pw_name == name for entry in pwd.getpwall())


class Postgres:
    """A server of our own in an empty folder, that can be stopped and started."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.data = folder, folder / "data"
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.port = probe.getsockname()[1]
        self._server: subprocess.Popen[bytes] | None = None
        who = as_whom()
        if who:
            os.chown(folder, int(str(who["user"])), int(str(who["group"])))
        subprocess.run(
            [program("initdb"), "-D", self.data, "-U", "relguide", "-A", "trust", "--no-sync"],
            check=True, capture_output=True, cwd=folder, **who,
        )  # fmt: skip

    def start(self) -> None:
        options = ["-p", str(self.port), "-k", "", "-h", "127.0.0.1", "-F"]
        self._server = subprocess.Popen(
            [program("postgres"), "-D", self.data, *options],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.folder, **as_whom(),
        )  # fmt: skip
        ready = [program("pg_isready"), "-h", "127.0.0.1", "-p", str(self.port), "-t", "1"]
        while subprocess.run(ready, capture_output=True, check=False).returncode:
            assert self._server.poll() is None, "PostgreSQL did not start."

    def stop(self, *, for_good: bool = False) -> None:
        """End it; for good, without writing to disk what the end of its folder would remove."""
        if self._server is not None:
            # PostgreSQL's immediate shutdown, or its fast one
            self._server.send_signal(signal.SIGQUIT if for_good else signal.SIGINT)
            self._server.wait(20.0)
            self._server = None

    def ask_for_password(self, password: str) -> None:
        """Let nobody in from now on but by this password."""
        address = f"postgresql://relguide@127.0.0.1:{self.port}/postgres"
        with psycopg.connect(address, autocommit=True) as connection:
            word = sql.Literal(password)
            connection.execute(sql.SQL("ALTER ROLE relguide PASSWORD {}").format(word))
            rules = self.data / "pg_hba.conf"
            rules.write_text("host all all 127.0.0.1/32 scram-sha-256\n")
            connection.execute("SELECT pg_reload_conf()")

    def empty_database(self) -> str:
        """The address of its database, in which nothing is left of what was before.

        To make one for each test would take ten times as long, and to remove them all as well.
        """
        address = f"postgresql://relguide@127.0.0.1:{self.port}/postgres"
        with psycopg.connect(address, autocommit=True) as connection:
            connection.execute(
                "SELECT pg_terminate_backend(pid) FROM pg_stat_activity "
                "WHERE datname = current_database() AND pid <> pg_backend_pid()"
            )
            connection.execute("DROP SCHEMA public CASCADE")
            connection.execute("CREATE SCHEMA public")
        return address


@contextmanager
def postgres() -> Iterator[Postgres]:
    with tempfile.TemporaryDirectory(prefix="relguide-postgres-") as folder:
        os.chmod(folder, 0o755)
        server = Postgres(Path(folder))
        server.start()
        try:
            yield server
        finally:
            server.stop(for_good=True)


class Home:
    """A database, and all that is opened on it in a test."""

    def __init__(self, url: str) -> None:
        self.url = url
        self._open: list[Store | Writer] = []

    def store(self, *, run: str = "reader") -> Store:
        store = Store(url_of(self.url, Path("unused")), run=run, version="1.0", started_at=1e9)
        self._open.append(store)
        return store

    def writer(
        self,
        *,
        run: str = "this run",
        clock: Clock | None = None,
        limits: RetentionLimits | None = None,
        opening: Callable[[], Store] | None = None,
    ) -> Writer:
        writer = Writer(
            opening or (lambda: self.store(run=run)),
            run=run,
            version="1.0",
            limits=limits or RetentionLimits(age=1e12, size=1e12),
            clock=clock or Clock(),
        )
        writer.start()
        self._open.append(writer)
        return writer

    def close(self) -> None:
        for opened in self._open:
            if isinstance(opened, Writer):
                opened.stop()
        for opened in self._open:
            if isinstance(opened, Store):
                opened.close()

"""`compose.yaml` without an engine: its services, each on a host of its own, with its settings.

PostgreSQL and nginx are Debian's; the services are the image's.
"""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from shlex import quote
from typing import Any

import yaml

from tools.container.debian import confined, inside
from tools.container.dockerfile import ROOT
from tools.container.image import Stage

PASSWORD = "p@ss/w: #%40'$"
NUMBERS = {
    "database": (2,), "flights-a": (3,), "planner": (4, 5), "proxy": (6,), "flights-b": (7,)
}  # fmt: skip
"""The addresses of each service: as many as it has replicas."""
PATIENCE = 120.0
"""How long a service has to become healthy [s]."""


def composition() -> dict[str, Any]:
    """The file, its variables as a user sets them who sets but the password."""

    given = {"RELGUIDE_PASSWORD": PASSWORD}

    def value(found: re.Match[str]) -> str:
        name, default = found.groups()
        return given.get(name, default or "") if name else "$"

    def filled(read: Any) -> Any:
        match read:
            case str():
                return re.sub(r"\$\$|\$\{(\w+)(?::-([^}]*)|:\?[^}]*)?\}", value, read)
            case dict():
                return {name: filled(part) for name, part in read.items()}
            case list():
                return [filled(part) for part in read]
        return read

    read: dict[str, Any] = filled(yaml.safe_load((ROOT / "compose.yaml").read_text()))
    for service in read["services"].values():
        given = service.get("environment", {})
        service["environment"] = {name: value or "" for name, value in given.items()}
    return read


@dataclass(slots=True)
class Container:
    """One that runs."""

    on: list[str]
    """What stands before a command on its host."""
    root: Path
    environment: dict[str, str]
    process: "subprocess.Popen[bytes]"

    def run(self, command: Sequence[str]) -> "subprocess.CompletedProcess[str]":
        """A command in it, as `docker exec`."""
        within = [*self.on, "nsenter", "--target", str(self.pid), "--mount", "--pid",
                  "chroot", str(self.root), *command]  # fmt: skip
        return subprocess.run(
            within, env=inside(self.environment), capture_output=True, text=True, check=False
        )

    @property
    def pid(self) -> int:
        """Of its process 1, as the machine counts."""
        starter = self.process.pid
        children = Path(f"/proc/{starter}/task/{starter}/children").read_text().split()
        return int(children[0])

    def wait_until_healthy(self, check: Sequence[str]) -> None:
        """Ask its check until it is."""
        end = time.monotonic() + PATIENCE
        while True:
            time.sleep(0.3)
            if self.process.poll() is not None:
                raise RuntimeError(f"{self.on[-1]} has ended.")
            said = self.run(check)
            if said.returncode == 0:
                return
            if time.monotonic() > end:
                raise TimeoutError(f"{self.on[-1]} is not healthy: {said.stdout}{said.stderr}")

    def kill(self) -> None:
        """End it, and all in it."""
        if self.process.poll() is None:
            os.kill(self.pid, signal.SIGKILL)  # who changed its user does not end with its starter
            self.process.wait(30.0)

    def stop(self, sent: signal.Signals) -> float:
        """Send its process 1 a signal.

        Returns:
            how long it takes to end [s].
        """
        began = time.monotonic()
        os.kill(self.pid, sent)
        self.process.wait(30.0)
        return time.monotonic() - began


@contextmanager
def container(
    stage: Stage,
    on: list[str],
    *,
    given: dict[str, str],
    writable: dict[str, Path],
    log: Path,
) -> Iterator[Container]:
    """One of the image, as the Dockerfile says: its user, its command, its folder."""
    user = int(stage.said["USER"])
    command = [*stage.list_of("ENTRYPOINT"), *stage.list_of("CMD")]
    environment = {**stage.environment, "HOME": stage.folder, **given}
    wrapped = confined(stage.root, command, user=user, writable=writable, folder=stage.folder)
    with (
        log.open("wb") as written,
        subprocess.Popen(
            [*on, *wrapped], env=inside(environment), stdout=written, stderr=written
        ) as process,
    ):
        made = Container(on, stage.root, environment, process)
        try:
            yield made
        finally:
            made.kill()


@contextmanager
def database(root: Path, on: list[str], said: dict[str, Any]) -> Iterator[Container]:
    """PostgreSQL, as the entry point of its image sets it up."""
    environment = said["environment"]
    user, password = environment["POSTGRES_USER"], environment["POSTGRES_PASSWORD"]
    setup = (
        "export PATH=$(ls -d /usr/lib/postgresql/*/bin):$PATH\n"
        "install -d -o postgres /var/lib/relguide && cd /var/lib/relguide\n"
        f"printf %s {quote(password)} > word && chown postgres word\n"
        f"setpriv --reuid postgres --init-groups initdb -D data -U {user} --pwfile word "
        "-A scram-sha-256 >/dev/null\n"
        "echo 'host all all all scram-sha-256' >> data/pg_hba.conf\n"
        "exec setpriv --reuid postgres --init-groups postgres -D data -h '*' -k /tmp\n"
    )
    command = ["chroot", str(root), "/bin/sh", "-euc", setup]
    isolated = ["unshare", "--mount", "--pid", "--fork", "--kill-child"]
    proc, quiet = f"--mount-proc={root}/proc", subprocess.DEVNULL
    whole = [*on, *isolated, proc, *command]
    with subprocess.Popen(whole, env=inside({}), stdout=quiet, stderr=quiet) as process:
        made = Container(on, root, {}, process)
        try:
            made.wait_until_healthy([*said["healthcheck"]["test"][1:], "--host", "127.0.0.1"])
            shell = f"PGPASSWORD={quote(password)} createdb -h 127.0.0.1 -U {user} {user}"
            made_database = made.run(["/bin/sh", "-c", shell])
            assert made_database.returncode == 0, made_database.stderr
            yield made
        finally:
            made.kill()


@contextmanager
def proxy(root: Path, on: list[str], config: str, names: Path) -> Iterator[None]:
    """nginx, with a configuration at the place that the composition names."""
    (root / "etc/nginx/sites-enabled/default").unlink(missing_ok=True)
    (root / "etc/nginx/conf.d/default.conf").write_text(config)
    (root / "etc/hosts").write_text(names.read_text())
    command = ["chroot", str(root), "nginx", "-g", "daemon off;"]
    resolve = [sys.executable, "-m", "tools.container.names", str(names), "127.0.0.11", "53"]
    with (
        subprocess.Popen([*on, *resolve], cwd=ROOT) as resolver,
        subprocess.Popen([*on, *command], env=inside({})) as process,
    ):
        try:
            yield
        finally:
            process.terminate()
            resolver.terminate()

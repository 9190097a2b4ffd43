"""A Debian in a folder: what stands in for the images that a registry would give."""

import os
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

SUITE = "trixie"
"""What `python:3.12-slim` is made of."""
MIRROR = "http://deb.debian.org/debian"
PACKAGES = ("python3-venv", "python-is-python3")
"""What the base must have: a `python` that makes environments."""
PASSED_ON = (
    "HTTP_PROXY", "HTTPS_PROXY", "NO_PROXY", "http_proxy", "https_proxy", "no_proxy",
    "PIP_CERT", "PIP_INDEX_URL", "SSL_CERT_FILE", "NODE_EXTRA_CA_CERTS",
)  # fmt: skip
"""Variables of the network that a build is given, as an engine's build arguments give them."""
CERTIFICATES = Path("/etc/ssl/certs/ca-certificates.crt")


def install_base(folder: Path) -> None:
    """Lay Debian out in a folder, with Python."""
    subprocess.run(
        ["debootstrap", "--variant=minbase", "--include=ca-certificates", SUITE, folder, MIRROR],
        check=True, stdout=subprocess.DEVNULL,
    )  # fmt: skip
    for name in ("resolv.conf", "hosts"):
        shutil.copy(f"/etc/{name}", folder / "etc" / name)
    if CERTIFICATES.is_file():  # those of a proxy between may be among them
        shutil.copy(CERTIFICATES, folder / CERTIFICATES.relative_to("/"))
    run_in(folder, f"apt-get install -y -q --no-install-recommends {' '.join(PACKAGES)}")


def layer(base: Path, folder: Path) -> Path:
    """A root of its own over another, which stays as it is.

    Returns:
        where it is mounted; `lift` takes it away.
    """
    changed, work, root = (folder / name for name in ("changed", "work", "root"))
    for place in (changed, work, root):
        place.mkdir(parents=True, exist_ok=True)
    options = f"lowerdir={base},upperdir={changed},workdir={work}"
    subprocess.run(["mount", "-t", "overlay", "overlay", "-o", options, root], check=True)
    return root


def lift(root: Path) -> None:
    """Unmount a layer."""
    subprocess.run(["umount", "--lazy", root], check=True)


def run_in(
    root: Path, command: str, *, environment: dict[str, str] | None = None, folder: str = "/"
) -> None:
    """Run a command of a shell in a root, as its only process and as root.

    Raises:
        subprocess.CalledProcessError: if it fails.
    """
    within = ["chroot", str(root), "/bin/sh", "-euc", 'cd "$0"; eval "$1"', folder, command]
    subprocess.run(
        ["unshare", "--mount", "--pid", "--fork", "--kill-child", f"--mount-proc={root}/proc",
         *within],
        check=True, env=inside(environment or {}),
    )  # fmt: skip


def inside(environment: dict[str, str]) -> dict[str, str]:
    """The environment of a process in a root."""
    plain = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"}
    passed = {name: os.environ[name] for name in PASSED_ON if name in os.environ}
    return {
        **plain,
        "HOME": "/root",
        "LC_ALL": "C.UTF-8",
        "DEBIAN_FRONTEND": "noninteractive",
        **passed,
        **environment,
    }


def confined(
    root: Path,
    command: Sequence[str],
    *,
    user: int,
    writable: dict[str, Path],
    folder: str,
) -> list[str]:
    """The command that starts a container: a read-only root, one user, no capabilities.

    Args:
        root: where its files are.
        command: what it runs, as process 1.
        user: id of user and group.
        writable: what is mounted over its folders; of `/tmp` nothing outlives it.
        folder: where it begins.
    """
    binds = "".join(f'mount --bind "{place}" "{root}{name}"\n' for name, place in writable.items())
    shell = (
        f'mount --bind "{root}" "{root}"\n'
        f'mount -t proc proc "{root}/proc"\n'
        f'mount -o remount,bind,ro "{root}"\n{binds}'
        f'mount -t tmpfs tmpfs "{root}/tmp"\nmount -t tmpfs tmpfs "{root}/dev/shm"\n'
        'exec chroot "$0" setpriv --reuid "$1" --regid "$1" --clear-groups --no-new-privs '
        '--bounding-set=-all --inh-caps=-all -- /bin/sh -c \'cd "$0"; exec "$@"\' "$2" "${@:3}"'
    )
    return ["unshare", "--mount", "--pid", "--fork", "--kill-child",
            "bash", "-euc", shell, str(root), str(user), folder, *command]  # fmt: skip

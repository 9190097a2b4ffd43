"""A network of our own: a bridge in a namespace, and hosts on it with addresses and names."""

import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

NETWORK = "172.28.0"
"""As an engine gives one: private, so that `RELGUIDE_PROXIES` of the composition believes it."""
BRIDGE = "relguide0"


def alone(module: str, *arguments: str) -> int:
    """Run a module of ours in a network of its own, in which nothing else is reached."""
    command = ["unshare", "--net", "--mount", sys.executable, "-m", module, *arguments]
    return subprocess.run(command, check=False).returncode


def _ip(*words: str) -> None:
    subprocess.run(["ip", *words], check=True)


def lay_bridge() -> None:
    """Begin the network, with this process on it at `.1`."""
    names = Path("/run/netns")  # those of this network alone
    names.mkdir(exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "tmpfs", names], check=True)
    _ip("link", "set", "lo", "up")
    _ip("link", "add", "name", BRIDGE, "type", "bridge")
    _ip("addr", "add", f"{NETWORK}.1/24", "dev", BRIDGE)
    _ip("link", "set", BRIDGE, "up")


def add_host(name: str, number: int) -> list[str]:
    """A host on the bridge.

    Returns:
        what stands before a command that is to run on it.
    """
    here = f"to-{name}"[:15]
    _ip("netns", "add", name)
    _ip("link", "add", "name", here, "type", "veth", "peer", "name", "eth0", "netns", name)
    _ip("link", "set", here, "master", BRIDGE, "up")
    _ip("-n", name, "addr", "add", f"{NETWORK}.{number}/24", "dev", "eth0")
    _ip("-n", name, "link", "set", "lo", "up")
    _ip("-n", name, "link", "set", "eth0", "up")
    return ["ip", "netns", "exec", name]


def write_names(file: Path, numbers: Mapping[str, tuple[int, ...]]) -> None:
    """What an engine's name server would say: a name may have several addresses."""
    lines = [f"{NETWORK}.{number} {name}\n" for name, given in numbers.items() for number in given]
    file.write_text("127.0.0.1 localhost\n" + "".join(lines))

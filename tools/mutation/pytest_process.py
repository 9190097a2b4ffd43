"""pytest in a process forked from one that has its libraries loaded: loading them takes longest."""

import os
import resource
import signal
import sys
from collections.abc import Mapping, Sequence
from multiprocessing import get_context
from pathlib import Path
from typing import Any

MEMORY = 8 << 30
"""What a run of tests may claim for data [bytes]: a fault may ask for everything."""
OPTIONS = ["-x", "-q", "-rfE", "--tb=no", "-p", "no:cacheprovider"]
OPTIONS += ["-p", "_hypothesis_pytestplugin", "-p", "tools.mutation.hasty"]
OPTIONS += ["--hypothesis-profile=hasty"]
ENVIRONMENT = {
    "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
    "PYTHONDONTWRITEBYTECODE": "1",  # else an old .pyc could hide a fault of equal length
}
OURS = ("benchmarks", "relguide", "relguide_server", "tests", "tools")
"""Packages of the repository."""
PRELOADED = ["hypothesis.strategies", "numba", "pytest"]
CONTEXT = get_context("forkserver")
CONTEXT.set_forkserver_preload(PRELOADED)


def run_pytest(
    tree: Path, tests: Sequence[Path], environment: Mapping[str, str], log: Path, limit: float
) -> int | None:
    """Run test modules of a copy of the repository, over the copy.

    Args:
        tree: the copy.
        tests: the modules, from its root.
        environment: variables to set besides.
        log: takes what pytest prints.
        limit: when to stop it [s].

    Returns:
        pytest's exit code, or minus the signal that ended it; None if it had to be stopped.
    """
    paths = [str(tree), str(tree / "server")]
    variables = {**environment, **ENVIRONMENT, "PYTHONPATH": os.pathsep.join(paths)}
    arguments = (str(tree), [*OPTIONS, *map(str, tests)], paths, variables, str(log))
    running = CONTEXT.Process(target=_child, args=arguments)
    running.start()
    assert running.pid is not None
    try:
        running.join(limit)
        return running.exitcode
    finally:  # and whatever the tests have started
        for end in (os.killpg, os.kill):
            try:
                end(running.pid, signal.SIGKILL)
            except ProcessLookupError:
                continue  # it has ended, or has no group of its own yet
        running.join()
        running.close()


def _child(
    tree: str, arguments: list[str], paths: list[str], variables: dict[str, str], log: str
) -> None:
    os.setsid()
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    out = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    os.dup2(out, 1)
    os.dup2(out, 2)
    os.chdir(tree)
    os.environ.update(variables)
    sys.dont_write_bytecode = True
    sys.path[:0] = paths
    for name in list(sys.modules):  # the repository's own, loaded to find this function
        if name.partition(".")[0] in OURS:
            del sys.modules[name]
    config: Any = __import__("numba").core.config
    config.reload_config()
    import pytest

    os._exit(int(pytest.main(arguments)))

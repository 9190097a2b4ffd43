"""Strictness for every test: float errors raise, examples and seeds are the same each run.

Warnings are errors by `pyproject.toml`. Fresh examples: `pytest --hypothesis-profile=explore`;
few: `quick`, as in `make check`.
"""

import random
import signal
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from relguide.kernels.compiling import first_use

APART = ("browser",)

# The first call of a kernel compiles it, so no example has a deadline.
settings.register_profile(
    "same", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("explore", settings.get_profile("same"), derandomize=False)
settings.register_profile("quick", settings.get_profile("same"), max_examples=10)
settings.load_profile("same")

# Who runs tests in the background may have Ctrl-C ignored, which programs would inherit.
signal.signal(signal.SIGINT, signal.default_int_handler)

# What is compiled on the way is not what a test asks about.
first_use.announced = True


@pytest.fixture(autouse=True)
def _floats_raise() -> Iterator[None]:
    # underflow to zero is what we want of a tiny number
    with np.errstate(all="raise", under="ignore"):
        yield


@pytest.fixture(autouse=True)
def _seeds() -> None:
    random.seed(0)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """`tests/browser` runs only when named, as by `make test`."""
    apart = collection_path.parent == Path(__file__).parent and collection_path.name in APART
    return True if apart and not any(collection_path.name in arg for arg in config.args) else None

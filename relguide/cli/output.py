"""What commands print, and what the files they make tell of their origin."""

import sys
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

import numpy as np
import orjson

from relguide import __version__

PROGRAM = f"relguide {__version__}"
"""What has made a file."""


def write(text: str) -> None:
    """Write to standard output, and at once: whoever reads it may wait for a line."""
    sys.stdout.write(text)
    sys.stdout.flush()


def write_json(content: Mapping[str, Any]) -> None:
    """Write an object, indented, to standard output."""
    write(orjson.dumps(content, option=orjson.OPT_INDENT_2).decode() + "\n")


def say(sentence: str) -> None:
    """Tell people something beside the result: on standard error."""
    sys.stderr.write(f"relguide: {sentence}\n")
    sys.stderr.flush()


def provenance(method: str, **more: str) -> dict[str, str]:
    """Who makes a data set, how and when.

    Args:
        method: of `relguide dataset`.
        more: what else it shall tell, such as the command.
    """
    return {
        "program": PROGRAM,
        "method": method,
        **more,
        "made": datetime.now(UTC).isoformat(timespec="seconds"),
        "numpy": np.__version__,
    }

"""Write the browser's types from the contract: `python -m tools.emit_types`."""

import argparse
import sys
from pathlib import Path

from relguide.contract.protocol import PROTOCOL, typescript_body

WIRE_TS = Path(__file__).parents[1] / "web" / "src" / "wire.ts"
COMMAND = "python -m tools.emit_types"


def wire_ts() -> str:
    """The whole file."""
    return (
        f"// Made by `{COMMAND}` from relguide/contract: do not edit.\n\n"
        "/** Sub-protocol of the stream: a server of another version refuses it. */\n"
        f'export const PROTOCOL = "{PROTOCOL}";\n\n'
        f"{typescript_body(docs=True)}"
    )


def main(arguments: list[str] | None = None) -> int:
    """Write the file, or check it.

    Returns:
        0, or 1 if the file is stale.
    """
    parser = argparse.ArgumentParser(prog=COMMAND, description=__doc__)
    parser.add_argument("--check", action="store_true", help="only check whether the file is fresh")
    parser.add_argument("--file", type=Path, default=WIRE_TS, help="default: %(default)s")
    chosen = parser.parse_args(arguments)
    fresh = wire_ts()
    written = chosen.file.read_text("utf-8") if chosen.file.exists() else ""
    if written == fresh:
        return 0
    if chosen.check:
        sys.stderr.write(f"{chosen.file} does not match the contract. Run: {COMMAND}\n")
        return 1
    chosen.file.parent.mkdir(parents=True, exist_ok=True)
    chosen.file.write_text(fresh, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""A pursuer amid traffic in BlueSky, whose Modified Voltage Potential keeps it clear of others.

    python benchmarks/mvp.py < questions > answers

A script of its own, as BlueSky needs another version of numpy: `amid_others.py` runs it with
BlueSky's Python. The first line on standard input lists the aircraft. Each second it prints where
the pursuer is, and reads the heading that it flies unless it resolves a conflict. An empty line
ends a flight. Flat earth: degrees of latitude and longitude at the equator.
"""

import json
import sys
from pathlib import Path
from typing import Any

METRES_A_DEGREE = 6371000.0 * 3.141592653589793 / 180.0
LEVEL = "FL310"
STEP = 0.5
"""Of the simulation [s]."""


def main() -> None:
    """Fly what is asked, one flight after the other."""
    import bluesky as bs
    from bluesky.core import simtime

    files = Path(sys.prefix, "bluesky-files")
    files.mkdir(exist_ok=True)
    bs.init(mode="sim", detached=True, workdir=files)
    for line in iter(sys.stdin.readline, ""):
        obey(bs, "RESET")
        simtime.setdt(STEP)
        fly(bs, json.loads(line))


def fly(bs: Any, asked: dict[str, Any]) -> None:
    """One flight."""
    obey(
        bs,
        "CDMETHOD STATEBASED",
        "RESO MVP",
        f"ZONER {asked['minimum_nm']}",
        *(create(one) for one in asked["aircraft"]),
        *(f"BANK {one['ident']} {asked['bank_deg']}" for one in asked["aircraft"][:1]),
    )
    others = [one["ident"] for one in asked["aircraft"][1:]]
    obey(bs, f"RESOOFF {' '.join(others)}", f"NORESO {others[0]}")
    bs.sim.op()
    tas = asked["aircraft"][0]["tas_mps"]
    while True:
        own = bs.traf.id.index(asked["aircraft"][0]["ident"])
        here = {
            "t_s": bs.sim.simt,
            "x_m": bs.traf.lon[own] * METRES_A_DEGREE,
            "y_m": bs.traf.lat[own] * METRES_A_DEGREE,
            "heading_deg": float(bs.traf.hdg[own]),
        }
        sys.stdout.write(f"{json.dumps(here)}\n")
        sys.stdout.flush()
        answer = sys.stdin.readline().strip()
        if not answer:
            return
        bs.traf.ap.trk[own] = float(answer)
        bs.traf.ap.tas[own] = tas
        until = bs.sim.simt + 1.0
        while bs.sim.simt < until - 1e-6:
            bs.sim.step()


def create(one: dict[str, Any]) -> str:
    """The command that makes an aircraft."""
    lat, lon = one["y_m"] / METRES_A_DEGREE, one["x_m"] / METRES_A_DEGREE
    return f"CRE {one['ident']} A320 {lat} {lon} {one['heading_deg']} {LEVEL} {one['cas_kt']}"


def obey(bs: Any, *commands: str) -> None:
    """Give commands, and wait until they are obeyed."""
    for command in commands:
        bs.stack.stack(command)
    bs.sim.step()


if __name__ == "__main__":
    main()

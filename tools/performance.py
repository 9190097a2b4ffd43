"""`python -m tools.performance A306`: its tables of thrust and its drag, as a type file holds them.

Airliners' are openap's (LGPL-3.0, read here, never shipped): its thrust model with the engine that
openap lists, and its polar of the A330-200 with the induced drag of the type's own aspect ratio.
The ATR's are an estimate from the power of its engines.

    python -m tools.performance A306            print them
    python -m tools.performance A306 --write    put them into relguide/flying/types/a306.toml
"""

import re
import sys
import warnings
from pathlib import Path

import numpy as np

from relguide.flying.air import STANDARD_AIR
from relguide.units import FT

TYPES = Path(__file__).parents[1] / "relguide/flying/types"
ENGINES = {"A306": "CF6-80C2A5", "A310": "CF6-80C2A2"}
"""As openap names them: of the A300 B4-605R and of the A310-304."""
SPANS_AND_AREAS = {"A306": (44.84, 260.0), "A310": (43.9, 219.0)}
"""[m], [m²]."""
LEVELS_FT = (0, 5_000, 10_000, 15_000, 20_000, 25_000, 30_000, 31_000, 35_000, 40_000, 45_000)
"""Every 5,000 ft, and one just above FL300, where openap's thrust has a step."""
MACHS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
ATR_LEVELS_FT = range(0, 30_000, 5_000)
ATR_MACHS = (0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5, 0.6)
CLIMB_POWER = 2.0 * 1_635e3
"""Of two PW127M, 2,192 shp each [W]."""
PROPELLER_EFFICIENCY = 0.85
LAPSE = 0.6
"""Exponent of the density ratio by which their power falls."""
FLIGHT_IDLE = -0.1
"""Thrust of propellers at flight idle, over that of a climb."""
Table = dict[str, float | list[float] | list[list[float]]]


def table(designator: str) -> Table:
    """What the command gives for a type, by the keys of its file."""
    return _atr() if designator == "AT76" else _airliner(designator)


def _airliner(designator: str) -> Table:
    from openap import Thrust, aero, prop
    from openap.drag import Drag

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        thrust, polar = Thrust("A332", ENGINES[designator], force_engine=True), Drag("A332").polar
    wing = prop.aircraft("A332")["wing"]
    span, area = SPANS_AND_AREAS[designator]
    slenderness = (wing["span"] ** 2 / wing["area"]) / (span**2 / area)
    climb, idle = [], []
    for level in LEVELS_FT:
        tas_kt = aero.mach2tas(np.array(MACHS), level * FT) / aero.kts
        feet = np.full(len(MACHS), float(level))
        climb.append(_kilonewtons(thrust.climb(tas_kt, feet, 0.0 * feet)))
        idle.append(_kilonewtons(thrust.descent_idle(tas_kt, feet)))
    return {
        "zero_lift_drag": float(polar["clean"]["cd0"]),
        "induced_drag": round(float(polar["clean"]["k"]) * slenderness, 4),
        "thrust_levels_ft": [float(level) for level in LEVELS_FT],
        "thrust_machs": list(MACHS),
        "climb_thrust_kn": climb,
        "idle_thrust_kn": idle,
    }


def _atr() -> Table:
    """η P (ρ/ρ₀)^0.6 / V."""
    climb = []
    for level in ATR_LEVELS_FT:
        lapse = (STANDARD_AIR.density(level * FT) / STANDARD_AIR.density(0.0)) ** LAPSE
        tas = np.array(ATR_MACHS) * STANDARD_AIR.sound_speed(level * FT)
        climb.append(PROPELLER_EFFICIENCY * CLIMB_POWER * lapse / tas)
    return {
        "thrust_levels_ft": [float(level) for level in ATR_LEVELS_FT],
        "thrust_machs": list(ATR_MACHS),
        "climb_thrust_kn": [_kilonewtons(row) for row in climb],
        "idle_thrust_kn": [_kilonewtons(FLIGHT_IDLE * row) for row in climb],
    }


def _kilonewtons(thrust: object) -> list[float]:
    return [round(float(one) / 1e3, 1) for one in np.asarray(thrust)]


def as_toml(given: Table) -> str:
    """The lines of a type file."""
    return "".join(f"{key} = {_toml(value)}\n" for key, value in given.items())


def _toml(value: object) -> str:
    if isinstance(value, list) and isinstance(value[0], list):
        return "[\n" + "".join(f"  {row},\n" for row in value) + "]"
    return str(value)


def write(designator: str) -> None:
    """Put the tables into the type's file, where they were."""
    path = TYPES / f"{designator.lower()}.toml"
    content = path.read_text(encoding="utf-8")
    for key, value in table(designator).items():
        entry = re.compile(rf"^{key} = (\[\n(  .*\n)*\]|.*)$", re.MULTILINE)
        content, found = entry.subn(f"{key} = {_toml(value)}", content, count=1)
        if not found:
            raise SystemExit(f"{path}: there is no {key} to replace.")
    path.write_text(content, encoding="utf-8")


if __name__ == "__main__":
    if "--write" in sys.argv:
        write(sys.argv[1])
    else:
        sys.stdout.write(as_toml(table(sys.argv[1])))

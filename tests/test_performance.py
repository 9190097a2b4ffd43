"""The tables of the types are what `python -m tools.performance` gives, and what others find."""

import tomllib
import warnings
from importlib.resources import files
from importlib.util import find_spec

import numpy as np
import pytest

from relguide.flying.air import Air
from relguide.flying.airframe_files import airframe, known_airframes
from relguide.units import FT, KT
from tools.performance import ENGINES, as_toml, table

TYPES = files("relguide.flying").joinpath("types")
no_openap = pytest.mark.skipif(find_spec("openap") is None, reason="openap is not installed")


@pytest.mark.parametrize(
    "designator",
    [pytest.param(one, marks=no_openap if one in ENGINES else ()) for one in known_airframes()],
)
def test_tables_are_what_the_command_gives(designator: str) -> None:
    content = TYPES.joinpath(f"{designator.lower()}.toml").read_text(encoding="utf-8")
    there = tomllib.loads(content)
    for key, given in tomllib.loads(as_toml(table(designator))).items():
        assert there[key] == given, f"run python -m tools.performance {designator} --write"


@no_openap
@pytest.mark.parametrize("level", [100, 180, 246, 310, 330, 370])
@pytest.mark.parametrize("tas", [170.0, 200.0, 230.0])
def test_level_flight_speeds_up_and_slows_down_as_openap_has_it(level: int, tas: float) -> None:
    """On the A300's own wing, with openap's thrust and drag at a place between the tables' rows."""
    from openap import Thrust
    from openap.drag import Drag

    kind, air, feet = airframe("A306"), Air(), 100.0 * level
    least, most = kind.tas_range(feet * FT, air)
    if not least <= tas <= most:
        pytest.skip("not flown there")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        thrust, drag = Thrust("A332", ENGINES["A306"], force_engine=True), Drag("A332")
    drag.aircraft["wing"]["area"] = kind.wing_area
    drag.polar["clean"]["k"] = kind.induced_drag
    weight = kind.reference_weight
    pull = float(np.squeeze(drag.clean(weight, tas / KT, feet)))
    climb = float(np.squeeze(thrust.climb(tas / KT, feet, 0.0)))
    idle = float(np.squeeze(thrust.descent_idle(tas / KT, feet)))
    excess = kind.excess_acceleration(feet * FT, tas, air)
    assert excess == pytest.approx((climb - pull) / weight, abs=0.02)
    slowing = kind.idle_deceleration(feet * FT, tas, air)
    assert slowing == pytest.approx((pull - idle) / weight, abs=0.01)

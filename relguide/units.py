"""The display units of aviation, and the SI units our fields are in: the only non-SI file."""

from math import pi
from typing import Annotated

NM = 1852.0
"""International nautical mile [m]."""
FT = 0.3048
"""International foot [m]."""
KT = NM / 3600.0
"""Knot [m/s]."""
DEG = pi / 180.0
"""Degree of arc [rad]."""
G0 = 9.80665
"""Standard gravity g [m/s²]."""

# A field's unit is part of its type, so that `contract/wire.py` can put it into its JSON name.
Kilogram = Annotated[float, "kg"]
Metre = Annotated[float, "m"]
Second = Annotated[float, "s"]
Millisecond = Annotated[float, "ms"]
MetrePerSecond = Annotated[float, "mps"]
Radian = Annotated[float, "rad"]
RadianPerSecond = Annotated[float, "radps"]
SecondPerMetre = Annotated[float, "s/m"]
SecondPerRadian = Annotated[float, "s/rad"]
PerMetre = Annotated[float, "1/m"]

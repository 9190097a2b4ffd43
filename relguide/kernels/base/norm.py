"""The length of a vector in the plane. Compiled within kernels."""

from math import sqrt

from numba.extending import register_jitable


@register_jitable
def norm(x: float, y: float) -> float:
    """√(x² + y²): as `math.hypot`, without its care for numbers whose squares overflow."""
    return sqrt(x * x + y * y)

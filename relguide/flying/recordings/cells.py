"""Cells of recordings as numbers: missing values, decimal commas, and times of several kinds."""

from datetime import UTC, datetime
from math import inf, isfinite, isnan, nan

MISSING = frozenset(("", "null", "none", "nan", "na", "n/a", "nat", "-", "\\n"))
"""What stands where there is no number, in small letters."""
GROUND = "ground"
"""What readsb writes for the altitude of an aircraft on the ground."""
TRUE = frozenset(("true", "t", "1", "1.0", "yes"))
FALSE = frozenset(("false", "f", "0", "0.0", "no"))
PER_SECOND = ((1e17, 1e9), (1e14, 1e6), (1e11, 1e3))
"""Times of this size or more are counted in so many a second: seconds reach 10¹¹ in the year 5138,
milliseconds passed it in 1973."""
SHOWN = 40
"""How many characters of a wrong cell are quoted."""


def number(cell: str, where: str, *, low: float = -inf, high: float = inf) -> float:
    """A cell as a number; NaN if it holds none.

    Args:
        cell: its text.
        where: which cell it is, for people.
        low: least value that can be.
        high: largest value that can be.

    Raises:
        ValueError: if it is something else, or lies outside.
    """
    text = cell.strip()
    if text.lower() in MISSING:
        return nan
    try:
        value = float(text)
    except ValueError:
        raise ValueError(f"{where}: {text[:SHOWN]!r} is not a number.") from None
    if not low <= value <= high and not isnan(value):
        raise ValueError(f"{where}: must lie in {low:g} … {high:g}, not {text[:SHOWN]}.")
    return value


def truth(cell: str, where: str) -> float:
    """A cell that says yes or no, as 1 or 0; NaN if it is empty."""
    text = cell.strip().lower()
    if text in MISSING:
        return nan
    if text not in TRUE | FALSE:
        raise ValueError(f"{where}: {text[:SHOWN]!r} is neither true nor false.")
    return 1.0 if text in TRUE else 0.0


def moment(cell: str, where: str) -> float:
    """A cell as seconds since 1970 UTC, given so, in parts of a second, or as ISO 8601.

    Raises:
        ValueError: if it is no time.
    """
    text = cell.strip()
    try:
        seconds = since_1970(float(text))
    except ValueError:
        try:
            named = datetime.fromisoformat(text.removesuffix("UTC").strip())
        except ValueError:
            raise ValueError(
                f"{where}: {text[:SHOWN]!r} is neither a time like "
                "2021-10-07T12:00:00Z nor seconds since 1970."
            ) from None
        # times without a zone are UTC, as in all of aviation
        return (named if named.tzinfo else named.replace(tzinfo=UTC)).timestamp()
    if not isfinite(seconds):
        raise ValueError(f"{where}: {text[:SHOWN]!r} is not a time.")
    return seconds


def since_1970(count: float) -> float:
    """Seconds, milliseconds, micro- or nanoseconds since 1970, as seconds."""
    return next((count / per for least, per in PER_SECOND if abs(count) >= least), count)

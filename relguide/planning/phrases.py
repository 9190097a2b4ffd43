"""Headings, distances and times in sentences: no more digits than say something."""

from relguide.units import DEG, NM, Metre, Radian, Second


def whole_degrees(heading: Radian) -> int:
    """A heading in whole degrees, from 0 to 359."""
    return round(heading / DEG) % 360


def compass(heading: Radian) -> str:
    """A heading as it is read out: `087°`."""
    return f"{whole_degrees(heading):03d}°"


def distance(length: Metre) -> str:
    """A distance in nautical miles, in metres below a tenth of one: `2.31 NM`, `92.6 m`."""
    if length >= 0.1 * NM:
        return f"{length / NM:.2f} NM"
    return f"{round(length, 3):.3g} m"  # no certificate proves less than a millimetre


def too_close(least: Metre, limit: Metre) -> str:
    """How close a path comes; by how much it is too close, if both distances read alike."""
    if distance(least) == distance(limit):
        return f"{limit - least:.1f} m too close"
    return f"within {distance(least)}"


def too_close_to(ident: str, least: Metre, limit: Metre) -> str:
    """The same of other traffic, or of a cell, whose limit is 0 and whose inside is negative."""
    if limit <= 0.0:
        return f"{distance(abs(least))} into {ident}"
    close = too_close(least, limit)
    return f"{close} {'of' if close.startswith('within') else 'to'} {ident}"


def duration(time: Second) -> str:
    """A time to a tenth of a second; from ten seconds on, to a second."""
    if time < 0.05:
        return "less than 0.1 s"
    return f"{time:.1f} s" if time < 9.95 else f"{time:,.0f} s"


def comes_too_close(ident: str, least: Metre, limit: Metre, time: Second) -> str:
    """Whom a path comes too close to, and when: `comes within 3.10 NM of BAW12 at 140 s …`.

    Args:
        ident: of other traffic, or of a cell.
        least: how near it comes, negative inside a cell [m].
        limit: what is to be kept, 0 for a cell [m].
        time: when it is nearest [s].
    """
    near = f"comes {too_close_to(ident, least, limit)} at {time:.0f} s"
    return f"{near}, and {distance(limit)} is to be kept" if limit > 0.0 else near

"""Numbers on the command line, refused in a sentence when they make no sense."""

from argparse import ArgumentTypeError


def positive(text: str) -> int:
    """A count."""
    if not text.isdecimal() or int(text) < 1:
        raise ArgumentTypeError(f"must be a whole number from 1 up, not {text}")
    return int(text)


def share(text: str) -> float:
    """A part of all."""
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0.0 <= number <= 1.0:
        raise ArgumentTypeError(f"must be a number from 0 to 1, not {text}")
    return number

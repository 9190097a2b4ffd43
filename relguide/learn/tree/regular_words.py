"""words_like(pieces): the words that a regular trajectory is like, to be solved exactly.

A tree has its turns in steps of Δθ and its straights in steps of Δl, and what a network gives back
is blurred: both say which way to turn and about how far, never the lengths that end in the slot.
Of what they say the signs are kept, ε and straights in the order flown. Where a piece is too short
to show, the word has it all the same: L S is like LSL and like LSR.
"""

from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

from relguide.kernels.words.extremals import WORDS


class RegularPiece(NamedTuple):
    """A turn or a straight of the slot frame."""

    letter: str
    """`"L"`, `"S"` or `"R"`."""
    amount: float
    """Turn angle [rad], or length [R]."""


SIGN = {"L": 1.0, "S": 0.0, "R": -1.0}
"""ε of each letter, 0 of a straight."""


def pieces_of(pairs: Sequence[Sequence[float]]) -> list[RegularPiece]:
    """Pairs (ε, θ [rad], l [R]), forward, as pieces; what has no length is left out."""
    pieces = []
    for turn, angle, length in pairs:
        if angle > 0.0:
            pieces.append(RegularPiece("L" if turn > 0.0 else "R", angle))
        if length > 0.0:
            pieces.append(RegularPiece("S", length))
    return merge(pieces)


def merge(pieces: Sequence[RegularPiece]) -> list[RegularPiece]:
    """Like after like as one."""
    found: list[RegularPiece] = []
    for piece in pieces:
        if found and found[-1].letter == piece.letter:
            piece = RegularPiece(piece.letter, found.pop().amount + piece.amount)
        found.append(piece)
    return found


def words_like(pieces: Sequence[RegularPiece]) -> tuple[int, ...]:
    """Numbers of the words that pieces are like; more than one where pieces are too few to say.

    Pieces that are like no word lose their shortest ones until they are.
    """
    left = merge(pieces)
    while not (words := words_within("".join(piece.letter for piece in left))):
        shortest = min(range(len(left)), key=lambda i: left[i].amount)
        left = merge(left[:shortest] + left[shortest + 1 :])
    return words


@cache
def words_within(letters: str) -> tuple[int, ...]:
    """Numbers of the words that letters fit into, in their order: of none, all."""
    return tuple(number for number, word in enumerate(WORDS) if _fits_into(letters, word))


def _fits_into(letters: str, word: str) -> bool:
    rest = iter(word)
    return all(letter in rest for letter in letters)

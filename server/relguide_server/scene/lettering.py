"""Letters as line segments, for what is written on the ground of the 3D scene and lies there."""

import numpy as np

from relguide_server.scene.shapes import Points

_CORNERS = {
    "a": (0, 2), "b": (1, 2), "c": (2, 2), "d": (0, 1), "e": (1, 1), "f": (2, 1),
    "g": (0, 0), "h": (1, 0), "i": (2, 0),
}  # fmt: skip
"""Nine points of a letter, from the top left to the bottom right; half a height apart."""
_STROKES = {
    "A": "gd db bf fi df", "B": "ga ac ci ig df", "C": "ca ag gi",
    "D": "ga ab bf fh hg", "E": "ca ag gi de", "F": "ca ag de", "G": "ca ag gi if fe",
    "H": "ag ci df", "I": "bh ac gi", "J": "ci ig gd", "K": "ag cd di", "L": "ag gi",
    "M": "ga ae ec ci", "N": "ga ai ic", "O": "ac ci ig ga", "P": "ga ac cf fd",
    "Q": "ac ci ig ga ei", "R": "ga ac cf fd di", "S": "ca ad df fi ig", "T": "ac bh",
    "U": "ag gi ic", "V": "ah hc", "W": "ag ge ei ic", "X": "ai cg", "Y": "ae ce eh",
    "Z": "ac cg gi", "0": "ac ci ig ga cg", "1": "db bh", "2": "ac cf fd dg gi",
    "3": "ac ci ig df", "4": "ad df ci", "5": "ca ad df fi ig", "6": "ca ag gi if fd",
    "7": "ac cg", "8": "ac ci ig ga df", "9": "fd da ac ci",
}  # fmt: skip
"""The strokes of each letter, each from one of its points to another."""
WIDTH = 0.6
"""Of a letter, by its height."""
ADVANCE = 0.9
"""From one letter to the next, by their height."""


def written(text: str, height: float) -> Points:
    """A word as line segments (n, 2, 3) in the plane z = 0, read with north up.

    Args:
        text: capital letters and digits; anything else is left blank.
        height: of the letters [scene units]; the first one begins at the origin.
    """
    strokes = [
        [(_place(stroke[0], k), _place(stroke[1], k))]
        for k, letter in enumerate(text)
        for stroke in _STROKES.get(letter, "").split()
    ]
    if not strokes:
        return np.empty((0, 2, 3))
    return height * np.array(strokes).reshape(-1, 2, 3)


def _place(corner: str, number: int) -> tuple[float, float, float]:
    """Where a corner of the letter of that number stands, for letters 1 high."""
    column, row = _CORNERS[corner]
    return ADVANCE * number + WIDTH * column / 2.0, row / 2.0, 0.0

"""All figures of `relguide figures`, by name: the paper's in its order, then ours."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches

from relguide.figures.drawn import NamedFigure
from relguide.figures.ours import (
    amid_others,
    intent,
    planners,
    separation,
    stream_of_ten,
    wrong_wind,
)
from relguide.figures.paper import fig_1, fig_2, fig_3, fig_4, fig_5, fig_6, fig_7

FIGURES: Mapping[str, NamedFigure] = {
    figure.name: figure
    for figure in (
        fig_1.FIGURE,
        fig_2.FIGURE,
        fig_3.FIGURE,
        fig_4.FIGURE,
        fig_5.FIGURE,
        fig_6.FIG_6A,
        fig_6.FIG_6B,
        fig_7.FIGURE,
        intent.FIGURE,
        separation.FIGURE,
        wrong_wind.FIGURE,
        amid_others.FIGURE,
        planners.FIGURE,
        stream_of_ten.FIGURE,
    )
}


def figures_of(names: Sequence[str]) -> list[NamedFigure]:
    """Those asked for, in their order; all if no name is given.

    Raises:
        ValueError: if there is no such figure, in a sentence.
    """
    for name in names:
        if name not in FIGURES:
            near = get_close_matches(name, FIGURES, n=1, cutoff=0.6)
            meant = f" (did you mean {near[0]}?)" if near else ""
            raise ValueError(f"There is no figure {name!r}{meant}; there are {', '.join(FIGURES)}.")
    return [FIGURES[name] for name in dict.fromkeys(names or FIGURES)]

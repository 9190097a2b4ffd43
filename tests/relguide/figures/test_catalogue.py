"""The catalogue: complete, in order, and quick enough; what it refuses."""

import pytest

from relguide.figures.catalogue import FIGURES, figures_of
from relguide.planning.extras import EXTRAS

LONGEST = 600.0
"""All of them together, on one processor [s]."""


def test_the_papers_figures_come_first_and_none_is_left_out() -> None:
    papers = [name for name in FIGURES if name.startswith("fig_")]
    assert papers == ["fig_1", "fig_2", "fig_3", "fig_4", "fig_5", "fig_6a", "fig_6b", "fig_7"]
    assert list(FIGURES)[: len(papers)] == papers


def test_they_are_quick_and_say_what_they_need() -> None:
    assert sum(figure.seconds for figure in FIGURES.values()) < LONGEST
    assert all(set(figure.needs) <= set(EXTRAS) for figure in FIGURES.values())
    titles = [figure.title for figure in FIGURES.values()]
    assert len(set(titles)) == len(titles)


def test_those_asked_for_come_in_their_order_and_once() -> None:
    assert [one.name for one in figures_of(["fig_7", "fig_1", "fig_7"])] == ["fig_7", "fig_1"]
    assert [one.name for one in figures_of([])] == list(FIGURES)


def test_an_unknown_name_is_refused_with_the_nearest() -> None:
    with pytest.raises(ValueError, match=r"no figure 'fig_6' .did you mean fig_6"):
        figures_of(["fig_6"])

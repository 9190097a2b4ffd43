"""Fig. 2 is a regular trajectory of order 4 that an aircraft can fly into the slot."""

from relguide.figures.drawn import as_svg, draw
from relguide.figures.paper.fig_2 import FIGURE, REGULAR, situation
from relguide.flying.regular_card import regular_check


def test_it_ends_in_the_slot_and_keeps_d_min() -> None:
    found = regular_check(REGULAR, situation())
    assert found.order == 4
    assert found.reaches_slot
    assert found.keeps_separation


def test_its_triplets_and_nodes_are_written_on_it() -> None:
    text = as_svg(draw(FIGURE)).decode()
    for number in (1, 2, 3, 4):
        assert f">{number}</text>" in text
    assert text.count("ε") == text.count("θ") == 3

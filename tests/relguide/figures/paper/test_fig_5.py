"""Fig. 5 shows the networks as they are shipped."""

from relguide.figures.drawn import as_svg, draw
from relguide.figures.paper.fig_5 import FIGURE
from relguide.learn.tree.regular_network import load_regular, shipped_weights
from relguide.learn.words.branch_network import load_network


def test_the_sizes_are_those_of_the_weights() -> None:
    drawn = draw(FIGURE)
    text = as_svg(drawn).decode()
    paper, ours = load_regular(shipped_weights("paper")), load_network()
    for weights in paper.weights[1:]:
        assert f">{len(weights)} tanh</text>" in text
    inputs, width = ours.layers.first.shape
    for words in (f"{inputs} inputs", f"{width} SiLU", f"{ours.layers.last.shape[1]} outputs"):
        assert f">{words}</text>" in text

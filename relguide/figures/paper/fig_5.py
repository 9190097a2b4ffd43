"""Fig. 5: the feedforward structure of the networks, as shipped, and their audit."""

import re
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from relguide.figures.drawn import Drawn, NamedFigure, Step
from relguide.figures.results import read_results
from relguide.figures.style import BLUE, GREEN, INK, ORANGE, PALE, empty_figure
from relguide.kernels.words.branches import BRANCHES
from relguide.learn.tree.regular_network import load_regular, shipped_weights
from relguide.learn.words.branch_network import load_network

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TABLE = "network_side_by_side.csv"
SHOWN = 6
"""Units drawn of a layer that has more."""
INPUTS = ("x / R", "y / R", "cos ψ", "sin ψ")
OUTPUTS = ("ε", "θ", "l")
METHODS = "ours", "paper's network"
SHARE = re.compile(r"([\d.]+) \(([\d.]+)–([\d.]+)\)")


def draw(step: Step) -> Drawn:
    """The paper's network, ours, and how often each names the fastest branch."""
    del step
    paper, ours = load_regular(shipped_weights("paper")), load_network()
    sizes = [paper.weights[0].shape[0], *(len(bias) for bias in paper.biases)]
    features, branches = ours.layers.first.shape[0], len(BRANCHES)
    own = [features, *[ours.shape.width] * ours.shape.depth, ours.layers.last.shape[1]]
    figure = empty_figure(11.0, 5.6)
    rows = figure.add_gridspec(2, 2, width_ratios=[1.5, 1.0])
    left, below, right = (
        figure.add_subplot(place) for place in (rows[0, 0], rows[1, 0], rows[:, 1])
    )
    pairs = sizes[-1] // len(OUTPUTS)
    named = [f"${o}_{i}$" for i in range(pairs, 0, -1) for o in (r"\varepsilon", r"\theta", "l")]
    _network(left, sizes, "the paper's: situation → triplets", INPUTS, named, "tanh")
    _network(
        below, own, "ours: situation → which words to solve exactly",
        ["distances,\nangles", "margins from\nwhere branches\nchange"],
        ["each branch:\nits score,", "whether\nit exists,", "its time"], "SiLU",
    )  # fmt: skip
    told = _audit(right)
    weights = sum(w.size for w in paper.weights) + sum(b.size for b in paper.biases)
    return Drawn(
        figure,
        f"As shipped: the paper's network has layers of {_layers(sizes)} units ({weights:,} "
        f"weights, trained on {paper.about['trained_on']:,} states of the tree) and gives "
        f"{pairs} triplets; ours has {_layers(own)} and ranks {branches} branches. {told} "
        f"Audit: `{TABLE}`, made by `relguide audit --count 1000000 --beside 100000 --seed 1`.",
    )


def _layers(sizes: list[int]) -> str:
    return "–".join(f"{size}" for size in sizes)


def _network(
    axes: "Axes",
    sizes: list[int],
    title: str,
    inputs: "tuple[str, ...] | list[str]",
    outputs: list[str],
    unit: str,
) -> None:
    """Layers from left to right, each with its size; of the large ones some units are drawn."""
    axes.set_axis_off()
    axes.set_title(title)
    columns = [_heights(size) for size in sizes]
    for k, (here, there) in enumerate(pairwise(columns)):
        x = np.array([[k], [k + 1.0], [np.nan]])
        lines = np.array([(a, b, np.nan) for a in here for b in there]).T
        axes.plot(np.repeat(x, lines.shape[1], 1).T.ravel(), lines.T.ravel(), color=PALE, lw=0.35)
    for k, (size, heights) in enumerate(zip(sizes, columns, strict=True)):
        ends = k in (0, len(sizes) - 1)
        colour = (GREEN if k == 0 else ORANGE) if ends else BLUE
        axes.plot(
            [k] * len(heights), heights, "o", ms=9, mfc="white" if ends else colour, mec=colour,
            mew=1.6,
        )  # fmt: skip
        if len(heights) < size:
            axes.text(k, 0.0, "⋮", ha="center", va="center", fontsize=13)
        what = "inputs" if k == 0 else "outputs" if ends else unit
        axes.text(k, -1.32, f"{size} {what}", ha="center", va="top", color=INK)
    for beside, words, side in ((-0.16, inputs, "right"), (len(sizes) - 0.84, outputs, "left")):
        all_units = columns[0] if side == "right" else columns[-1]
        few = len(words) < len(all_units)
        heights = np.linspace(0.65, -0.65, len(words)).tolist() if few else all_units
        for height, word in zip(heights, words, strict=True):
            axes.text(beside, height, word, ha=side, va="center", fontsize=8)
    axes.set_xlim(-1.25, len(sizes) - 0.1)
    axes.set_ylim(-1.6, 1.15)


def _heights(size: int) -> list[float]:
    """Where its units are drawn; a gap in the middle stands for those left out."""
    if size <= 9:
        return [float(y) for y in np.linspace(1.0, -1.0, size)]
    half = SHOWN // 2
    return [*np.linspace(1.0, 0.3, half).tolist(), *np.linspace(-0.3, -1.0, half).tolist()]


def _audit(axes: "Axes") -> str:
    """How often each is right, and what that says in words."""
    rows = {row.pop("name"): row for row in read_results(TABLE)}
    named, flown = (
        next(row for name, row in rows.items() if name.startswith(words))
        for words in ("fastest branch named", "flown as given")
    )
    solved = next(row for name, row in rows.items() if name.startswith("words solved"))
    methods = list(named)
    axes.set_title("audit: 100 % less how often right")
    for row, look, label, shift in (
        (named, (BLUE, "o"), "fastest branch named first", 0.12),
        (solved, (ORANGE, "s"), "fastest path, its words solved", -0.12),
    ):
        for k, method in enumerate(methods):
            middle, low, high = _share(row[method])
            y = -k + shift
            wrong, least, most = 100.0 - middle, 100.0 - high, 100.0 - low
            axes.plot([max(least, 1e-3), most], [y, y], color=look[0], lw=1.0)
            axes.plot(
                [max(wrong, most if wrong <= 0.0 else wrong)], [y], look[1] if wrong > 0.0 else "<",
                color=look[0], ms=6, label=label if k == 1 else None,
            )  # fmt: skip
    axes.set_yticks([-k for k in range(len(methods))], methods)
    axes.set_xscale("log")
    axes.set_xlim(1e-3, 10.0)
    axes.set_ylim(-len(methods) + 0.4, 1.1)
    axes.set_xlabel("not right [%], with 95 % interval")
    axes.grid(visible=False, axis="y")
    axes.legend(loc="upper left")
    theirs, ours, share = (
        _share(row[method])[0]
        for row, method in ((named, METHODS[1]), (named, METHODS[0]), (flown, METHODS[1]))
    )
    return (
        "Within ten minutes of the slot, the paper's names the fastest branch in "
        f"{theirs:.2f} % of situations, ours in {ours:.2f} %; flown as given, {share:.3f} % of the "
        "paper's paths reach the slot."
    )


def _share(cell: str) -> tuple[float, float, float]:
    """A share and its interval [%], as the table writes them."""
    found = SHARE.match(cell)
    assert found is not None
    return float(found[1]), float(found[2]), float(found[3])


FIGURE = NamedFigure(
    name="fig_5",
    title="Fig. 5: the feedforward networks, and their audit",
    seconds=1.0,
    draw=draw,
)

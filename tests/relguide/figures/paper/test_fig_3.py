"""Fig. 3: each branch ends where its parent's begins, in the frame of the slot."""

import numpy as np

from relguide.figures.paper.fig_3 import PARAMETERS, _branches
from relguide.learn.tree.reverse_dp import reverse_tree


def test_branches_join_up_in_the_root() -> None:
    tree = reverse_tree(PARAMETERS)
    branches = _branches(tree)
    for node in range(1, len(tree)):
        side = -1.0 if tree.mirrored[node] else 1.0
        parent = branches[tree.parent[node]][0] * (1.0, side)
        assert np.allclose(branches[node][-1], parent, atol=1e-6)
    assert np.allclose(branches[0], 0.0)

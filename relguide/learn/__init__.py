"""Learning the optimal convergence: the paper's method as it writes it, and what became of it.

The paper's: `tree` is what reverse dynamic programming makes, a tree of regular trajectories that
all end in the slot; `reverse_dp` grows it (Fig. 3); `nearest` looks a situation up in it, which is
the paper's method without its network; `paper` is that network, trained on it (Fig. 5);
`area_figure` draws the convergence area from it, with the exact one beside it (Fig. 4). What both
give is read as words by `regular_words`, and `regular_planner` flies what the tree says, certified.

Ours: `labels` are situations with their exact answers; `train` makes a `network` of them that says
which words may be the fastest; `planner` solves those exactly and certifies what is found; `audit`
says how good all that is, `side_by_side` how good beside the paper's, `gaps` what explains its
misses.

Only this package may load torch or matplotlib, and it does so when they are used.
"""

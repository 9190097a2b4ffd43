"""Learning the optimal convergence: the paper's method as it writes it, and what became of it.

Read downward: `tree` is what reverse dynamic programming makes, a tree of regular trajectories that
all end in the slot; `reverse_dp` grows it (Fig. 3); `nearest` looks a situation up in it, which is
the paper's method without its network; `area_figure` draws the convergence area from it, with the
exact one beside it (Fig. 4). Only this package may load torch or matplotlib, and it does so when
they are used.
"""

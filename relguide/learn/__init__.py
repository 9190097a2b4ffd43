"""Learning to converge: the paper's method as it describes it, and what became of it.

    tree       reverse dynamic programming and the regular network: the paper's method
    words      the branch network: which words may be the fastest, where the limit does not bind
    boundary   the template network: which constrained paths to solve, where it binds
    training   what all trainings share: the loop, checkpoints, files
    audits     how good the networks are, against exact answers

`network_planner` solves exactly the words and paths that the branch and template networks name, and
certifies the result; `tree.regular_planner` certifies what the tree proposes.

Training and inference in bulk import torch when they begin. Planning by networks and by the tree
needs only numpy and numba.
"""

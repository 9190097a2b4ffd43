"""From a situation to a plan and its proof, in the air mass.

Read `trajectory.py` (the segments of a path), `situation.py` (what is asked) and `slot.py`,
`tables.py` (the same as the kernels see it); then `words.py` (every extremal that reaches the
slot), `certificate.py` (a proved bound on the separation), `constrained_path.py` (where the limit
binds), `least_bad.py` (where no path keeps it) and `plan.py`, which chooses; `batch.py` plans for
many situations at once. `prove.py` and `contact_search.py` raise the lower bound of a plan's time.
`frames.py` converts latitude and longitude to a plane.

What is said of a plan: `alternatives.py`, which other paths there are and why they lost;
`passing.py`, on which side they pass the leader; `legs.py`, `costates.py`, `adjoint.py` and
`optimality.py`, whether it meets Pontryagin's conditions; `regular.py` and
`regular_evaluation.py`, the paper's own triplets.
"""

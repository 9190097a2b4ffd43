"""From a situation to a plan and its proof, in the air mass.

Read `trajectory.py` (the pieces of a path), `situation.py` (what is asked) and `slot_frame.py` (the
same as the kernels see it); then `words.py` (every extremal that reaches the slot),
`certificate.py` (a proved bound on the separation), `detour.py` and `recovery.py` (where that limit
binds, and where no way keeps it) and `plan.py`, which chooses; `time_rows.py` does so for many.
`frames.py` lays latitude and longitude into their plane. Beside the way: `alternatives.py` says
what else there was and why it lost, `passing.py` on which side of the leader; `legs.py`,
`costates.py`, `adjoint.py` and `optimality.py` check Pontryagin's conditions along a plan;
`regular.py` and `regular_evaluation.py` hold the paper's own triplets.
"""

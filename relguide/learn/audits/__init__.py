"""How good the networks are, against exact answers. Judging works by chunks, audits sum them up.

branch_judging        the branch network on fresh situations, without the limit
constrained_judging   the template network where the limit binds
planner_judging       both networks together, and their planner, whether it binds or not
template_judging      a chunk of those two
branch_audit, template_audit   sum up chunks: shares with intervals, gaps, doubts
gaps, side_by_side    how near a miss is to a switching surface; ours beside the paper's networks
"""

"""Which path to fly: a plan is led in, flown ahead, and committed to if what is flown keeps d_min.

    committed path → lead-in → situation → plan → preferred plan → course → flown ahead → proposal

Each file of the room does one step of this, and knows the steps before it. `propose` and `better`
go through all of them; what they give is a `Proposal`, which has the new committed path and the
plan as a crew sees it.
"""

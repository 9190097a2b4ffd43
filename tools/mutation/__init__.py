"""Whether the tests would notice: small faults put into the code, one at a time.

`python -m tools.mutation --help` says how to run it, docs/mutation.md what it has found.
"""

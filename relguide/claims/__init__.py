"""What README and docs claim, a row each, and whether it still holds.

`claims.toml` has the rows. `claim` says what a row is and reads them, `reading` finds a number in
what a command prints or in a kept table, `run` runs the commands and judges, `kept` holds what was
obtained last, `uncovered` lists numbers that are no claims, and `page` writes docs/claims.md.
"""

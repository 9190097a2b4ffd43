"""Paths that touch d = d_min or slide along it: the search where the limit binds."""

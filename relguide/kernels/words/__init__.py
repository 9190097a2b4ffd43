"""Paths without the separation limit: all six words, all their roots, and the fastest of them."""

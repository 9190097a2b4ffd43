"""Figures of what was measured beyond the paper, one file each."""

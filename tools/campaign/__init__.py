"""Thousands of flights drawn at random, and what became of them: `python -m tools.campaign`."""

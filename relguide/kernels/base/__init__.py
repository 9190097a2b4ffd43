"""What every kernel stands on: angles, turns, motion, costates, roots, the slot frame."""

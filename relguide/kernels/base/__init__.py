"""What every kernel stands on: angles, turns, motion, roots, the slot frame."""

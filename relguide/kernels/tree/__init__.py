"""One step of the paper's reverse dynamic programming."""

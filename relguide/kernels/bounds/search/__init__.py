"""Branch and bound over cells of first and last contacts."""

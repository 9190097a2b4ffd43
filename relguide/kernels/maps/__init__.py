"""The time-to-converge at many places at once."""

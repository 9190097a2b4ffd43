"""How close two aircraft come: proved bounds on the separation."""

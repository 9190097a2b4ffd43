"""A flight in 3D, drawn on a viser server."""

"""Flights in the air: their routes, their streams, and replays."""

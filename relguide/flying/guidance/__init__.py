"""Guidance, once a second: from what is believed to a reference for the autopilot and a speed."""

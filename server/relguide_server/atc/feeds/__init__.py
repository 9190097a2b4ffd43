"""Feeds: who else says what flies. Each is listened to while the service runs, and may fall silent.

A feed gives reports as they come. What it sends amiss is counted and ends nothing.
"""

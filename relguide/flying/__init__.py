"""From a plan to a flight and what it says of itself, in the closed loop.

Read `aircraft.py` and `pid.py`, `autopilot.py` over them, and `steering.py` and `capture.py`, which
say what to ask of it. `assignment.py`, `flown_path.py`, `commitment.py`, `escape.py`, `closing.py`,
`announcements.py` and `memory.py` are what `guidance.py` decides with, once a second. The leader:
`smoothing.py`, `tracks.py`, `leader.py`, `orders.py`. Then `documents.py`, `cards.py` and
`logbook.py` (what is said of it all; `verdicts.py` and `regular_card.py`: if asked for),
`flight.py` (the one closed loop) and `scenarios.py`.
"""

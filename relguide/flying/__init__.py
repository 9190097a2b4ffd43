"""From a plan to a flight and its documents, in a closed loop.

Read it in this order, from below:

1. `aircraft.py`, `pid.py`, `autopilot.py`: an aircraft, and the two loops that fly it.
2. `steering.py`, `capture.py`: what to ask of the autopilot on a planned path, and near the slot.
3. `assignment.py`, `flown_path.py`: what the pursuer was asked to do, and what it knows.
4. `path_distance.py`, `commitment.py`, `escape.py`: which plan to fly, and where to go without one.
5. `announcements.py`, `memory.py`: what guidance announces and what it remembers.
6. `holding.py`, `closing.py`, `guidance.py`: its modes, chosen once a second.
7. `smoothing.py`, `tracks.py`, `leader.py`, `orders.py`: the leader, recorded or under command.
8. `documents.py`, `cards.py`, `verdicts.py`, `regular_card.py`, `logbook.py`: the documents.
9. `flight.py`: the closed loop; `scenarios.py`: what is flown; `present.py`: the situation at some
   instant of a flight, read from its documents.
"""

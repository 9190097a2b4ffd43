"""From a plan to a flight and its documents, in a closed loop.

Read it in this order, from below:

1. `air.py`, `airframe.py`, `envelope.py`: the air, and what an aircraft type can do in it.
2. `tracks.py`, `smoothing.py`, `spline.py`, `recordings/`, `leaders/`: what leaders fly, declared
   or recorded.
3. `belief.py`: what a pursuer knows; `modes.py`: which mode may follow which.
4. `guidance/`: once a second, from belief to a reference and a speed. In it `settings.py` has all
   constants, `forecast.py` flies ahead, `committed.py` and `converge.py` choose the path,
   `monitor.py`, `escape.py` and `leaving.py` keep clear, `advise.py` puts it together.
5. `world.py`: all aircraft, the air, and who is to join whom; `orders.py`: commands to a leader.
6. `documents.py` and what it is made of, `cards.py`, `verdicts.py`, `regular_card.py`,
   `logbook.py`: what a flight says of itself.
7. `simulation.py`: the closed loop; `flight.py`: of two aircraft; `dispersion.py`, `scenarios.py`:
   what is flown; `present.py`: the situation at some instant of a flight, read from its documents.
"""

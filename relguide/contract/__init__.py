"""The contract: everything outsiders send and receive, as strict JSON whose names include units.

Read `refusal.py` (how wrong input is refused), `wire.py` (documents to JSON), `bodies.py`
(situations from JSON), `messages.py` (documents from JSON, ticks, flights and commands) and
`area_bodies.py` (convergence areas to JSON); for the browser, `typescript.py` and `protocol.py`
(the same shapes as types, and the stream's name); then what uses them: `answers.py` (a plan for
each situation), `orders.py` (commands to a flight at their times), `recorder.py` (a flight to a
file, and back) and `flight_summary.py` (a flight in short). `triplets.py` reads the paper's regular
trajectories.
"""

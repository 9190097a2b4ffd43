"""The contract: everything outsiders send and get, as strict JSON in which each name says its unit.

Read `refusal.py` (how nonsense is refused), `wire.py` (documents to JSON), `bodies.py` (situations
from JSON), `messages.py` (documents back, the stream's ticks, flights and commands) and, for the
browser, `typescript.py` and `protocol.py` (the same shapes as types, and the stream's name); then
what is made of them: `answers.py` (a plan for each situation), `recorder.py` (a flight to a file,
and back) and `story.py` (a flight in short). `triplets.py` reads the paper's regular trajectories.
"""

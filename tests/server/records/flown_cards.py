"""Flights and clearances as they are asked for."""

import json

from relguide_server.records.entries import ClearanceNoted, FlightCard


def card(flight_id: str) -> FlightCard:
    return FlightCard(
        id=flight_id, scenario="ideal", title="Ideal", request="{}", settings="{}", seed=0,
        requested_by="127.0.0.1",
    )  # fmt: skip


def noted(clearance_id: str, state: str, steps: int = 1, *, over: bool = False) -> ClearanceNoted:
    """A clearance that has come so far in so many steps."""
    step = {"state": state, "t_s": 7.0, "at": "2026-11-22T09:30:00Z", "by": "crew", "message": ""}
    content = {"id": clearance_id, "state": state, "due_s": 9.0, "deviations": [1]}
    return ClearanceNoted(
        id=clearance_id, at=1e9, changed_at=1e9 + steps, flight_id="one", state=state, over=over,
        request="{}", card=json.dumps(content | {"history": [step] * steps}), owner="",
        asked_by="127.0.0.1",
    )  # fmt: skip

"""Flights as they are asked for."""

from relguide_server.records.entries import FlightCard


def card(flight_id: str) -> FlightCard:
    return FlightCard(
        id=flight_id, scenario="ideal", title="Ideal", request="{}", settings="{}", seed=0,
        requested_by="127.0.0.1",
    )  # fmt: skip

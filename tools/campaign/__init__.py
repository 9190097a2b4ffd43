"""The figures of docs/flight.md: loops, responses, the campaign: `python -m tools.campaign`."""

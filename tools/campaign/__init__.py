"""The figures of docs/flight.md: loops, step responses, the campaign: `python -m tools.campaign`."""

"""Programs that serve developers: each is run with `python -m tools.NAME`."""

"""The command line: what `relguide plan`, `fly`, `train` and the others do."""

"""The service under load and under attack: `speed`, `attacks` and `fuzz` are commands."""

"""The container and the composition without an engine: every step of the files themselves."""

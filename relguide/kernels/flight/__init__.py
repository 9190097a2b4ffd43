"""One step of an aircraft in flight."""

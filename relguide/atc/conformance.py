"""Whether an aircraft flies what it is cleared to fly."""

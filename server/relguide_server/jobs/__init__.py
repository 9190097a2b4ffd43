"""Work that takes long: queues in which clients take turns, and the processes that do it."""

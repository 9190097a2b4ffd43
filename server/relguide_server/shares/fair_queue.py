"""A bounded queue in which clients take turns, however many jobs each has put in."""

from collections import OrderedDict, deque
from typing import Generic, TypeVar

T = TypeVar("T")


class FairQueue(Generic[T]):
    """Jobs that wait. Of those of a client the oldest comes first; after it another client's."""

    def __init__(self, room: int) -> None:
        """Make an empty one.

        Args:
            room: most jobs that wait; one client may have half of them.
        """
        self._room = room
        self._clients: OrderedDict[str, deque[T]] = OrderedDict()
        self._count = 0

    def __len__(self) -> int:
        return self._count

    def has_room(self, client: str) -> bool:
        """Whether one more job of a client may wait."""
        return self._count < self._room and self.count_of(client) < max(self._room // 2, 1)

    def count_of(self, client: str) -> int:
        """How many jobs of a client wait."""
        return len(self._clients.get(client, ()))

    def is_full(self) -> bool:
        """Whether no more jobs may wait, whoever's they are."""
        return self._count >= self._room

    def put(self, job: T, client: str) -> None:
        """Let a job wait."""
        self._clients.setdefault(client, deque()).append(job)
        self._count += 1

    def take(self) -> T:
        """The next job.

        Raises:
            KeyError: if none waits.
        """
        client, jobs = self._clients.popitem(last=False)
        job = jobs.popleft()
        self._count -= 1
        if jobs:
            self._clients[client] = jobs
        return job

    def drop(self, job: T, client: str) -> None:
        """Let a job wait no longer, if it does."""
        jobs = self._clients.get(client)
        if jobs is None or job not in jobs:
            return
        jobs.remove(job)
        self._count -= 1
        if not jobs:
            del self._clients[client]

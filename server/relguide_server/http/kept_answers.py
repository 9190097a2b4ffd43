"""Answers that are kept, to be given again to a client that asks again by the same key."""

from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic

from starlette.responses import Response

from relguide.units import Second

REPLAYED = "Idempotent-Replayed"
"""Header of an answer that was given before."""
KEPT_FOR: Second = 86_400.0
"""How long an answer is kept."""
ANSWERS = 1000
"""Answers that are kept for one client; of more, the newest."""
OF_ONE, OF_ALL = 4 * 1024 * 1024, 64 * 1024 * 1024
"""What the answers of one client may take, and those of all [bytes]; of more, the newest."""
AN_ANSWER = 600
"""What an answer counts beside its body [bytes]: its headers, its key, and where it is found."""


@dataclass(frozen=True, slots=True)
class Asked:
    """A request, as the key must find it again."""

    line: str
    """Method and address."""
    body: bytes
    """Its hash."""


@dataclass(frozen=True, slots=True)
class Answer:
    """An answer that can be sent again."""

    status: int
    headers: list[tuple[bytes, bytes]]
    body: bytes

    def sent(self, *, again: bool) -> Response:
        """The response; one that was sent before says so."""
        response = Response(self.body, self.status)
        said = [(REPLAYED.lower().encode(), b"true")] if again else []
        response.raw_headers = [*self.headers, *said]
        return response


@dataclass(frozen=True, slots=True)
class Kept:
    """An answer, and what was asked."""

    asked: Asked
    answer: Answer
    at: Second

    @property
    def size(self) -> int:
        """What it takes [bytes]."""
        return len(self.answer.body) + AN_ANSWER


@dataclass(slots=True)
class Share:
    """What is kept for one client."""

    keys: dict[str, None] = field(default_factory=dict)
    """The oldest first."""
    size: int = 0


class KeptAnswers:
    """The answers of a day by client and key, the oldest first."""

    def __init__(
        self,
        clock: Callable[[], Second] = monotonic,
        *,
        answers: int = ANSWERS,
        of_one: int = OF_ONE,
        of_all: int = OF_ALL,
    ) -> None:
        """Keep nothing yet; the bounds are those of the module."""
        self._clock = clock
        self._answers, self._of_one, self._of_all = answers, of_one, of_all
        self._kept: dict[tuple[str, str], Kept] = {}
        self._shares: dict[str, Share] = {}
        self.size = 0
        """Of all [bytes]."""

    def get(self, client: str, key: str) -> Kept | None:
        """What was answered, if that is kept."""
        self._forget_old()
        return self._kept.get((client, key))

    def put(self, client: str, key: str, asked: Asked, answer: Answer) -> None:
        """Keep an answer; the oldest make room for it, those of the same client first."""
        kept = Kept(asked, answer, self._clock())
        share = self._shares.setdefault(client, Share())
        self._kept[client, key] = kept
        share.keys[key] = None
        share.size += kept.size
        self.size += kept.size
        while len(share.keys) > self._answers or share.size > self._of_one:
            self._forget(client, next(iter(share.keys)))
        while self.size > self._of_all:
            self._forget(*next(iter(self._kept)))

    def _forget_old(self) -> None:
        too_old = self._clock() - KEPT_FOR
        while self._kept and next(iter(self._kept.values())).at < too_old:
            self._forget(*next(iter(self._kept)))

    def _forget(self, client: str, key: str) -> None:
        size, share = self._kept.pop((client, key)).size, self._shares[client]
        del share.keys[key]
        share.size -= size
        self.size -= size
        if not share.keys:
            del self._shares[client]

"""The frames that a client sends up a stream: bounded, and read; or why its socket is closed."""

from collections.abc import Callable, Mapping
from time import monotonic
from typing import Any

from pydantic import RootModel

from relguide.contract.refusal import ContractError, parse
from relguide.contract.upstream import Upstream
from relguide.units import Second

NOT_UNDERSTOOD, TOO_FAST = 4422, 4439
"""Close codes."""
LONGEST = 200
"""Of a frame [bytes]; a stick has some 60."""
MOST = 40
"""Frames a second, and at once after a second of silence: twice what a client should send."""
LONGEST_REASON = 120
"""Of what is said when a socket is closed [bytes]: the protocol has room for 123."""


class ClientFrame(RootModel[Upstream]):
    """What a client sends."""


class UnwelcomeFrame(Exception):
    """A socket is to be closed for what it sent.

    Attributes:
        code: close code.
        why: for the metrics.
        reason: a sentence, short enough for a close frame.
    """

    def __init__(self, code: int, reason: str) -> None:
        super().__init__(reason)
        self.code, self.reason = code, _shorten(reason)
        self.why = "too_fast" if code == TOO_FAST else "not_understood"


class FrameAllowance:
    """How many frames a second a socket may send: as many at once after a second of silence."""

    def __init__(self, most: int, clock: Callable[[], Second] = monotonic) -> None:
        self._most, self._clock = most, clock
        self._left, self._at = float(most), clock()

    def admits_one(self) -> bool:
        """Whether one more frame is not one too many."""
        now = self._clock()
        self._left = min(self._left + self._most * (now - self._at), self._most) - 1.0
        self._at = now
        return self._left >= 0.0


class FrameReader:
    """Reads the frames of one client. Lives on the event loop."""

    def __init__(self, clock: Callable[[], Second] = monotonic) -> None:
        self._allowance = FrameAllowance(MOST, clock)

    def read(self, event: Mapping[str, Any]) -> Upstream:
        """What a client sent.

        Args:
            event: as ASGI has it, `websocket.receive`.

        Raises:
            UnwelcomeFrame: if it is no frame of the protocol, or one too many.
        """
        if not self._allowance.admits_one():
            raise UnwelcomeFrame(TOO_FAST, f"A client may send {MOST} frames a second: send less.")
        text = event.get("text")
        if text is None:
            raise UnwelcomeFrame(NOT_UNDERSTOOD, "A frame must be text: JSON, not binary.")
        size = len(text.encode())
        if size > LONGEST:
            said = f"A frame may have at most {LONGEST} bytes, not {size:,}."
            raise UnwelcomeFrame(NOT_UNDERSTOOD, said)
        try:
            frame: Upstream = parse(ClientFrame, text).root
        except ContractError as error:
            raise UnwelcomeFrame(NOT_UNDERSTOOD, f"No frame of this stream: {error}") from None
        return frame


def _shorten(text: str) -> str:
    written = text.encode()
    if len(written) <= LONGEST_REASON:
        return text
    return f"{written[: LONGEST_REASON - 3].decode(errors='ignore')}…"

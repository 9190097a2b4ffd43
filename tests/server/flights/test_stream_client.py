"""The queue of one client: newest wins, and nobody is left with a wrong picture."""

import asyncio

from relguide_server.flights.stream import QUEUE, StreamClient
from relguide_server.http.metrics import Metrics


class Browser:
    """A WebSocket that takes messages only while `reading`."""

    def __init__(self) -> None:
        self.taken: list[str] = []
        self.closed: tuple[int, str] | None = None
        self.reading = asyncio.Event()
        self.reading.set()
        self.gone = asyncio.Event()

    async def send_text(self, text: str) -> None:
        await self.reading.wait()
        self.taken.append(text)

    async def receive(self) -> dict[str, str]:
        await self.gone.wait()
        return {"type": "websocket.disconnect"}

    async def close(self, code: int, reason: str) -> None:
        self.closed = (code, reason)


def expect_silence(frame: object) -> None:
    raise AssertionError(f"{frame} came from a browser that only watches.")


async def settle() -> None:
    for _ in range(10):
        await asyncio.sleep(0)


def test_a_new_client_gets_the_snapshot_then_the_ticks() -> None:
    async def scenario() -> None:
        browser = Browser()
        client = StreamClient(lambda: "snapshot", Metrics())
        pump = asyncio.create_task(client.pump(browser, expect_silence))  # type: ignore[arg-type]
        await settle()
        for text in ("one", "two"):
            client.offer(text, essential=False)
            await settle()
        browser.gone.set()
        await pump
        assert browser.taken == ["snapshot", "one", "two"]

    asyncio.run(scenario())


def test_a_slow_client_skips_samples_and_holds_up_nobody() -> None:
    async def scenario() -> None:
        metrics = Metrics()
        browser = Browser()
        client = StreamClient(lambda: "snapshot", metrics)
        pump = asyncio.create_task(client.pump(browser, expect_silence))  # type: ignore[arg-type]
        await settle()
        browser.reading.clear()
        for k in range(50):
            client.offer(f"{k}", essential=False)
            await settle()
        browser.reading.set()
        await settle()
        browser.gone.set()
        await pump
        # the one it was stuck on, then the newest two
        assert browser.taken == ["snapshot", "0", "48", "49"]
        assert metrics.value("relguide_stream_ticks_dropped_total") == 49 - QUEUE

    asyncio.run(scenario())


def test_whoever_missed_a_plan_is_sent_all_anew() -> None:
    async def scenario() -> None:
        browser = Browser()
        snapshots = iter(("first snapshot", "second snapshot"))
        client = StreamClient(lambda: next(snapshots), Metrics())
        pump = asyncio.create_task(client.pump(browser, expect_silence))  # type: ignore[arg-type]
        await settle()
        browser.reading.clear()
        for k in range(10):
            client.offer(f"{k}", essential=k == 3)
            await settle()
        browser.reading.set()
        await settle()
        client.offer("10", essential=False)
        await settle()
        browser.gone.set()
        await pump
        assert browser.taken == ["first snapshot", "0", "second snapshot", "10"]

    asyncio.run(scenario())


def test_the_end_comes_with_a_sentence_after_what_waits() -> None:
    async def scenario() -> None:
        browser = Browser()
        client = StreamClient(lambda: "snapshot", Metrics())
        client.close(4410, "It is over.")
        await client.pump(browser, expect_silence)  # type: ignore[arg-type]
        assert browser.taken == ["snapshot"]
        assert browser.closed == (4410, "It is over.")

    asyncio.run(scenario())

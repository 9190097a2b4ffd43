"""Latest wins for samples; nothing else is lost."""

import threading

from relguide_server.scene.inbox import Inbox

from relguide.flying.documents import ModeChanged, PlanChanged, Sample
from tests.server.flown import ideal_flight


def test_only_the_newest_sample_waits() -> None:
    inbox = Inbox()
    documents = list(ideal_flight(duration=5.0))
    for document in documents:
        inbox.put(document)
    taken = inbox.drain()
    samples = [d for d in taken if isinstance(d, Sample)]
    assert [s.t for s in samples] == [5.0]
    assert [d for d in taken if not isinstance(d, Sample)] == [
        d for d in documents if not isinstance(d, Sample)
    ]
    assert [d.t for d in taken] == sorted(d.t for d in taken)
    assert inbox.drain() == []


def test_a_reader_waits_until_there_is_something() -> None:
    inbox = Inbox()
    taken: list[object] = []
    reader = threading.Thread(target=lambda: taken.extend(inbox.wait()))
    reader.start()
    first = next(ideal_flight())
    inbox.put(first)
    reader.join(2.0)
    assert taken == [first]


def test_closing_lets_a_reader_go() -> None:
    inbox = Inbox()
    taken: list[list[object]] = []
    reader = threading.Thread(target=lambda: taken.append(list(inbox.wait())))
    reader.start()
    inbox.close()
    reader.join(2.0)
    assert taken == [[]]


def test_order_is_kept_around_a_sample() -> None:
    inbox = Inbox()
    documents = list(ideal_flight(duration=0.1))
    plan = next(d for d in documents if isinstance(d, PlanChanged))
    mode = next(d for d in documents if isinstance(d, ModeChanged))
    first, second, *_ = [d for d in documents if isinstance(d, Sample)]
    for document in (first, plan, second, mode):
        inbox.put(document)
    assert inbox.drain() == [plan, second, mode]

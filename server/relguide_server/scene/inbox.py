"""Documents from one thread to another: of samples only the newest waits, of the rest all."""

import threading

from relguide.flying.documents import Document, Sample


class Inbox:
    """The documents of a flight since they were last taken. Safe between threads."""

    def __init__(self) -> None:
        self._filled = threading.Condition()
        self._documents: list[Document] = []
        self._closed = False

    def put(self, document: Document) -> None:
        """Add a document. A sample takes the place of one that still waits."""
        with self._filled:
            if isinstance(document, Sample):
                waiting = self._documents
                self._documents = [d for d in waiting if not isinstance(d, Sample)]
            self._documents.append(document)
            self._filled.notify()

    def drain(self) -> list[Document]:
        """Take all that is there, in the order of the flight, without waiting."""
        with self._filled:
            documents, self._documents = self._documents, []
            return documents

    def wait(self, patience: float | None = None) -> list[Document]:
        """Take all as soon as there is something.

        Args:
            patience: how long to wait [s]; `None` for as long as it takes.

        Returns:
            Nothing once the inbox is closed, or when it took too long.
        """
        with self._filled:
            self._filled.wait_for(lambda: self._documents or self._closed, patience)
            if self._closed:
                return []
            documents, self._documents = self._documents, []
            return documents

    @property
    def closed(self) -> bool:
        """Whether nothing will come any more."""
        return self._closed

    def close(self) -> None:
        """End all waiting."""
        with self._filled:
            self._closed = True
            self._filled.notify_all()

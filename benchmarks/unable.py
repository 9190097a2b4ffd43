"""Why a flight that did not join flies no plan at its end."""

from collections.abc import Iterable

from relguide.flying.documents import Document, PlanChanged, Unable


def unable_at_the_end(documents: Iterable[Document]) -> Unable | None:
    """What guidance was first unable for since its last plan; `None` if that plan stands.

    What it says later is of the heading it holds meanwhile.
    """
    why: Unable | None = None
    for document in documents:
        if isinstance(document, PlanChanged):
            why = None
        elif isinstance(document, Unable):
            why = why or document
    return why

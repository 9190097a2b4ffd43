"""Why a flight that did not join flies no plan at its end."""

from collections.abc import Iterable

from relguide.flying.documents import Document, PlanChanged, Unable


def unable_at_the_end(documents: Iterable[Document]) -> Unable | None:
    """What guidance was last unable for since its last plan; `None` if that plan stands.

    That it turns to another heading meanwhile, which is said as well, is no reason.
    """
    why: Unable | None = None
    for document in documents:
        if isinstance(document, PlanChanged):
            why = None
        elif isinstance(document, Unable) and document.message.startswith("Unable"):
            why = document
    return why

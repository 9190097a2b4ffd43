"""Times below d_min, and whether a crew was warned of them."""

from collections.abc import Iterable, Iterator
from math import inf

from relguide.campaign.instant import EVERY, Instant
from relguide.campaign.row import Loss
from relguide.flying.aircraft_documents import LinkResult
from relguide.flying.documents import Alert, Document, Unable
from relguide.units import Metre, Second

ROUNDING: Metre = 1.0
"""d_min less this is kept: a slot may lie on d_min itself."""
WARNED: Second = 180.0
"""An alert longer ago does not announce a loss, nor does one that was cleared."""
SAME: Second = 2.0
"""So near each other in time, a loss found here and one of a document are one."""


def warnings_of(documents: Iterable[Document]) -> Iterator[tuple[Second, Second]]:
    """From when to when a crew was warned of what a loss of d_min may follow from."""
    since: float | None = None
    for document in documents:
        match document:
            case Alert(t=t, subject="separation", cleared=True):
                if since is not None:
                    yield since, t
                since = None
            case Alert(t=t, subject="separation", level="caution" | "warning"):
                since = t if since is None else since
            case Unable(t=t):
                yield t, t + WARNED
            case _:
                pass
    if since is not None:
        yield since, inf


def losses_of(
    min_separation: Metre,
    samples: list[Instant],
    end: LinkResult,
    warnings: tuple[tuple[Second, Second], ...],
) -> Iterator[Loss]:
    """Each time below d_min."""
    limit = min_separation - ROUNDING
    runs: list[list[Instant]] = []
    inside = False
    for sample in samples:
        below = sample.guidance.separation < limit
        if below and not inside:
            runs.append([])
        if below:
            runs[-1].append(sample)
        inside = below
    if not runs and end.least_separation < limit:  # between two samples
        runs.append([min(samples, key=lambda s: s.guidance.separation)])
    for run in runs:
        begun = run[0].t
        before = [begun - since for since, until in warnings if since <= begun <= until]
        causes = [loss.cause for loss in end.losses if abs(loss.t - begun) <= SAME]
        yield Loss(
            t_s=begun,
            separation_m=min(sample.guidance.separation for sample in run),
            seconds=len(run) * EVERY,
            mode=run[0].guidance.mode,
            cause=causes[0] if causes else "",
            announced_s=max(before) if before else None,
        )

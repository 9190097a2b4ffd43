"""template_audit_of(judged parts) → TemplateAudit: how good the networks are, the limit included.

Every share comes with its 95 % interval (Wilson); every gap above 0.1 % with why it is there.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.networks.templates import NONE, SEVERAL, TEMPLATES
from relguide.learn.audits.branch_audit import PERCENTILES, Doubt, doubts_of
from relguide.learn.audits.branch_judging import ROUNDING
from relguide.learn.audits.constrained_judging import ConstrainedVerdicts
from relguide.learn.audits.planner_judging import UNIT, PlannerVerdicts
from relguide.learn.audits.template_judging import TemplateVerdicts, join_template_verdicts
from relguide.learn.boundary.template_labels import SOURCES
from relguide.learn.boundary.train_templates import WITHIN
from relguide.learn.training.shares import Share, share_as_json
from relguide.learn.words.branch_labels import Floats
from relguide.units import Second

LATE: Second = 0.1
"""A delay above this is reported."""
WORTH = 1e-3
"""A gap above this is looked into."""
LISTED = 100
"""Most gaps that are listed, the largest ones."""
COMMONEST = 12
"""Templates with a line of their own."""
GapReason = Literal["left out", "not solved", "of no template"]
REASONS: tuple[GapReason, ...] = ("left out", "not solved", "of no template")
"""Why an answer is slow: the right template is left out of the set; it is held, but not solved next
to its guess; the fastest path is of no template."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Late:
    """How much is lost by what networks answer."""

    answered: Share
    """How often they do, of situations in which there is a path."""
    gaps: tuple[float, ...]
    """The `PERCENTILES` of how much longer an answer takes than the fastest path, relative."""
    late: Share
    """How many answers are more than `LATE` later, where R/V_P is `UNIT`."""
    sooner: int
    """Answers by more than `WITHIN` sooner than the search's."""
    invented: Share
    """How often they answer where there is no path: never, it is hoped."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateGroup:
    """How good the template network is on some situations in which the limit binds."""

    name: str
    size: int
    named: Share
    """How often its first choice is right; see `constrained_judging.ConstrainedVerdicts`."""
    covered: Share
    """How often the right template is in its set, of those whose path has a template."""
    mean_set: float
    """Templates in a set on average."""
    late: Late


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannerGroup:
    """How good the networks together are, and the planner that asks them."""

    name: str
    size: int
    named: Share
    late: Late


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateMiss:
    """A gap above `WORTH`, and why."""

    gap: float
    """Relative."""
    late: float
    """[R/V_P]"""
    situation: tuple[float, ...]
    """x, y [R], h [rad], α, D/R, d_min/R."""
    fastest: str
    """The template missed."""
    share: float
    """That the network gives it."""
    answered: str
    """The template given."""
    reason: GapReason


@dataclass(frozen=True, slots=True, kw_only=True)
class TemplateAudit:
    """All that is found."""

    groups: tuple[TemplateGroup, ...]
    """By source, and all of them."""
    templates: tuple[TemplateGroup, ...]
    """By the template of the fastest path: the commonest, and the rest."""
    everywhere: tuple[PlannerGroup, ...]
    """Where the limit does not bind, where it does, and both."""
    doubts: tuple[Doubt, ...]
    """Those in which the limit binds by how sure the network is, those it is surest of first."""
    misses: tuple[TemplateMiss, ...]
    """Gaps above `WORTH`, the largest first, `LISTED` at most."""
    reasons: Mapping[GapReason, int]
    """How many there are of each reason, of all."""
    worth: Share
    """How many answers have such a gap."""


def template_audit_of(chunks: Mapping[int, TemplateVerdicts]) -> TemplateAudit:
    """Sum up an audit's chunks, by their number."""
    whole = join_template_verdicts(chunks)
    bound, everywhere = whole.bound, whole.everywhere
    every = np.ones(len(bound), dtype=bool)
    groups = [_group(name, bound, bound.sources == n) for n, name in enumerate(SOURCES)]
    counts = np.bincount(bound.templates, minlength=len(TEMPLATES))
    order = np.argsort(-counts, kind="stable")
    common = [int(template) for template in order[:COMMONEST] if counts[template] > 0]
    rest = ~np.isin(bound.templates, common)
    templates = [
        _group(TEMPLATES[template], bound, bound.templates == template) for template in common
    ]
    if rest.any():
        others = len(np.unique(bound.templates[rest]))
        templates.append(_group(f"{others} others", bound, rest))
    # an answer where there is no path has no gap, and is counted by itself
    gap = _gaps(bound.exact, bound.given)
    slow = np.flatnonzero((gap > WORTH) & (gap < inf))
    reasons = _reasons(bound, slow)
    return TemplateAudit(
        groups=(*groups, _group("all", bound, every)),
        templates=tuple(templates),
        everywhere=tuple(
            _planner_group(name, everywhere, chosen)
            for name, chosen in (
                ("it does not bind", ~everywhere.binds),
                ("it binds", everywhere.binds),
                ("all situations", np.ones(len(everywhere), dtype=bool)),
            )
        ),
        doubts=doubts_of(bound.doubt, bound.named),
        misses=_misses(bound, gap, slow, reasons),
        reasons={reason: int((reasons == n).sum()) for n, reason in enumerate(REASONS)},
        worth=Share(hits=len(slow), of=int((gap < inf).sum())),
    )


def _gaps(exact: Floats, given: Floats) -> Floats:
    """How much longer answers take, relative; infinite where there is none, or no path at all."""
    both = (exact < inf) & (given < inf)
    gap = np.full(len(exact), inf)
    gap[both] = np.maximum(given[both] / exact[both] - 1.0, 0.0)
    gap[gap < ROUNDING] = 0.0
    return gap


def _count_late(exact: Floats, given: Floats) -> Late:
    gap = _gaps(exact, given)
    measured = gap[gap < inf]
    answered = given < inf
    there = exact < inf
    both = answered & there
    delay = given[both] - exact[both]
    percentiles = np.percentile(measured, PERCENTILES) if len(measured) else np.zeros(4)
    return Late(
        answered=Share(hits=int(both.sum()), of=int(there.sum())),
        gaps=tuple(percentiles.tolist()),
        late=Share(hits=int((delay * UNIT > LATE).sum()), of=len(delay)),
        sooner=int((delay < -WITHIN).sum()),
        invented=Share(hits=int((answered & ~there).sum()), of=int((~there).sum())),
    )


def _group(name: str, bound: ConstrainedVerdicts, chosen: NDArray[np.bool_]) -> TemplateGroup:
    templates = bound.templates[chosen]
    of_a_kind = (templates != SEVERAL) & (templates != NONE)
    size = int(chosen.sum())
    return TemplateGroup(
        name=name,
        size=size,
        named=Share(hits=int(bound.named[chosen].sum()), of=size),
        covered=Share(hits=int(bound.inside[chosen][of_a_kind].sum()), of=int(of_a_kind.sum())),
        mean_set=float(bound.held[chosen].mean()) if size else 0.0,
        late=_count_late(bound.exact[chosen], bound.given[chosen]),
    )


def _planner_group(
    name: str, everywhere: PlannerVerdicts, chosen: NDArray[np.bool_]
) -> PlannerGroup:
    size = int(chosen.sum())
    return PlannerGroup(
        name=name,
        size=size,
        named=Share(hits=int(everywhere.named[chosen].sum()), of=size),
        late=_count_late(everywhere.exact[chosen], everywhere.given[chosen]),
    )


def _reasons(bound: ConstrainedVerdicts, slow: NDArray[np.intp]) -> NDArray[np.int8]:
    """Why, of each of some rows: numbers of `REASONS`."""
    templates, inside = bound.templates[slow], bound.inside[slow]
    none = (templates == SEVERAL) | (templates == NONE)
    return np.where(none, 2, np.where(inside, 1, 0)).astype(np.int8)


def _misses(
    bound: ConstrainedVerdicts, gap: Floats, slow: NDArray[np.intp], reasons: NDArray[np.int8]
) -> tuple[TemplateMiss, ...]:
    largest = np.argsort(-gap[slow], kind="stable")[:LISTED]
    return tuple(
        TemplateMiss(
            gap=float(gap[row]),
            late=float(bound.given[row] - bound.exact[row]),
            situation=tuple(bound.situations[row].tolist()),
            fastest=TEMPLATES[bound.templates[row]],
            share=float(bound.own[row]),
            answered=TEMPLATES[bound.answered[row]],
            reason=REASONS[reasons[at]],
        )
        for at, row in zip(largest.tolist(), slow[largest].tolist(), strict=True)
    )


def template_audit_as_json(audit: TemplateAudit) -> dict[str, Any]:
    """An audit as it is printed."""
    return {
        "groups": {group.name: _group_as_json(group) for group in audit.groups},
        "templates": {group.name: _group_as_json(group) for group in audit.templates},
        "everywhere": {
            group.name: {
                "situations": group.size,
                "named": share_as_json(group.named),
                **_late_as_json(group.late),
            }
            for group in audit.everywhere
        },
        "doubts": [
            {"said": doubt.said, "wrong": share_as_json(doubt.wrong)} for doubt in audit.doubts
        ],
        "gaps_above_0.1_percent": share_as_json(audit.worth),
        "reasons": dict(audit.reasons),
        "largest_gaps": [_miss_as_json(miss) for miss in audit.misses],
    }


def _group_as_json(group: TemplateGroup) -> dict[str, Any]:
    return {
        "situations": group.size,
        "named": share_as_json(group.named),
        "template_in_set": share_as_json(group.covered),
        "mean_set": group.mean_set,
        **_late_as_json(group.late),
    }


def _late_as_json(late: Late) -> dict[str, Any]:
    return {
        "answered": share_as_json(late.answered),
        "gap_percent": {
            "max" if percentile == 100.0 else f"p{percentile:g}": 100.0 * gap
            for percentile, gap in zip(PERCENTILES, late.gaps, strict=True)
        },
        "later_than_0.1_s": share_as_json(late.late),
        "sooner_than_the_search": late.sooner,
        "answered_without_a_path": share_as_json(late.invented),
    }


def _miss_as_json(miss: TemplateMiss) -> dict[str, Any]:
    names = ("x_r", "y_r", "h_rad", "speed_ratio", "slot_r", "limit_r")
    return {
        "gap_percent": 100.0 * miss.gap,
        "late_r_per_v": miss.late,
        "situation": dict(zip(names, miss.situation, strict=True)),
        "fastest": miss.fastest,
        "share": miss.share,
        "answered": miss.answered,
        "reason": miss.reason,
    }

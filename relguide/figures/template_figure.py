"""draw_template_audit(…): the picture of an audit where the limit binds: accuracy, calibration."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from relguide.figures.area_figure import FAINT, INK
from relguide.figures.panels import (
    COLOURS,
    MARKS,
    PERCENT,
    rates_over,
    shares_across,
    two_panels,
    write_figures,
)
from relguide.learn.audits.template_audit import TemplateAudit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FILE = "network_templates.svg"
"""Its name."""
RAREST, SUREST = 1e-3, 100.0
"""Ends of the axes of the calibration [%]."""


def draw_template_audit(audit: TemplateAudit, folder: Path) -> list[Path]:
    """Draw an audit.

    Args:
        audit: of the networks.
        folder: where to; it must exist.

    Returns:
        the file written.
    """
    return write_figures({FILE: partial(_draw_naming, audit)}, folder)


def _draw_naming(audit: TemplateAudit) -> "Figure":
    """How often the first choice is right, and whether it is as often wrong as it says."""
    figure, (left, right) = two_panels("Where the limit binds: the template network")
    groups = [
        *((group.name, group.named) for group in audit.everywhere),
        *((group.name, group.named) for group in audit.groups),
        *((group.name, group.named) for group in audit.templates),
    ]
    breaks = len(audit.everywhere), len(audit.everywhere) + len(audit.groups)
    at = [-float(i + sum(i >= line for line in breaks)) for i in range(len(groups))]
    shares_across(left, [named for _, named in groups], at, COLOURS[0], MARKS[0])
    left.set_yticks(at, [name for name, _ in groups], fontsize=8)
    for k, line in enumerate(breaks):
        left.axhline(-float(line + k), color=FAINT, lw=0.6)
    left.set_title("all situations; where the limit binds; by template", color=INK, fontsize=10)
    left.set_xlabel("first choice right [%], with 95 % interval", color=INK)
    left.set_xlim(None, 100.3)
    said = [max(PERCENT * doubt.said, RAREST) for doubt in audit.doubts]
    right.plot([RAREST, SUREST], [RAREST, SUREST], color=FAINT, lw=0.9, label="as often as it says")
    rates_over(right, said, [doubt.wrong for doubt in audit.doubts], "is wrong")
    for scale in (right.set_xscale, right.set_yscale):
        scale("log")
    right.set_xlim(0.7 * RAREST, 1.4 * SUREST)
    right.set_ylim(0.7 * RAREST, 1.4 * SUREST)
    right.set_xlabel("says it is wrong: 1 − highest share [%]", color=INK)
    right.set_ylabel("is wrong [%], 95 % interval", color=INK)
    right.set_title("calibration, where the limit binds", color=INK, fontsize=10)
    right.legend(fontsize=8)
    return figure

"""What validation adds to a path, and what conformance allows: one table, so that they agree.

An accepted clearance stays valid as long as no aircraft leaves what these allow. The minima are of
radar separation; the thresholds are ours, as no standard gives any.
"""

from dataclasses import dataclass

from relguide.units import DEG, FT, KT, NM, Metre, MetrePerSecond, Radian, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class Threshold:
    """From when on a deviation counts; it counts no more below `CLEARS` of that."""

    caution: float
    """The clearance is validated again at once, and after `shown_after` it is shown."""
    alert: float
    """Both crews and the controller are alerted."""


CLEARS = 0.8
"""A deviation is over below this share of its threshold."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AtcSettings:
    """The controller's minima, bounds and times."""

    minimum: Metre = 5.0 * NM
    """Horizontal separation from all but the leader, which has the clearance's own d_min."""
    vertical_minimum: Metre = 1_000.0 * FT
    """Vertical separation: where it is certain, the horizontal one does not count."""
    level_buffer: Metre = 300.0 * FT
    """Beside a level that is flown; it is the alert of conformance."""
    climb_buffer: Metre = 1_500.0 * FT
    """Beside a climb or a descent whose bounds are not declared."""
    across: Threshold = Threshold(caution=0.25 * NM, alert=1.0 * NM)
    """Beside the cleared path [m]."""
    along: Threshold = Threshold(caution=5.0, alert=15.0)
    """Before or behind it [s]."""
    spacing: Threshold = Threshold(caution=0.3 * NM, alert=0.6 * NM)
    """From D, once joined [m]."""
    spacing_time: Threshold = Threshold(caution=5.0, alert=10.0)
    """From the time behind the leader, once joined [s]."""
    level: Threshold = Threshold(caution=200.0 * FT, alert=300.0 * FT)
    """From the cleared level [m]."""
    turn: Threshold = Threshold(caution=5.0, alert=15.0)
    """How late a turn begins [s]; a turn to the wrong side is an alert at once."""
    shown_after: Second = 10.0
    """A caution that lasts so long is shown."""
    back_within: Second = 30.0
    """Who deviates so long is no longer cleared."""
    traffic_bound: Metre = 0.25 * NM
    """Where others may be beside their track at first …"""
    traffic_growth: MetrePerSecond = 0.1 * NM / 60.0
    """… and how fast that grows, where their intent is known."""
    fan: Radian = 30.0 * DEG
    """Others whose intent is not known may turn by so much to either side."""
    horizon: Second = 1_200.0
    """How far ahead is looked at most …"""
    followed: Second = 120.0
    """… and how long beyond joining."""
    stale: Second = 10.0
    """A picture older than this validates nothing."""
    answer_within: Second = 60.0
    """A request that is not answered so long expires."""
    standby_within: Second = 120.0
    """… and one that was told to stand by."""
    valid_for: Second = 30.0
    """An accepted clearance that is not begun expires."""
    leader_place: Metre = 30.0
    """The leader's filed intent is that planned on within this, …"""
    leader_heading: Radian = 1.0 * DEG
    """… this …"""
    leader_speed: MetrePerSecond = 2.0 * KT
    """… and this."""
    revalidated_every: Second = 10.0
    """How often what is accepted or flown is validated again."""

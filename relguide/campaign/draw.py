"""draw_flight(campaign, n): one flight of a campaign, from its number alone.

Flight n is number n // points at point n % points. The same number begins alike at all points of a
family, so their differences are those of what is swept.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from relguide.campaign.campaign_file import DERIVED, Campaign, Derived, Point
from relguide.campaign.case import Case
from relguide.campaign.families import draw, stream
from relguide.campaign.keys import KEYS


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawnFlight:
    """A flight that can be flown."""

    flight: int
    """Its number among all."""
    point: Point
    values: Mapping[str, float]
    """What was drawn and swept, by key."""
    case: Case


def draw_flight(campaign: Campaign, flight: int) -> DrawnFlight:
    """A flight of a campaign.

    Raises:
        ValueError: if there is none of this number, or what was drawn cannot be flown.
    """
    if not 0 <= flight < campaign.total:
        last = campaign.total - 1
        raise ValueError(f"{campaign.name} has the flights 0 to {last:,}, and no {flight}.")
    number, at = divmod(flight, len(campaign.points))
    point = campaign.points[at]
    kind = DERIVED.get(point.family, Derived((point.family,), {}))
    base = kind.base(number)
    case = draw(base, number, campaign.seed)
    scenario = replace(case.scenario, name=point.family, title=f"{campaign.name} {flight}")
    noise = int(stream(base, number, campaign.seed, "noise").integers(2**32))
    case = replace(
        case,
        family=point.family,
        scenario=scenario,
        noise_seed=noise,
        guidance=campaign.guidance,
        crew=campaign.crew,
    )
    drawn = {**kind.vary, **campaign.vary}
    values: dict[str, float] = {}
    for name, key in KEYS.items():
        if name not in point.values and name not in drawn:
            continue
        rng = stream(base, number, campaign.seed, name)
        if name in point.values:
            values[name] = point.values[name]
        else:
            values[name] = drawn[name].draw(rng, key.limits)
        # what a value leaves open is the same for all values that are swept
        left_open = stream(base, number, campaign.seed, f"{name}, open")
        case = key.set(case, values[name], left_open)
    return DrawnFlight(flight=flight, point=point, values=values, case=_limited(campaign, case))


def _limited(campaign: Campaign, case: Case) -> Case:
    limit, following = campaign.limit, campaign.after_joining
    scenario = case.scenario
    if limit is not None:
        scenario = replace(scenario, duration_limit=limit)
    if following is not None:
        scenario = replace(scenario, after_joining=following)
    return replace(case, scenario=scenario)

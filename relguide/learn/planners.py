"""The planners that have a name: what the command line, REST and the settings of a service offer.

A planner of one's own needs no entry: it is passed to `fly`, and its plans carry its name.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from relguide.planning.outcome import Planner


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedPlanner:
    """A planner as it is chosen, and how to make it."""

    name: str
    """What its plans call it."""
    description: str
    """Which words it solves, in the order of the table."""
    serves: bool
    """Whether it is fast enough to serve with from its first plan on."""
    make: Callable[[], "Planner"]
    """Loads what it needs."""


def make_planner(name: str) -> "Planner":
    """The planner of that name.

    Raises:
        ValueError: if there is no planner of that name.
    """
    if name not in PLANNERS:
        raise ValueError(f"The planner must be {' or '.join(PLANNERS)}, not {name!r}.")
    return PLANNERS[name].make()


def _exact() -> "Planner":
    from relguide.planning.plan import plan

    return plan


def _network() -> "Planner":
    from relguide.learn.network_planner import network_planner
    from relguide.learn.words.branch_network import load_network

    return network_planner(load_network())


def _regular() -> "Planner":
    from relguide.learn.tree.regular_planner import regular_planner

    return regular_planner


PLANNERS: Mapping[str, NamedPlanner] = {
    planner.name: planner
    for planner in (
        NamedPlanner(
            name="exact",
            description="all words are solved",
            serves=True,
            make=_exact,
        ),
        NamedPlanner(
            name="network",
            description="a network picks those to solve",
            serves=True,
            make=_network,
        ),
        NamedPlanner(
            name="regular_dp",
            description="the paper's tree picks them",
            serves=False,
            make=_regular,
        ),
    )
}
"""All of them, by name."""
SERVING = tuple(name for name, planner in PLANNERS.items() if planner.serves)
"""Those that a service may be started with."""

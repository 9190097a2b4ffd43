"""What `relguide fly` reads beside a flight: orders, a recording to fly again, a crew's script."""

from typing import TYPE_CHECKING, NamedTuple

from relguide.cli.situation_file import open_input

if TYPE_CHECKING:
    from relguide.contract.orders import Order
    from relguide.flying.engagement import Engagement
    from relguide.flying.scripted_crew import CrewOrder


class Ordered(NamedTuple):
    """What is ordered in a flight, and how it begins."""

    orders: "tuple[Order, ...]"
    script: "tuple[CrewOrder, ...]"
    engagement: "Engagement"
    seed: int
    recorded: str = ""
    """The name of what a recording that gives the orders has flown; empty for other orders."""
    by_pilot: bool = False
    """Whether a modelled pilot flew that by hand."""


def read_ordered(flown: str, orders: str | None, crew: str | None, seed: int | None) -> Ordered:
    """Read what is ordered.

    Args:
        flown: the flight; -, as of the others, is standard input.
        orders: a file of orders, or a recording, whose seed and engagement are taken.
        crew: a crew's script.
        seed: as it was asked for.

    Raises:
        ValueError: naming the first line that is no order, and what would be right.
    """
    from relguide.contract.orders import flown_again, read_crew, read_orders
    from relguide.contract.recorder import is_recording, replay
    from relguide.flying.scripted_crew import begun

    _expect_one_standard_input({"situation": flown, "orders": orders, "crew": crew})
    ordered = Ordered((), (), "engaged", seed or 0)
    if orders is not None:
        if orders.endswith((".jsonl", ".jsonl.gz")) and is_recording(orders):
            again = flown_again(replay(orders))
            taken = again.seed if seed is None else seed
            began = again.engagement
            ordered = Ordered(again.orders, (), began, taken, again.scenario, again.by_pilot)
        else:
            with open_input(orders) as stream:
                ordered = ordered._replace(orders=read_orders(stream, _name(orders)))
    if crew is not None:
        with open_input(crew) as stream:
            engagement, script = begun(read_crew(stream, _name(crew)))
        ordered = ordered._replace(script=script, engagement=engagement)
    return ordered


def _expect_one_standard_input(files: dict[str, str | None]) -> None:
    named = [what for what, file in files.items() if file == "-"]
    if len(named) > 1:
        raise ValueError(f"Standard input can be the {named[0]} or the {named[1]}, not both.")


def _name(file: str) -> str:
    return "standard input" if file == "-" else file

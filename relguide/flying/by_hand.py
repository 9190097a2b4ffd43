"""The crew has control: the autopilot's switch, the stick, and the flight director's bars."""

from collections.abc import Iterator, Sequence

from relguide.flying.aircraft_documents import Bars
from relguide.flying.documents import ControlChanged, Document
from relguide.flying.engagement import autopilot_refusal
from relguide.flying.fleet import Fleet
from relguide.flying.guidance.announcements import (
    Alerted,
    Event,
    NewPlan,
    NewPromise,
    ProposedPlan,
)
from relguide.flying.orders import SetAutopilot, SetDirector, Stick
from relguide.flying.pursuit import Pursuit
from relguide.flying.world import Guided
from relguide.units import Second

Order = SetAutopilot | SetDirector | Stick
"""What a crew does with its hands."""


def obey_hands(one: Pursuit, order: Order, fleet: Fleet, t: Second) -> Iterator[Document]:
    """Move the stick, take control or give it back, switch the bars; and say what became of it."""
    match order:
        case Stick() if fleet.has_pilot(one.pursuer) and not one.autopilot:
            yield _said(one, t, "A modelled pilot flies: it alone moves the stick.")
        case Stick(roll=roll, pitch=pitch):
            if not one.autopilot:
                fleet.move_stick(one.pursuer, roll, pitch)
            elif roll != 0.0 or pitch != 0.0:
                yield _said(one, t, "The autopilot flies: take control to fly by hand.")
        case SetAutopilot(on=on):
            bank = fleet.body(one.pursuer).bank
            why = autopilot_refusal(on=one.autopilot, to=on, bank=bank)
            if not why:
                one.autopilot = on
                if on:
                    fleet.give_back(one.pursuer)
                else:
                    fleet.take_stick(one.pursuer)
            yield _said(one, t, why or ("The autopilot flies." if on else "You have control."))
        case SetDirector(on=False) if fleet.has_pilot(one.pursuer):
            yield _said(one, t, "A modelled pilot needs the bars: they stay on.")
        case SetDirector(on=on):
            one.director = on
            yield _said(one, t, f"The flight director is {'on' if on else 'off'}.")


def mind_reaction(one: Pursuit, fleet: Fleet, events: Sequence[Event], t: Second) -> None:
    """A pilot that is modelled takes a while to answer what was announced."""
    pilot = fleet.world.aircraft[one.pursuer].pilot
    if isinstance(pilot, Guided) and pilot.by_hand is not None and any(map(is_announced, events)):
        fleet.react(one.pursuer, t, pilot.by_hand.reaction)


def is_announced(event: Event) -> bool:
    """Whether a crew hears of an event, and has to look: not of an alert that is over."""
    match event:
        case Alerted(cleared=cleared):
            return not cleared
        case NewPlan(announced=announced):
            return announced
        case ProposedPlan() | NewPromise():
            return False
        case _:
            return True


def bars_in_view(one: Pursuit) -> bool:
    """Whether the bars are shown: the flight director is on, and guidance commands."""
    return one.director and one.memory.engagement != "off"


def bars_of(one: Pursuit, fleet: Fleet, k: int | None) -> tuple[Bars, ...]:
    """The bars at a step of the last second, or now; none where they are out of view."""
    if not bars_in_view(one):
        return ()
    i = one.pursuer
    bank, roll = fleet.commanded_bank(i, k)
    climb = fleet.commanded_climb(i)
    pitch = (climb - fleet.climb(i)) / fleet.body(i).tas
    return (Bars(roll=roll, pitch=pitch, commanded_bank=bank, commanded_climb=climb),)


def _said(one: Pursuit, t: Second, message: str) -> ControlChanged:
    return ControlChanged(
        t=t,
        ident=one.names.pursuer,
        autopilot=one.autopilot,
        director=one.director,
        message=message,
    )

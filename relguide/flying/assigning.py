"""The crew changes in flight what its guidance is to do: D, d_min, the bank of plans, the speed."""

from collections.abc import Iterator
from dataclasses import replace

from relguide.flying.documents import AssignmentChanged
from relguide.flying.fleet import Fleet
from relguide.flying.guidance.stand_by import plan_anew
from relguide.flying.orders import PursuerBank, PursuerSpeed, SetSpacing
from relguide.flying.pursuit import Pursuit
from relguide.kernels.flight.flight_records import Control
from relguide.planning.limits import CLEARANCE, too_close_a_slot
from relguide.units import DEG, KT, NM, Second

Order = PursuerBank | PursuerSpeed | SetSpacing
"""What a crew asks of its guidance."""


def obey_assignment(
    one: Pursuit, order: Order, fleet: Fleet, t: Second
) -> Iterator[AssignmentChanged]:
    """Do what the crew asks, or say why not; a path that is flown or proposed is planned anew."""
    asked, why = one.assignment, ""
    match order:
        case PursuerBank(bank=bank):
            most = asked.max_bank
            if bank > most:
                why = f"The autopilot banks {most / DEG:.0f}° at most: select no more."
            else:
                one.assignment = replace(asked, asked_bank=bank)
                said = f"Plans turn with {bank / DEG:.0f}° of bank."
        case SetSpacing(slot_distance=slot_distance, min_separation=min_separation):
            slot_distance = slot_distance or asked.slot_distance
            min_separation = min_separation or asked.min_separation
            if not CLEARANCE.admits(slot_distance - min_separation):
                why = f"D {too_close_a_slot(slot_distance, min_separation)}"
            else:
                one.assignment = replace(
                    asked, slot_distance=slot_distance, min_separation=min_separation
                )
                said = f"D is {slot_distance / NM:.1f} NM, d_min {min_separation / NM:.1f} NM."
        case PursuerSpeed(tas=tas):
            limits = fleet.believed(one.pursuer)
            if tas and not limits.min_tas <= tas <= limits.max_tas:
                low, high = limits.min_tas / KT, limits.max_tas / KT
                why = f"The aircraft flies {low:.0f} to {high:.0f} kt here: select such a speed."
            else:
                one.selected_tas = tas
                said = f"Selected speed {tas / KT:.0f} kt." if tas else "Guidance sets the speed."
    if not why:
        one.memory = plan_anew(one.memory)
    yield AssignmentChanged(
        t=t,
        ident=one.names.pursuer,
        slot_distance=one.assignment.slot_distance,
        min_separation=one.assignment.min_separation,
        max_bank=one.assignment.asked_bank,
        selected_tas=(one.selected_tas,) if one.selected_tas else (),
        message=why or said,
    )


def with_selected_speed(one: Pursuit, control: Control) -> Control:
    """What guidance asks, at the speed that the crew has selected."""
    return control._replace(tas=one.selected_tas) if one.selected_tas else control

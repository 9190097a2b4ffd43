"""What a command does to a flight, and which commands it refuses."""

from math import radians

from relguide.contract.commands import (
    Command,
    IntentKnownCommand,
    LeaderDataCommand,
    LeaderHeadingCommand,
    LeaderLevelCommand,
    LeaderReportCommand,
    LeaderSpeedCommand,
    PauseCommand,
    PlayCommand,
    PursuerBankCommand,
    PursuerHeadingCommand,
    PursuerSpeedCommand,
    SetAutopilotCommand,
    SetDirectorCommand,
    SetEngagementCommand,
    SetRateCommand,
    SetSpacingCommand,
    StickCommand,
)
from relguide.contract.compass import heading_of
from relguide.contract.refusal import ContractError
from relguide.flying.aircraft_documents import GuidanceSample, find_by_ident
from relguide.flying.engagement import autopilot_refusal, refusal
from relguide.flying.orders import Command as Order
from relguide.flying.orders import (
    IntentKnown,
    LeaderData,
    LeaderHeading,
    LeaderLevel,
    LeaderSpeed,
    PursuerBank,
    PursuerHeading,
    PursuerSpeed,
    SetAutopilot,
    SetDirector,
    SetEngagement,
    SetSpacing,
    Stick,
    order_fault,
)
from relguide_server.flights.control import HELD, MODELLED, MOST_RATE, TOO_FAST
from relguide_server.flights.live_flight import LiveFlight
from relguide_server.flights.reported_leader import BY_ITS_CLOCK
from relguide_server.http.errors import Refusal, refusal_of


def give_command(flight: LiveFlight, command: Command) -> None:
    """Pass a command on to a flight.

    Raises:
        Refusal: 409, if the flight may not be told that now; 422, if it names no aircraft of it.
    """
    if flight.label.reported_leader and isinstance(command, PauseCommand | SetRateCommand):
        raise Refusal(409, BY_ITS_CLOCK)
    match command:
        case PlayCommand():
            flight.pace.play()
        case PauseCommand():
            flight.pace.pause()
        case SetRateCommand(rate=rate):
            if flight.control.taken and rate > MOST_RATE:
                raise Refusal(409, TOO_FAST.format(rate=rate))
            flight.pace.set_rate(rate)
        case LeaderHeadingCommand():
            _order(flight, _leader_heading(command))
        case LeaderSpeedCommand(tas_mps=tas, ident=ident):
            _order(flight, LeaderSpeed(tas=tas, ident=ident))
        case LeaderLevelCommand(altitude_m=altitude, rate_mps=rate, ident=ident):
            _order(flight, LeaderLevel(altitude=altitude, rate=rate, ident=ident))
        case LeaderReportCommand(ident=ident):
            _order(flight, command.order(ident))
        case IntentKnownCommand(known=known, ident=ident):
            _order(flight, IntentKnown(known=known, ident=ident))
        case LeaderDataCommand(received=received, ident=ident):
            _order(flight, LeaderData(received=received, ident=ident))
        case PursuerHeadingCommand(heading_deg=heading, ident=ident):
            _order_heading(flight, PursuerHeading(heading=heading_of(heading), ident=ident))
        case SetEngagementCommand(engagement=engagement, ident=ident):
            _order_engagement(flight, SetEngagement(engagement=engagement, ident=ident))
        case PursuerBankCommand(bank_deg=bank, ident=ident):
            _order(flight, PursuerBank(bank=radians(bank), ident=ident))
        case PursuerSpeedCommand(tas_mps=tas, ident=ident):
            _order(flight, PursuerSpeed(tas=tas or 0.0, ident=ident))
        case SetSpacingCommand():
            _order(flight, _spacing(command))
        case SetAutopilotCommand(on=on, ident=ident):
            _order_autopilot(flight, SetAutopilot(on=on, ident=ident))
        case SetDirectorCommand(on=on, ident=ident):
            _order(flight, SetDirector(on=on, ident=ident))
        case StickCommand(roll=roll, pitch=pitch, ident=ident):
            _move_stick(flight, Stick(roll=roll, pitch=pitch, ident=ident))


def _order(flight: LiveFlight, order: Order) -> None:
    _expect_flying(flight, order)
    flight.command(order)


def _expect_flying(flight: LiveFlight, order: Order) -> None:
    """Refuse an order to an aircraft that does not fly, or cannot be given it."""
    for started in flight.history.started:
        links = [(link.pursuer, link.leader) for link in started.links]
        fault = order_fault(order, [one.ident for one in started.aircraft], links)
        if fault:
            raise refusal_of(ContractError([("ident", fault)]))


def guidance_of(flight: LiveFlight, ident: str = "") -> GuidanceSample:
    """What the guidance of a pursuer did last; that of the first link, where none is named."""
    guidance = flight.history.newest[0].guidance
    return find_by_ident(guidance, ident) if ident else guidance[0]


def _order_heading(flight: LiveFlight, order: PursuerHeading) -> None:
    _expect_flying(flight, order)
    if guidance_of(flight, order.ident).engagement == "engaged":
        raise Refusal(409, "Relative guidance flies: disconnect it to select a heading.")
    flight.command(order)


def _order_engagement(flight: LiveFlight, order: SetEngagement) -> None:
    """Refuse what may not follow the present engagement; what is proposed, guidance knows."""
    _expect_flying(flight, order)
    why = refusal(guidance_of(flight, order.ident).engagement, order.engagement, proposed=True)
    if why:
        raise Refusal(409, why)
    flight.command(order)


def _order_autopilot(flight: LiveFlight, order: SetAutopilot) -> None:
    """Refuse to take what one has, and an autopilot that cannot take over."""
    _expect_flying(flight, order)
    guidance = guidance_of(flight, order.ident)
    flown = find_by_ident(flight.history.newest[0].aircraft, guidance.ident)
    why = autopilot_refusal(on=guidance.autopilot, to=order.on, bank=flown.bank)
    if why:
        raise Refusal(409, why)
    flight.command(order)


def _move_stick(flight: LiveFlight, order: Stick) -> None:
    _expect_flying(flight, order)
    if flight.label.modelled:
        raise Refusal(409, MODELLED)
    if flight.control.taken:
        raise Refusal(409, HELD)
    if guidance_of(flight, order.ident).autopilot:
        raise Refusal(409, "The autopilot flies: take control to fly by hand.")
    flight.command(order)


def _spacing(command: SetSpacingCommand) -> SetSpacing:
    return SetSpacing(
        slot_distance=command.slot_distance_m or 0.0,
        min_separation=command.min_separation_m or 0.0,
        ident=command.ident,
    )


def _leader_heading(command: LeaderHeadingCommand) -> LeaderHeading:
    direction = command.direction or "shorter"
    heading = heading_of(command.heading_deg)
    return LeaderHeading(heading=heading, direction=direction, ident=command.ident)

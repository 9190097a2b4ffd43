"""How fast a flight could have been: the fastest plan from its start.

The plan turns with the bank that was asked for, at once, and knows all that the leader was to fly.
It keeps the speed V_P to the slot: what an aircraft loses that has to brake for it is over this.
"""

from relguide.flying.world import Declared, Guided, Link, Recorded, World
from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.intent import IntentPiece
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import Second


def optimum(world: World, link: Link) -> Second:
    """Time to converge of the fastest plan from the start of a flight [s].

    0 if there is none, or if the leader is recorded: what it will fly is no plan's to know.
    """
    own, leader = (
        world.aircraft[world.index(link.pursuer)],
        world.aircraft[world.index(link.leader)],
    )
    intent: tuple[IntentPiece, ...] = ()
    match leader.pilot:
        case Recorded():
            return 0.0
        case Declared(intent=declared):
            intent = declared
        case Guided():
            pass
    wind = world.air.wind_at(own.x, own.y, own.altitude, 0.0)
    answer = plan(
        Situation(
            pursuer=Pursuer(
                x=own.x, y=own.y, heading=wrap(own.heading), tas=own.tas, max_bank=own.max_bank
            ),
            leader=Leader(
                x=leader.x, y=leader.y, heading=wrap(leader.heading), tas=leader.tas, intent=intent
            ),
            slot_distance=link.slot_distance,
            min_separation=link.min_separation,
            wind=wind,
        )
    )
    return answer.time_to_converge if isinstance(answer, Plan) else 0.0

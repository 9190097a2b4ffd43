"""A crew that reacts: it waits for what is said of its flight, and orders what its script says."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from relguide.flying.documents import (
    Alert,
    Document,
    EngagementChanged,
    FlightStarted,
    ModeChanged,
    PlanChanged,
    PlanProposed,
    Sample,
    Unable,
)
from relguide.flying.engagement import MAY_BECOME, Engagement
from relguide.flying.orders import Command, CrewCommand, SetEngagement, no_commands
from relguide.planning.inputs import expect, expect_function, number
from relguide.planning.reprs import as_code
from relguide.units import Second

Cue = Literal[
    "start",
    "proposed",
    "designated",
    "armed",
    "engaged",
    "off",
    "new_plan",
    "converge",
    "capture",
    "follow",
    "escape",
    "unable",
    "data_lost",
    "alert",
]
"""What a crew waits for. start: of the flight; proposed: a path that it could accept; designated …
off: guidance is now engaged so far; new_plan: one that is announced; converge … escape: guidance is
now in this mode; unable: guidance cannot do what it is to do; data_lost: for want of the leader's
reports; alert: one begins."""
SLACK: Second = 1e-9
"""A step's time is a product, and may fall short of what it is meant to be."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CrewOrder:
    """What a crew orders, and when: some time after its cue.

    Examples:
        >>> turns = rg.CrewOrder(command=rg.PursuerHeading(heading=1.2), on="alert", after=5.0)
        >>> slows = rg.CrewOrder(command=rg.PursuerSpeed(tas=220.0), after=300.0)
    """

    command: CrewCommand
    on: Cue = "start"
    """Each time that this happens to the pursuer of the command."""
    after: Second = 0.0
    """How long after it [s]."""
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what no crew orders, and a cue that is unknown."""
        expect("command", self.command, *get_args(CrewCommand))
        if not isinstance(self.on, str) or self.on not in get_args(Cue):
            raise ValueError(f"on must be one of {', '.join(get_args(Cue))}, not {self.on!r}.")
        object.__setattr__(self, "after", number("after", self.after))
        if self.after < 0.0:
            raise ValueError(f"after must be 0 s or more, not {self.after:g} s.")


Commands = Callable[[Second], Iterable[Command]]
"""What a flight polls for commands."""


class ScriptedCrew:
    """The crews of one flight, by a script. What happens is watched, and answered in time.

    While an order waits for its time, its cue does not count again. What a cue leads to is ordered
    only where it can follow: a crew that reacts accepts nothing twice, and engages nothing that was
    withdrawn. An engagement that waits is forgotten when another comes first.

    Examples:
        >>> by_hand = rg.CrewOrder(command=rg.SetAutopilot(on=False))
        >>> crew = rg.ScriptedCrew([by_hand, rg.CrewOrder(command=rg.Stick(roll=0.2), after=5.0)])
        >>> flown = rg.fly(rg.scenario("fig_6b"), commands=crew.commands, sample_period=1.0)
        >>> states = (d.aircraft[0] for d in crew.follow(flown) if isinstance(d, rg.Sample))
        >>> round(next(own.bank for own in states if own.bank > 0.1), 2)  # [rad]
        0.11
    """

    def __init__(self, script: Sequence[CrewOrder]) -> None:
        """A crew that knows its script, and has seen nothing."""
        expect("script", script, list, tuple)
        self._script = tuple(script)
        for order in self._script:
            expect("An order of a crew", order, CrewOrder)
        self._first = ""
        self._engagement: dict[str, Engagement] = {}
        self._proposed: dict[str, Second] = {}
        self._cued: dict[int, Second] = {}  # number in the script → when its cue came

    def follow(self, documents: Iterable[Document]) -> Iterator[Document]:
        """Watch the documents of a flight as they pass."""
        for document in documents:
            self.watch(document)
            yield document

    def watch(self, document: Document) -> None:
        """Note what has happened."""
        match document:
            case Sample(guidance=guidance):
                self._engagement |= {one.ident: one.engagement for one in guidance}
            case FlightStarted(links=links):
                self._first = next((link.pursuer for link in links), "")
                for pursuer in {link.pursuer for link in links}:
                    self._cue(pursuer, "start", document.t)
            case PlanProposed(ident=ident, t=t):
                self._proposed[ident] = t
                if self._engagement.get(ident) != "armed":
                    self._cue(ident, "proposed", t)
            case EngagementChanged():
                self._note_engagement(document)
            case ModeChanged(ident=ident, mode=mode) if mode != "heading":
                self._cue(ident, mode, document.t)
            case PlanChanged(ident=ident, announced=True):
                self._cue(ident, "new_plan", document.t)
            case Unable(ident=ident, reason=reason):
                self._cue(ident, "unable", document.t)
                if reason == "data":
                    self._cue(ident, "data_lost", document.t)
            case Alert(ident=ident, cleared=False):
                self._cue(ident, "alert", document.t)

    def commands(self, t: Second) -> Iterator[CrewCommand]:
        """What is due at a flight time [s], in the order of the times: `fly` polls for it."""
        due = [
            (cued + self._script[n].after, n)
            for n, cued in self._cued.items()
            if cued + self._script[n].after <= t + SLACK
        ]
        for _, n in sorted(due):
            del self._cued[n]
            order = self._script[n]
            if order.on == "start" or self._can_follow(order.command):
                yield order.command

    def _cue(self, ident: str, cue: Cue, t: Second) -> None:
        for n, order in enumerate(self._script):
            if order.on == cue and self._whose(order.command) == ident:
                self._cued.setdefault(n, t)

    def _note_engagement(self, changed: EngagementChanged) -> None:
        ident, now, before, t = changed.ident, changed.engagement, changed.previous, changed.t
        if now == before:  # an order that was refused
            return
        self._engagement[ident] = now
        for n, cued in list(self._cued.items()):
            order = self._script[n]
            engages = isinstance(order.command, SetEngagement) and order.on != "start"
            if engages and cued < t and self._whose(order.command) == ident:
                del self._cued[n]
        self._cue(ident, now, t)
        if before == "armed" and now == "designated" and self._proposed.get(ident) == t:
            self._cue(ident, "proposed", t)  # offered again, in place of what was accepted

    def _can_follow(self, command: CrewCommand) -> bool:
        """Whether an engagement that is ordered may follow the present one."""
        if not isinstance(command, SetEngagement):
            return True
        now = self._engagement.get(self._whose(command))
        return now is None or command.engagement in MAY_BECOME[now]

    def _whose(self, command: CrewCommand) -> str:
        return command.ident or self._first


def begun(script: Sequence[CrewOrder]) -> tuple[Engagement, tuple[CrewOrder, ...]]:
    """How far guidance is engaged as a crew begins, and what is left of its script.

    Off, unless the first line is an engagement at 0 s: that says how the flight begins.
    """
    match script:
        case [CrewOrder(command=SetEngagement() as first, on="start", after=0.0), *rest]:
            return first.engagement, tuple(rest)
    return "off", tuple(script)


def with_crew(
    script: Sequence[CrewOrder],
    flown: Callable[..., Iterator[Document]],
    commands: Commands = no_commands,
) -> Iterator[Document]:
    """A flight in which a crew follows its script.

    Examples:
        >>> from functools import partial
        >>> engage = rg.SetEngagement(engagement="engaged")
        >>> script = [rg.CrewOrder(command=engage, on="proposed", after=10.0)]
        >>> flown = partial(rg.fly, rg.scenario("fig_6b"), rg.plan, engagement="designated")
        >>> documents = rg.with_crew(script, flown)

    Args:
        script: what it orders, and when.
        flown: `fly`, or `simulate`, with all but its commands.
        commands: what else is ordered.
    """
    crew = ScriptedCrew(script)
    expect_function("flown", flown)
    expect_function("commands", commands)
    return crew.follow(flown(commands=both(commands, crew.commands)))


def both(first: Commands, second: Commands) -> Commands:
    """What is ordered by one, and then by the other."""
    return lambda t: (*first(t), *second(t))

"""What time and flights do to clearances, once a second: due ones end, begun ones are watched."""

import asyncio
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial

from relguide.atc import life
from relguide.atc.conformance import shown, still_covers, watch
from relguide.atc.documents import ConformanceChanged, Deviation, Expired, TrafficSeen
from relguide.atc.picture import Picture
from relguide.flying.documents import ForecastChanged
from relguide.planning.frames import LocalPlane
from relguide.units import Second
from relguide_server.atc.cases import Case
from relguide_server.atc.desk import Desk
from relguide_server.atc.journal import written
from relguide_server.atc.reported_leaders import ReportedLeaders
from relguide_server.atc.reports import Reports
from relguide_server.atc.skies import EARTH
from relguide_server.atc.traffic_seen import places_of, traffic_seen
from relguide_server.flights.live_flight import LiveFlight
from relguide_server.http.errors import Refusal, run_logged

PERIOD: Second = 1.0
"""How often time passes."""
GONE = "The flight is over."
MOVED = (
    "The flight is no longer flown by the clock that this was cleared in, as its rate was changed "
    "or it was paused. Ask for another clearance."
)
DISCONNECTED = "The crew has disconnected guidance."


class Watching:
    """Passes time to the desk. Lives on the event loop, from `start` to `stop`."""

    def __init__(self, desk: Desk, reports: Reports, leaders: ReportedLeaders) -> None:
        self._desk, self._reports, self._leaders = desk, reports, leaders
        self._shown: dict[str, Second] = {}
        """When the traffic of a sky was sent last, in its own time."""
        self._task: asyncio.Task[None] | None = None

    def start(self) -> None:
        """Begin."""
        self._task = asyncio.create_task(self._run())

    async def stop(self) -> None:
        """End."""
        if self._task is not None:
            self._task.cancel()
            with suppress(asyncio.CancelledError):
                await self._task

    async def _run(self) -> None:
        loop = asyncio.get_running_loop()
        due = loop.time()
        while True:
            await self._desk.skies.prepare(EARTH)
            run_logged("A second of the desk", self.pass_second)
            due = max(due + PERIOD, loop.time())
            await asyncio.sleep(due - loop.time())

    def pass_second(self) -> None:
        """All that a second brings."""
        desk = self._desk
        self._leaders.pass_second()
        desk.skies.look(keep_earth=bool(desk.cases.living(EARTH)))
        for case in desk.cases.living():
            self._pass(case)
        skies = list(desk.skies.each()) if desk.journal.clients else []
        for gone in set(desk.traffic) - set(skies):
            del desk.traffic[gone]
            self._shown.pop(gone, None)
        for sky in skies:
            self._show(sky)

    # -- clearances -------------------------------------------------------------------------------

    def _pass(self, case: Case) -> None:
        desk = self._desk
        now, at = desk.now(case), desk.at()
        passed = life.tick(case.clearance, now, at)
        if passed is not case.clearance:
            desk.take(case, passed)
            if case.state == "expired":
                message = case.clearance.history[-1].message
                desk.say(Expired(t=now, id=case.clearance.id, message=message), case)
            return
        if case.clearance.flight_id:
            self._follow_flight(case, now, at)
        elif case.state == "wilco":
            desk.take(case, life.begin(case.clearance, now=now, at=at))
        if case.state in ("flying", "deviated"):
            self._watch(case, now, at)
        if case.state == "flying" and now >= self._end(case):
            desk.take(case, life.finish(case.clearance, now=now, at=at))
        if case.lives and abs(now - case.checked) >= desk.rules.revalidated_every:
            desk.spawn(desk.check(case))

    def _end(self, case: Case) -> Second:
        """When a clearance is flown: some time behind its leader, or where its path ends."""
        joined = case.clearance.request.joins if case.joined is None else case.joined
        if case.joined is None and case.clearance.flight_id:
            return case.clearance.request.path.end
        return min(joined + self._desk.rules.followed, case.clearance.request.path.end)

    def _follow_flight(self, case: Case, now: Second, at: str) -> None:
        """What the flight of a clearance does to it."""
        desk, was = self._desk, case.clearance
        flight = desk.skies.flight(was.flight_id)
        if flight is None:
            self._give_up(case, GONE, now, at)
            return
        flight.note_seen()  # it makes no room for others while its clearance lives
        if desk.skies.of(flight) != was.sky:
            self._give_up(case, MOVED, now, at)
            return
        news = desk.skies.news(flight, desk.skies.link(flight, case.pursuer))
        assert news is not None
        if news.guidance.joined and news.engaged:
            case.joined = now if case.joined is None else case.joined
        else:
            case.joined = None
        if case.state == "wilco" and news.engaged:
            desk.take(case, life.begin(was, now=now, at=at))
        elif case.state in ("flying", "deviated") and not news.engaged:
            self._give_up(case, DISCONNECTED, now, at)
        if news.engaged and case.joined is None and case.state in ("flying", "deviated"):
            self._compare(case, flight, news.forecast)

    def _give_up(self, case: Case, why: str, now: Second, at: str) -> None:
        """Nobody flies it any more: that is as if its crew had withdrawn."""
        if case.joined is not None and case.state == "flying":
            self._desk.take(case, life.finish(case.clearance, why, now=now, at=at))
        else:
            self._desk.take(case, life.cancel(case.clearance, "crew", why, now=now, at=at))

    def _compare(self, case: Case, flight: LiveFlight, ahead: ForecastChanged | None) -> None:
        """Ask anew where a new plan is not what was cleared."""
        desk = self._desk
        if ahead is None or ahead is case.looked_at:
            return
        case.looked_at = ahead
        try:
            new = desk.skies.manoeuvre(flight, desk.skies.link(flight, case.pursuer))
        except Refusal:
            return  # it flies no plan just now: what it deviates in is watched
        same = new.leader == case.clearance.request.leader
        if not same or not still_covers(case.clearance.request, new.path, desk.rules):
            desk.ask_again(case, new)

    def _watch(self, case: Case, now: Second, at: str) -> None:
        """Whether it flies what it is cleared to fly."""
        desk, request = self._desk, case.clearance.request
        picture = self._picture(case.clearance.sky)
        own, leader = picture.find(request.ident), picture.find(request.leader)
        if own is None or own.t < now - desk.rules.stale:
            return  # nobody reports it
        case.memory, deviations = watch(case.memory, own, request, leader, now, desk.rules)
        standing = shown(deviations, now, desk.rules)
        alerts = any(one.level == "alert" for one in standing)
        before = case.clearance.deviations
        if case.state == "flying" and alerts:
            desk.take(
                case, life.deviate(case.clearance, standing, now=now, at=at, settings=desk.rules)
            )
        elif case.state == "deviated" and not alerts:
            desk.take(case, life.back(case.clearance, standing, now=now, at=at))
        elif _levels(standing) != _levels(before):
            desk.take(case, life.note_deviations(case.clearance, standing))
        if _levels(standing) != _levels(before):
            message = " ".join(one.message for one in standing) or "As it is cleared."
            changed = ConformanceChanged(
                t=now,
                id=case.clearance.id,
                aircraft=request.ident,
                deviations=standing,
                message=message,
            )
            desk.say(changed, case)
        if deviations and abs(now - case.checked) >= PERIOD and not case.checking:
            desk.spawn(desk.check(case))  # what is off at all is validated as it flies now

    def _picture(self, sky: str) -> Picture:
        return self._desk.skies.picture(sky, self._desk.cases.cleared(sky))

    # -- traffic ----------------------------------------------------------------------------------

    def _show(self, sky: str) -> None:
        """Send the traffic of a sky, if its time has passed."""
        desk, now = self._desk, self._desk.skies.now(sky)
        if self._shown.get(sky) == now and sky in desk.traffic:
            return
        self._shown[sky] = now
        sources = {
            place.name: ("flight", place.flight.label.id) for place in desk.skies.places(sky)
        }
        if sky == EARTH:
            heard = self._reports.heard(now)
            sources = {ident: (one.source.name, "") for ident, one in heard.items()} | sources
        make = partial(
            _written, sky, desk.skies.title(sky), self._picture(sky), sources, desk.skies.plane(sky)
        )
        if sky == EARTH:
            desk.spawn(self._show_later(make))
        else:
            desk.show(sky, *make())

    async def _show_later(self, make: Callable[[], tuple[TrafficSeen, bytes]]) -> None:
        """Send what a thread writes: thousands of aircraft take a while."""
        self._desk.show(EARTH, *await asyncio.to_thread(make))


def _written(
    sky: str,
    title: str,
    picture: Picture,
    sources: Mapping[str, tuple[str, str]],
    plane: LocalPlane | None,
) -> tuple[TrafficSeen, bytes]:
    """A sky as it is seen now, and the same as it is sent."""
    seen = traffic_seen(sky, title, picture, sources)
    return seen, written(seen, None if plane is None else places_of(seen, plane))


def _levels(deviations: tuple[Deviation, ...]) -> set[tuple[str, str]]:
    return {(one.subject, one.level) for one in deviations}

"""The desk: clearances asked for, validated, answered and replied to, each change on record.

What time and flights do to them is the business of `watching`.
"""

import asyncio
import secrets
import time
from collections.abc import Callable, Coroutine
from dataclasses import replace
from typing import Annotated, Any

import orjson
from fastapi import Depends
from starlette.requests import HTTPConnection

from relguide.atc import life
from relguide.atc.cards import card_of
from relguide.atc.documents import (
    AtcDocument,
    ClearanceChanged,
    ProbeChanged,
    TrafficSeen,
)
from relguide.atc.life import Clearance
from relguide.atc.phraseology import request_text
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.contract.clearance_bodies import ClearanceAnswer, ClearanceReply
from relguide.units import Second
from relguide_server.atc.automation import Automation
from relguide_server.atc.cases import Case, Cases
from relguide_server.atc.crew_news import crew_news, is_news
from relguide_server.atc.journal import Journal, written
from relguide_server.atc.skies import Skies
from relguide_server.flights.watchers import Watchers
from relguide_server.http.errors import Refusal
from relguide_server.http.metrics import Metrics
from relguide_server.records.clock import date
from relguide_server.records.entries import ClearanceNoted
from relguide_server.records.noted_clearances import STOPPED, ended
from relguide_server.records.service import RecordsService
from relguide_server.settings import ServiceSettings

SHOWN_OVER = 50
"""Clearances that are over and still in a snapshot."""


class Desk:
    """All clearances. Lives on the event loop, from `start` to `stop`."""

    def __init__(
        self,
        skies: Skies,
        settings: ServiceSettings,
        records: RecordsService,
        metrics: Metrics,
        *,
        rules: AtcSettings | None = None,
        clock: Callable[[], float] = time.time,
    ) -> None:
        """Make it.

        Args:
            skies: who flies where.
            settings: of the service: whether automation answers.
            records: keep each change.
            metrics: count what is sent.
            rules: the controller's minima and times.
            clock: tells UTC.
        """
        self.skies, self.rules, self.cases = skies, rules or AtcSettings(), Cases()
        self.automation = Automation(skies, self.cases, self.rules)
        self.journal = Journal(self._snapshot, metrics, clock)
        self.traffic: dict[str, bytes] = {}
        """The newest of each sky, as it was written."""
        self.listeners = Watchers("", "the controllers' stream")
        self.answering = 0
        """Streams that are open of those who may answer."""
        self._settings, self._records, self._clock = settings, records, clock
        self._tasks: set[asyncio.Task[None]] = set()

    async def stop(self) -> None:
        """End what is being worked on; what is open is ended on record."""
        for task in list(self._tasks):
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        self.automation.stop()
        for case in self.cases.living():
            self._note(case, stopped=True)

    def auto_answers(self) -> bool:
        """Whether automation answers in the controller's place now."""
        match self._settings.atc_auto_answer:
            case "on" | "off" as chosen:
                return chosen == "on"
            case _:
                has_controllers = any(
                    part.strip().startswith("atc:") for part in self._settings.tokens.split(",")
                )
                return not has_controllers and self.answering == 0

    def find(self, clearance_id: str) -> Case:
        """A clearance of this run.

        Raises:
            Refusal: 404, if there is none.
        """
        case = self.cases.get(clearance_id)
        if case is None:
            raise Refusal(
                404,
                f"There is no clearance {clearance_id!r} that lives: it never existed, or is only "
                "on record. GET /api/v1/clearances lists all.",
            )
        return case

    # -- what people do ---------------------------------------------------------------------------

    def ask(
        self,
        manoeuvre: Manoeuvre,
        *,
        sky: str,
        flight_id: str = "",
        pursuer: str = "",
        request: str,
        client: str,
        owner: str,
        asked_by: str,
    ) -> Case:
        """A crew asks for a clearance: it is validated from now on.

        Args:
            manoeuvre: what it wants to fly.
            sky: in which.
            flight_id: the flight that asks; empty if it is none of this service.
            pursuer: its ident in that flight.
            request: the body that asked, JSON.
            client: who asks, for a share.
            owner: who asks, as access knows it.
            asked_by: address of the client.

        """
        now = self.skies.now(sky)
        clearance = life.ask(
            manoeuvre,
            id=secrets.token_hex(6),
            sky=sky,
            flight_id=flight_id,
            text=request_text(manoeuvre),
            auto_answer=self.auto_answers(),
            now=now,
            at=self.at(),
            settings=self.rules,
        )
        for older in self.cases.living(sky):
            same = older.clearance.request.ident == manoeuvre.ident
            if same and older.state in ("validating", "standby", "accepted"):
                self._supersede(older, clearance.id)
        case = Case(
            clearance=clearance,
            number=self.cases.next_number(),
            request=request,
            client=client,
            owner=owner,
            asked_by=asked_by,
            asked_at=self._clock(),
            plane=self.skies.plane(sky),
            pursuer=pursuer,
        )
        self.cases.add(case)
        self.publish(case)
        self.spawn(self.check(case))
        return case

    def ask_again(self, case: Case, manoeuvre: Manoeuvre) -> Case:
        """A new plan is not what was cleared: it is asked for in the place of the old one."""
        again = self.ask(
            manoeuvre,
            sky=case.clearance.sky,
            flight_id=case.clearance.flight_id,
            pursuer=case.pursuer,
            request=case.request,
            client=case.client,
            owner=case.owner,
            asked_by=case.asked_by,
        )
        if case.lives:
            self._supersede(case, again.clearance.id)
        return again

    def answer(self, case: Case, said: ClearanceAnswer) -> None:
        """The controller answers a request, or takes a clearance back.

        Raises:
            Refusal: 409, if it may not be answered so now.
        """
        now, at, was, why = self.now(case), self.at(), case.clearance, said.message
        match said.answer:
            case "cancelled":
                self._step(case, lambda: life.cancel(was, "controller", why, now=now, at=at))
            case "terminated":
                self._step(case, lambda: life.terminate(was, "controller", why, now=now, at=at))
            case "accepted" | "unable" | "standby" as to:
                self._step(
                    case,
                    lambda: life.answer(
                        was, to, "controller", said.reason, why,
                        now=now, at=at, settings=self.rules,
                    ),
                )  # fmt: skip

    async def reply(self, case: Case, said: ClearanceReply) -> None:
        """The crew replies; WILCO is validated on the present picture first.

        Raises:
            Refusal: 409, if it may not be replied so now.
        """
        found = None
        if said.reply == "WILCO" and case.state == "accepted":
            found = await self.automation.find_of(case)
        now, at = self.now(case), self.at()
        self._step(
            case,
            lambda: life.reply(
                case.clearance, said.reply, found, message=said.message, now=now, at=at
            ),
        )
        if case.state == "wilco":
            for older in self.cases.living(case.clearance.sky):
                same = older.clearance.request.ident == case.clearance.request.ident
                if same and older is not case:
                    self._supersede(older, case.clearance.id)

    # -- what the service does --------------------------------------------------------------------

    def at(self) -> str:
        """The wall clock, UTC, ISO 8601."""
        return date(self._clock())

    def now(self, case: Case) -> Second:
        """The time of a clearance's sky, which never runs back [s]."""
        return max(self.skies.now(case.clearance.sky), case.clearance.history[-1].t)

    def take(self, case: Case, clearance: Clearance) -> None:
        """A clearance is another one now: it is sent, and on record."""
        if clearance is not case.clearance:
            case.clearance = clearance
            self.publish(case)

    def publish(self, case: Case) -> None:
        """Something of a clearance is new."""
        self.skies.forget_pictures()
        changed = ClearanceChanged(t=self.now(case), clearance=card_of(case.clearance))
        case.text = written(changed, None if case.plane is None else case.plane.to_geodetic)
        self.journal.add(changed, case.text)
        self._tell_crew(case)
        self._note(case)
        self._flush_soon()

    def say(self, document: AtcDocument, case: Case) -> None:
        """Send what is new beside a clearance itself to all who listen."""
        place = None if case.plane is None else case.plane.to_geodetic
        self.journal.add(document, written(document, place))
        self._flush_soon()

    def show(self, sky: str, seen: TrafficSeen, text: bytes) -> None:
        """Send the newest traffic of a sky.

        Args:
            sky: which.
            seen: its traffic.
            text: the same as it is written.
        """
        self.traffic[sky] = text
        self.journal.add(seen, text)
        self._flush_soon()

    def spawn(self, work: Coroutine[Any, Any, None]) -> None:
        """Do some work beside."""
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def check(self, case: Case) -> None:
        """Validate again what lives; a verdict that is another is said."""
        if case.checking:
            return
        case.checking = True
        try:
            found = await self.automation.find_of(case)
        finally:
            case.checking = False
        if not case.lives:
            return
        before, state = case.clearance.validation, case.state
        case.clearance = self._advised(life.note_validation(case.clearance, found))
        another = before is None or before.verdict != found.verdict
        if another and before is not None:
            probed = ProbeChanged(t=self.now(case), id=case.clearance.id, validation=found)
            self.say(probed, case)
        if another or case.state != state:
            self.publish(case)

    # -- inside -----------------------------------------------------------------------------------

    def _step(self, case: Case, step: Callable[[], Clearance]) -> None:
        """Take a step that somebody asks for.

        Raises:
            Refusal: 409, if it may not be taken.
        """
        try:
            taken = step()
        except ValueError as error:
            raise Refusal(409, str(error)) from None
        self.take(case, taken)

    def _advised(self, clearance: Clearance) -> Clearance:
        """The same, answered by the service where it does so and that changes anything."""
        found = clearance.validation
        answers = (
            clearance.auto_answer
            and found is not None
            and (
                clearance.state in ("validating", "standby")
                or (clearance.state == "accepted" and found.verdict == "unable")
            )
        )
        now = max(self.skies.now(clearance.sky), clearance.history[-1].t)
        if not answers or 0.0 < clearance.due <= now:  # `tick` ends what is due
            return clearance
        return life.answer_as_advised(clearance, now=now, at=self.at(), settings=self.rules)

    def _tell_crew(self, case: Case) -> None:
        """Say in the flight that flies it what is new of a clearance."""
        flight = self.skies.flight(case.clearance.flight_id)
        if flight is None:
            return
        ident = case.pursuer or self.skies.link(flight, "").pursuer
        news = crew_news(case.clearance, ident, flight.t)
        if news is not None and is_news(news, case.told):
            case.told = news
            flight.say(lambda t: replace(news, t=t))

    def _supersede(self, case: Case, by_id: str) -> None:
        now, at = self.now(case), self.at()
        self.take(case, life.supersede(case.clearance, by_id, now=now, at=at))

    def _note(self, case: Case, *, stopped: bool = False) -> None:
        """Record a clearance as it is now."""
        content = case.as_json()
        card, state, over = orjson.dumps(content).decode(), str(case.state), not case.lives
        if stopped:
            state, card = ended(card, at=self.at(), message=STOPPED)
            over = True
        self._records.note_clearance(
            ClearanceNoted(
                id=case.clearance.id,
                at=case.asked_at,
                changed_at=self._clock(),
                flight_id=case.clearance.flight_id,
                state=state,
                over=over,
                request=case.request,
                card=card,
                owner=case.owner,
                asked_by=case.asked_by,
            )
        )

    def _flush_soon(self) -> None:
        """Send what happens together in one frame."""
        asyncio.get_running_loop().call_soon(self.journal.flush)

    def _snapshot(self) -> list[bytes]:
        over = [case for case in self.cases if not case.lives][-SHOWN_OVER:]
        texts = list(self.traffic.values())
        return [*texts, *(case.text for case in (*over, *self.cases.living()))]


async def desk_of(connection: HTTPConnection) -> Desk:
    """The desk of the app that serves this connection."""
    desk: Desk = connection.app.state.desk
    return desk


DeskOf = Annotated[Desk, Depends(desk_of)]
"""How a route asks for it."""

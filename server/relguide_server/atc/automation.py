"""What automation finds of manoeuvres and clearances, and what it offers in their place."""

import asyncio
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial

from relguide.atc.alternatives import suggest
from relguide.atc.documents import (
    AlternativeManoeuvre,
    ValidationCard,
)
from relguide.atc.request import Manoeuvre
from relguide.atc.settings import AtcSettings
from relguide.atc.validate import validate
from relguide.planning.acceptance import with_deadline
from relguide.planning.plan import plan
from relguide.units import Second
from relguide_server.atc.cases import Case, Cases
from relguide_server.atc.skies import Skies
from relguide_server.atc.slots import with_its_place

SUGGESTING: Second = 1.0
"""How long alternatives are looked for …"""
A_PLAN: Second = 0.3
"""… and how long one of them may be planned."""


class Automation:
    """Validates and looks for alternatives, each on a thread of its own."""

    def __init__(self, skies: Skies, cases: Cases, rules: AtcSettings) -> None:
        """Make it.

        Args:
            skies: who flies where.
            cases: what is cleared there.
            rules: the controller's minima and times.
        """
        self._skies, self._cases, self._rules = skies, cases, rules
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="validation")
        self._suggesting = ThreadPoolExecutor(1, thread_name_prefix="alternatives")

    def stop(self) -> None:
        """Begin nothing more."""
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._suggesting.shutdown(wait=False, cancel_futures=True)

    async def try_out(
        self, manoeuvre: Manoeuvre, sky: str, *, flight_id: str = "", pursuer: str = ""
    ) -> ValidationCard:
        """What automation finds of a manoeuvre; nothing is kept of it.

        Args:
            manoeuvre: what would be flown.
            sky: in which.
            flight_id: the flight that would; empty if it is none of this service.
            pursuer: its ident in that flight.
        """
        found = await self._find(manoeuvre, sky)
        offered = await self._suggest(found, manoeuvre, sky, flight_id, pursuer)
        return replace(found, alternatives=offered)

    async def find_of(self, case: Case) -> ValidationCard:
        """What automation finds of a clearance now, its place considered."""
        found = await self._find(case.clearance.request, case.clearance.sky)
        case.checked = self._skies.now(case.clearance.sky)
        found, before = with_its_place(case, found, self._cases, self._rules), case.clearance
        if before.validation is not None and before.validation.verdict == found.verdict:
            return replace(found, alternatives=before.validation.alternatives)
        offered = await self._suggest(
            found, before.request, before.sky, before.flight_id, case.pursuer
        )
        return replace(found, alternatives=offered)

    async def _suggest(
        self, found: ValidationCard, manoeuvre: Manoeuvre, sky: str, flight_id: str, pursuer: str
    ) -> tuple[AlternativeManoeuvre, ...]:
        """What a flight could fly in place of what is not acceptable; none of what is."""
        situation = None
        if found.verdict == "unable" and flight_id:
            situation = self._skies.situation(flight_id, pursuer)
        if situation is None:
            return ()
        picture = self._skies.picture(sky, self._cases.cleared(sky))
        work = partial(
            suggest, situation, manoeuvre, picture, self._skies.now(sky), self._rules,
            planner=with_deadline(plan, A_PLAN), within=SUGGESTING,
        )  # fmt: skip
        return await asyncio.get_running_loop().run_in_executor(self._suggesting, work)

    async def _find(self, manoeuvre: Manoeuvre, sky: str) -> ValidationCard:
        await self._skies.prepare(sky)
        picture = self._skies.picture(sky, self._cases.cleared(sky))
        now, loop = self._skies.now(sky), asyncio.get_running_loop()
        return await loop.run_in_executor(
            self._pool, validate, manoeuvre, picture, now, self._rules
        )

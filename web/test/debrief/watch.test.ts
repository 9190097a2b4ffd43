import { expect, test } from "vitest";
import { openDebriefs } from "../../src/debrief/watch";
import { createSession, type Session } from "../../src/session";
import { createFlightStore } from "../../src/store/flight";
import { pairCard } from "../../src/store/pair";
import { amend, pairAt, STARTED } from "../samples";
import { silentActions } from "../silence";

test.each([
  ["fig_6b", false],
  ["lesson_bar", true],
])("%s: joined while this page flies it, the debrief is open at once: %s", (scenario, atOnce) => {
  const session = createSession(createFlightStore().flight);
  const { flight, debriefOpen, hands } = session;
  openDebriefs(session, silentActions());
  session.status.value = { id: "one", scenario } as NonNullable<Session["status"]["value"]>;
  hands.value = {} as NonNullable<Session["hands"]["value"]>;
  flight.id.value = "one";
  for (const joined of [false, true]) {
    const now = pairAt(10, { autopilot: false, joined });
    amend(flight, { started: pairCard(STARTED), sample: now, now });
  }
  expect(debriefOpen.value).toBe(atOnce);
  hands.value = null;
  expect(debriefOpen.value).toBe(true);
});

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

test("a flight that was given up and is engaged again has a debrief of its own", () => {
  const session = createSession(createFlightStore().flight);
  const { flight, debriefOpen } = session;
  openDebriefs(session, silentActions());
  flight.id.value = "one";
  const fly = (engaged: boolean, joined: boolean) => {
    const now = pairAt(10, { autopilot: false, joined });
    const to = engaged ? "engaged" : "off";
    const engagement = {
      kind: "engagement_changed",
      t_s: 10,
      ident: now.pursuer.ident,
      engagement: to,
      previous: engaged ? "armed" : "engaged",
      message: "",
    } as const;
    amend(flight, { started: pairCard(STARTED), sample: now, now, engagement });
  };
  fly(true, false);
  fly(false, false);
  expect(debriefOpen.value).toBe(true);
  debriefOpen.value = false;
  fly(true, false);
  expect(debriefOpen.value).toBe(false);
  fly(true, true);
  expect(debriefOpen.value).toBe(true);
});

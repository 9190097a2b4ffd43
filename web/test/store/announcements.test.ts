/** What is spoken: in every state what holds, once, for as long as it holds. */

import { describe, expect, test } from "vitest";
import { type Announcements, announcementsOf } from "../../src/store/announcements";
import { noticesOf } from "../../src/store/notices";
import type { PairSample } from "../../src/store/pair";
import { GUIDANCES, type Guidance } from "../../src/store/states";
import type { Flight, Message } from "../../src/store/types";
import type { Engagement, EngagementChanged } from "../../src/wire";
import { flightIn, T } from "../nd/in-state";
import { alert, amend, noPlan, OWN, separationLost } from "../samples";

const ENGAGED = "Relative guidance engaged: SRSR joins in 15 min 16 s and keeps 5.4 NM.";
const CAPTURING = "Capturing the leader's route.";
const FOLLOWING = "Joined: following the leader's path.";
const ESCAPING = "Escaping to the left: heading 310°.";

/** As the log has it: the newest first. */
const LOG: Partial<Record<Guidance, Message>> = {
  converge: { t: 0, kind: "plan", text: ENGAGED },
  capture: { t: 150, kind: "mode", text: CAPTURING },
  follow: { t: 880, kind: "mode", text: FOLLOWING },
  escape: { t: 190, kind: "mode", text: ESCAPING },
};

const TABLE: Record<Guidance, Announcements> = {
  off: { polite: "", assertive: "" },
  designated: {
    polite: "AF123 is designated: a path to its slot is looked for.",
    assertive: "",
  },
  proposed: {
    polite:
      "A path is proposed: joins in about 12 minutes, least separation 5.9 nautical miles. Accept it to arm it.",
    assertive: "",
  },
  armed: { polite: "Accepted. Engage it to fly it.", assertive: "" },
  converge: { polite: ENGAGED, assertive: "" },
  capture: { polite: CAPTURING, assertive: "" },
  follow: { polite: FOLLOWING, assertive: "" },
  escape: { polite: "", assertive: ESCAPING },
  infeasible: { polite: "", assertive: "Unable: the leader is faster." },
  unable: { polite: "", assertive: "Unable: the leader is faster." },
  data_lost: {
    polite: "",
    assertive: "Leader data lost: guidance is off, and the autopilot holds the selected heading.",
  },
};

function speakingIn(state: Guidance, t?: number): Flight {
  const flight = flightIn(state, t);
  const message = LOG[state];
  amend(flight, { messages: message === undefined ? [] : [message] });
  return flight;
}

function change(flight: Flight, changes: Partial<PairSample>): void {
  const { sample } = flight.moment.value;
  if (sample === null) throw new Error("An empty flight.");
  amend(flight, { sample: { ...sample, ...changes }, now: { ...sample, ...changes } });
}

function spoken(flight: Flight): Announcements {
  return announcementsOf(flight.moment.value);
}

function ordered(previous: Engagement, engagement: Engagement): EngagementChanged {
  return { kind: "engagement_changed", t_s: 100, ident: OWN, engagement, previous, message: "." };
}

describe.each(GUIDANCES.map((state) => [state] as const))("%s", (state) => {
  test("is spoken as the table says", () => {
    expect(spoken(speakingIn(state))).toEqual(TABLE[state]);
  });

  test("is spoken once, the time of a proposal once a minute", () => {
    const at = state === "follow" ? 900 : T;
    const minute = Array.from({ length: 59 }, (_, s) => spoken(speakingIn(state, at + s)));
    const texts = new Set(minute.map(({ polite, assertive }) => `${polite} ${assertive}`));
    expect(texts.size).toBeLessThanOrEqual(state === "proposed" ? 2 : 1);
  });
});

test("no sentence is said twice, not even politely and at once", () => {
  for (const state of GUIDANCES) {
    const flight = speakingIn(state);
    amend(flight, {
      unable: { kind: "unable", t_s: T, ident: OWN, reason: "separation", message: "Unable: no." },
      unavailable: noPlan(T),
      alerts: [alert(T)],
    });
    const { polite, assertive } = spoken(flight);
    const sentences = `${polite} ${assertive}`.split(/(?<=\.) /).filter((each) => each !== "");
    expect(new Set(sentences).size, state).toBe(sentences.length);
    expect(`${polite} ${assertive}`).not.toMatch(/unable[.:] *unable/i);
  }
});

test("old data of the leader are a caution that is spoken when it begins, not each second", () => {
  const flight = speakingIn("converge");
  const at = (age: number) => {
    change(flight, { leader_age_s: age });
    return spoken(flight);
  };
  expect(at(4).assertive).toBe("");
  const texts = [6, 7, 8, 9].map((age) => at(age).assertive);
  expect(new Set(texts)).toEqual(
    new Set(["Leader data old: nothing heard for more than 5 seconds."]),
  );
  expect(at(0).assertive).toBe("");
});

test("that nothing is heard of the leader is said once: by the state or, at off, by the alert", () => {
  const message = "Nothing was heard of the leader for 11 s: the separation is not known.";
  const of = (state: Guidance) => {
    const flight = speakingIn(state);
    amend(flight, { alerts: [alert(T, { subject: "data", message })] });
    const shown = noticesOf(flight.moment.value).filter(({ text }) => text === "LDR DATA LOST");
    expect(shown).toEqual([{ level: "caution", text: "LDR DATA LOST" }]);
    return spoken(flight).assertive;
  };
  expect(of("data_lost")).toBe(TABLE.data_lost.assertive);
  expect(of("off")).toBe(message);
});

test("a replan that is announced is spoken, in the words of the log", () => {
  const flight = speakingIn("converge");
  const text = "The leader turned: LSR joins in 10 min 3 s.";
  amend(flight, { messages: [{ t: T, kind: "plan", text }, ...flight.moment.value.messages] });
  expect(spoken(flight).polite).toBe(text);
});

test("a loss of separation is said with its cause while it lasts, and is over with it", () => {
  const flight = speakingIn("converge");
  change(flight, { separation_m: 8000 });
  amend(flight, { belowAt: T, lost: separationLost(T) });
  expect(spoken(flight).assertive).toBe(
    "Separation: closer than 5.0 nautical miles. The leader turned towards own ship.",
  );
  amend(flight, { alerts: [alert(T, { level: "warning", message: "4.3 NM, less than 5.0 NM." })] });
  expect(spoken(flight).assertive).not.toContain("4.3");
  change(flight, { separation_m: 12_000 });
  amend(flight, { t: T + 20, alerts: [] });
  expect(spoken(flight).assertive).toBe("");
});

test("a predicted loss is said without the seconds that count down", () => {
  const flight = speakingIn("converge");
  amend(flight, { alerts: [alert(T)] });
  expect(spoken(flight).assertive).toBe("The leader slows down.");
  amend(flight, { t: T + 5 });
  expect(spoken(flight).assertive).toBe("The leader slows down.");
});

test("after the leader is heard again it is said that guidance was engaged, and how it is again", () => {
  const flight = speakingIn("proposed");
  amend(flight, { engagement: ordered("engaged", "designated") });
  expect(spoken(flight).polite).toMatch(/Guidance was engaged: accept, then engage it again\.$/);
  expect(spoken(flight).polite).not.toMatch(/data/i);
});

test("a disconnected crew hears that guidance is off", () => {
  const flight = speakingIn("off");
  amend(flight, { engagement: ordered("engaged", "off") });
  expect(spoken(flight)).toEqual({ polite: "Relative guidance is off.", assertive: "" });
});

test("data too old to be shown are told as that and as nothing else", () => {
  const flight = speakingIn("converge");
  amend(flight, { dataAge: 12 });
  const { polite, assertive } = spoken(flight);
  expect(polite).toBe("");
  expect(assertive).toMatch(/connection is lost/);
});

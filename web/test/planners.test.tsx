/** Four planners side by side: asked while that is open, and what is wrong with each is said. */

import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Answer } from "../src/api";
import { PlannersPanel } from "../src/panels/planners";
import { ASK_EVERY, createPlanners, followPlanners } from "../src/planners";
import { createSession } from "../src/session";
import type { PlannerComparison, PlannerVerdict } from "../src/wire";
import { flightAt } from "./nd/fixture";

const place = document.body.appendChild(document.createElement("div"));

beforeEach(() => void vi.useFakeTimers());
afterEach(() => {
  render(null, place);
  vi.useRealTimers();
});

function verdict(
  planner: PlannerVerdict["planner"],
  more: Partial<PlannerVerdict>,
): PlannerVerdict {
  return {
    planner,
    status: "planned",
    message: "Certified; as fast as the exact plan.",
    word: "RSL",
    time_to_converge_s: 107,
    over_exact_s: 0,
    least_m: 9260,
    compute_ms: 0.2,
    segments: [],
    ...more,
  };
}

const SAID: readonly PlannerVerdict[] = [
  verdict("exact", { message: "Nothing is faster." }),
  verdict("network", {}),
  verdict("regular_dp", { status: "handed_over", word: "", message: "The tree knows no word." }),
  verdict("printed_network", {
    status: "refused",
    over_exact_s: -90.8,
    message: "Not flown: it ends 9.44 NM from the slot.",
  }),
];

function answering(planners: readonly PlannerVerdict[]) {
  return vi.fn(
    async (): Promise<Answer<PlannerComparison>> => ({
      kind: "done",
      value: { planners: [...planners] },
    }),
  );
}

test("they are asked while that is open: at once, and again only when the flight has gone on", async () => {
  const [planners, flight] = [createPlanners(), flightAt("fig_6b", 100)];
  const ask = answering(SAID);
  followPlanners(planners, flight, ask);
  await vi.advanceTimersByTimeAsync(3 * ASK_EVERY);
  expect(ask).not.toHaveBeenCalled();
  planners.isOpen.value = true;
  await vi.advanceTimersByTimeAsync(3 * ASK_EVERY);
  expect(ask).toHaveBeenCalledTimes(1);
  expect(planners.compared.value?.verdicts).toEqual(SAID);
  flight.moment.value = { ...flight.moment.value, t: 105 };
  await vi.advanceTimersByTimeAsync(ASK_EVERY);
  expect(ask).toHaveBeenCalledTimes(2);
  expect(planners.compared.value?.t).toBe(105);
  planners.isOpen.value = false;
  expect(planners.compared.value).toBeNull();
  await vi.advanceTimersByTimeAsync(3 * ASK_EVERY);
  expect(ask).toHaveBeenCalledTimes(2);
});

test("one that is being compiled is asked again, though the flight stands", async () => {
  const [planners, flight] = [createPlanners(), flightAt("fig_6b", 100)];
  const ask = answering([verdict("network", { status: "preparing", word: "" })]);
  followPlanners(planners, flight, ask);
  planners.isOpen.value = true;
  await vi.advanceTimersByTimeAsync(2 * ASK_EVERY + 1);
  expect(ask).toHaveBeenCalledTimes(3);
});

test("a refusal is a sentence in the place of the table", async () => {
  const session = createSession(flightAt("fig_6b", 100));
  followPlanners(session.planners, session.flight, async () => ({
    kind: "refused",
    status: 503,
    sentence: "First start: preparing the limited search, 40%.",
  }));
  session.planners.isOpen.value = true;
  await vi.advanceTimersByTimeAsync(1);
  render(<PlannersPanel session={session} />, place);
  expect(place.textContent).toContain("preparing the limited search");
  expect(place.querySelector("table")).toBeNull();
});

test("each has its time, its word and a verdict with a sign and a word; the chosen one's is said", async () => {
  const session = createSession(flightAt("fig_6b", 100));
  followPlanners(session.planners, session.flight, answering(SAID));
  session.planners.isOpen.value = true;
  await vi.advanceTimersByTimeAsync(1);
  render(<PlannersPanel session={session} />, place);
  const rows = [...place.querySelectorAll("tbody tr")].map((row) => row.textContent);
  expect(rows[0]).toContain("Exact01:47+0.0 sRSL0.2\u2713certified");
  expect(rows[2]).toContain("Treenone");
  expect(rows[2]).toContain("\u2192hands over");
  expect(rows[3]).toContain("\u221290.8 sRSL0.2\u2715not flown");
  expect(place.querySelector(".proof")?.textContent).toBe("Exact: Nothing is faster.");
  const printed = [...place.querySelectorAll("button")].find(
    ({ textContent }) => textContent === "Printed",
  );
  act(() => printed?.click());
  expect(place.querySelector(".proof")?.textContent).toContain("it ends 9.44 NM from the slot");
});

test("paths are drawn of those that have one, the chosen one strongest", async () => {
  const session = createSession(flightAt("fig_6b", 100));
  const segments = session.flight.moment.value.plan?.plan.segments ?? [];
  followPlanners(
    session.planners,
    session.flight,
    answering([verdict("exact", { segments }), verdict("regular_dp", { word: "" })]),
  );
  session.planners.isOpen.value = true;
  await vi.advanceTimersByTimeAsync(1);
  expect(session.shown.rivals.value).toEqual([
    { planner: "exact", segments, isFlyable: true, isChosen: true },
  ]);
});

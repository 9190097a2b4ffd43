/** AUTO: the range goes with the flight by single steps, and settles at once on what is new. */

import { batch } from "@preact/signals";
import { expect, test } from "vitest";
import { followRange } from "../src/auto-range";
import { createSession } from "../src/session";
import type { Moment } from "../src/store/types";
import { flightAt, setTime } from "./nd/fixture";
import { amend } from "./samples";

function following(t: number) {
  const flight = flightAt("fig_6b", t);
  const session = createSession(flight);
  session.ndMode.value = "ROSE";
  let wall = 0;
  followRange(session, () => wall);
  return {
    session,
    /** Goes on `seconds`, with what changes meanwhile. */
    fly(seconds: number, changes: Partial<Moment> = {}) {
      wall += 1000 * seconds;
      batch(() => {
        setTime(flight, flight.moment.value.t + seconds, "converge");
        amend(flight, changes);
      });
      return session.ndRange.value;
    },
  };
}

test("the first picture has the range that fits", () => {
  const { session } = following(0);
  expect(session.ndRange.value).toBeGreaterThanOrEqual(80);
});

test("another flight time settles at once; a flight that goes on takes single steps", () => {
  const { session, fly } = following(0);
  fly(840);
  const near = session.ndRange.value;
  expect(near).toBeLessThanOrEqual(20);
  // the way becomes a long one, as after a new plan
  const far = flightAt("fig_6b", 0).moment.value;
  const ranges: number[] = [near];
  for (let k = 0; k < 60; k += 1) {
    const { route, plan } = far;
    if (plan === null || route === null) throw new Error("An empty flight.");
    const { sample } = session.flight.moment.value;
    if (sample === null) throw new Error("An empty flight.");
    const long = { ...sample, time_to_go_s: 600 };
    const range = fly(0.2, {
      plan: { ...plan, t_s: session.flight.moment.value.t },
      sample: long,
    });
    if (range !== ranges.at(-1)) ranges.push(range);
  }
  expect(ranges.length).toBeGreaterThan(2);
  for (const [k, range] of ranges.slice(1).entries()) expect(range).toBe(2 * (ranges[k] ?? 0));
});

test("while a turn is due the minimum round the leader stays legible", () => {
  const { session, fly } = following(0);
  for (let t = 0; t < 860; t += 0.5) {
    const range = fly(0.5);
    const { turns } = session.shown.picture.value;
    const since = turns.find(({ hasBegun }) => hasBegun);
    const at = session.flight.moment.value.t;
    // it has had the half minute before its roll-in for two steps
    if (since !== undefined && since.begins > 30 && at > since.begins)
      expect(range, `at ${at} s`).toBeLessThanOrEqual(80);
  }
});

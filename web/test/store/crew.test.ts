/** What the crew switches and selects, as the documents say it: in the picture, the log, and by ear. */

import { describe, expect, test } from "vitest";
import { announcementsOf } from "../../src/store/announcements";
import { createHistory, momentAt } from "../../src/store/history";
import { noticesOf } from "../../src/store/notices";
import { pictureOf } from "../../src/store/picture";
import type { AssignmentChanged, ControlChanged, Document } from "../../src/wire";
import { modeChanged, OWN, planChanged, STARTED, sample } from "../samples";

const BARS = { roll_deg: 10, pitch_deg: 0, commanded_bank_deg: 20, commanded_climb_mps: 0 };

function assigned(t: number, changes: Partial<AssignmentChanged> = {}): AssignmentChanged {
  return {
    kind: "assignment_changed",
    t_s: t,
    ident: OWN,
    slot_distance_m: 10_000,
    min_separation_m: 9260,
    max_bank_deg: 25,
    selected_tas_mps: [],
    message: "D is 10.0 NM.",
    ...changes,
  };
}

function controlled(t: number, autopilot: boolean, message: string): ControlChanged {
  return { kind: "control_changed", t_s: t, ident: OWN, autopilot, director: true, message };
}

function historyOf(documents: readonly Document[]) {
  const history = createHistory();
  history.merge([STARTED, modeChanged(0), planChanged(0), ...documents]);
  return history;
}

const SAMPLES = [0, 1, 2, 3, 4].map((t) => sample(t));

describe("D and d_min", () => {
  const history = historyOf([
    ...SAMPLES,
    assigned(2, { slot_distance_m: 30_000, min_separation_m: 25_000 }),
  ]);

  test("are the new ones from then on, and the old ones before", () => {
    expect(momentAt(history, 1).started?.slot_distance_m).toBe(10_000);
    expect(momentAt(history, 3).started?.slot_distance_m).toBe(30_000);
    expect(pictureOf(momentAt(history, 3)).keepOut).toBe(25_000);
  });

  test("what was no loss then is none in a replay", () => {
    expect(momentAt(history, 1.9).belowAt).toBe(Number.NEGATIVE_INFINITY);
    expect(momentAt(history, 3).belowAt).toBe(3);
  });
});

test("control and assignment are lines of the log, and orders alone are not", () => {
  const order = { kind: "set_autopilot", on: false, ident: OWN } as const;
  const history = historyOf([
    ...SAMPLES,
    { kind: "command_given", t_s: 2, command: order },
    controlled(2, false, "You have control."),
    assigned(3),
  ]);
  const said = momentAt(history, 4).messages.filter(({ kind }) => kind === "engagement");
  expect(said.map(({ text }) => text)).toEqual(["D is 10.0 NM.", "You have control."]);
});

describe("by ear", () => {
  const spoken = (documents: readonly Document[], t: number) =>
    announcementsOf(momentAt(historyOf(documents), t));
  const byHand = [0, 1, 2, 3, 4].map((t) => sample(t, { autopilot: t < 2, director: true }));

  test("the newest order of the crew is said politely, once", () => {
    const documents = [...byHand, controlled(2, false, "You have control.")];
    expect(spoken(documents, 1).polite).not.toContain("control");
    expect(spoken(documents, 3).polite).toContain("You have control.");
    expect(spoken(documents, 4).polite).toBe(spoken(documents, 3).polite);
    expect(spoken([...documents, assigned(3)], 4).polite).toContain("D is 10.0 NM.");
  });

  test("guidance that gives up is said at once to a crew that flies", () => {
    const gone = { ...modeChanged(3, "heading"), previous: "converge" } as const;
    expect(spoken([...byHand, gone], 4).assertive).toContain("You fly: hold the heading.");
    expect(spoken([...SAMPLES, gone], 4).assertive).not.toContain("You fly");
  });
});

test("the bars and who flies are kept between samples", () => {
  const samples = [0, 1, 2].map((t) =>
    sample(t, {
      autopilot: false,
      director: true,
      bars: t < 2 ? [{ ...BARS, roll_deg: 10 * t }] : [],
    }),
  );
  const history = historyOf(samples);
  const at = (t: number) => history.knots.sampleAt(t);
  expect(at(0.5)?.bars?.[0]?.roll_deg).toBeCloseTo(5, 9);
  expect(at(0.5)).toMatchObject({ autopilot: false, director: true });
  expect(at(2)?.bars).toBeUndefined();
  expect(historyOf(SAMPLES).knots.sampleAt(1)?.autopilot).toBeUndefined();
  expect(noticesOf(momentAt(history, 1))).toBeDefined();
});

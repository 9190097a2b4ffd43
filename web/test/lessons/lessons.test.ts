import { afterEach, expect, test, vi } from "vitest";
import { flownOf } from "../../src/debrief/seconds";
import { LESSONS, lessonOf, markOf, sayLate } from "../../src/lessons/lessons";
import { sayOff } from "../../src/lessons/off";
import { createHistory } from "../../src/store/history";
import { aircraft, pairAt, planChanged, STARTED, sample } from "../samples";

afterEach(() => {
  vi.unstubAllGlobals();
  vi.resetModules();
});

/** What a page that is loaded now reads of the best times. */
function loaded() {
  vi.resetModules();
  return import("../../src/lessons/best");
}

test("a card has no more than 60 words", () => {
  for (const { card } of LESSONS) expect(card.split(/\s+/).length).toBeLessThanOrEqual(60);
});

test("the first lesson is checked off step by step, in flight time", () => {
  const history = createHistory();
  const lesson = lessonOf("lesson_bar");
  const done = () => {
    const flown = flownOf(history);
    return lesson?.steps.map(({ isDone }) => flown !== null && isDone({ flown, history }));
  };
  const fly = (from: number, to: number, commanded_bank_deg: number, joined = false) =>
    history.merge(
      Array.from({ length: to - from }, (_, k) =>
        sample(from + k, {
          autopilot: false,
          joined,
          pursuer: aircraft({ bank_deg: commanded_bank_deg }),
          bars: [{ roll_deg: 0, pitch_deg: 0, commanded_bank_deg, commanded_climb_mps: 0 }],
        }),
      ),
    );
  history.merge([STARTED, planChanged(0), sample(0, { engagement: "engaged" })]);
  expect(done()).toEqual([false, false, false, false]);
  fly(1, 10, 20);
  expect(done()).toEqual([true, false, false, false]);
  fly(10, 12, 20);
  expect(done()).toEqual([true, true, false, false]);
  fly(12, 23, 0);
  expect(done()).toEqual([true, true, true, false]);
  fly(23, 24, 0, true);
  expect(done()).toEqual([true, true, true, true]);
});

test("how far off one is names an angle and a side", () => {
  const bar = (roll_deg: number) =>
    sayOff(
      pairAt(0, {
        bars: [{ roll_deg, pitch_deg: 0, commanded_bank_deg: 0, commanded_climb_mps: 0 }],
      }),
    );
  expect(bar(6.2)).toBe("Bar 6° right: roll right.");
  expect(bar(-12)).toBe("Bar 12° left: roll left.");
  expect(bar(1)).toBe("On the bar.");
  const raw = { kind: "hold_heading", heading_deg: 80 } as const;
  expect(sayOff(pairAt(0, { reference: raw }))).toBe("The path's heading is 10° left: turn left.");
});

test("marks get no better the later one joins, and the minimum lost is no pass", () => {
  const letters = [-5, 0, 3, 4, 10, 11, 30, 31, 500].map((late) => markOf(late, false)?.letter);
  expect(letters).toEqual(["A", "A", "A", "B", "B", "C", "C", "D", "D"]);
  expect(markOf(0, true)?.letter).toBe("F");
  expect(markOf(null, false)).toBeNull();
  expect([sayLate(4), sayLate(0), sayLate(-65)]).toEqual([
    "4 s after the autopilot",
    "with the autopilot, to the second",
    "01:05 min before the autopilot",
  ]);
});

test("the best time is kept, and only a better one takes its place; it can be cleared", async () => {
  localStorage.clear();
  const first = await loaded();
  expect(first.note("lesson_bar", 9)).toBe(true);
  expect(first.note("lesson_bar", 12)).toBe(false);
  expect((await loaded()).best.value).toEqual({ lesson_bar: 9 });
  (await loaded()).clearBest();
  expect((await loaded()).best.value).toEqual({});
  expect(localStorage.length).toBe(0);
});

test("what another version kept, or nobody can read, is no time", async () => {
  for (const kept of ['{"version":2,"late_s":{"lesson_bar":1}}', "{", "null", '{"version":1}']) {
    localStorage.setItem("relguide.lessons", kept);
    expect((await loaded()).best.value).toEqual({});
  }
});

test("a browser that keeps nothing still knows the time as long as the page", async () => {
  const refuse = () => {
    throw new DOMException("no", "SecurityError");
  };
  vi.stubGlobal("localStorage", { getItem: refuse, setItem: refuse, removeItem: refuse });
  const { best, note } = await loaded();
  expect(note("lesson_turn", 5)).toBe(true);
  expect(best.value).toEqual({ lesson_turn: 5 });
});

import { expect, test } from "vitest";
import { createHistory } from "../../src/store/history";
import { nextMark, outlineOf } from "../../src/timeline/outline";
import { alert, modeChanged, noPlan, planChanged, STARTED, sample } from "../samples";

function flown() {
  const history = createHistory();
  const samples = Array.from({ length: 1001 }, (_, t) =>
    sample(t, { separation_m: t === 501 ? 9000 : 15_000, joined: t >= 900 }),
  );
  history.merge([STARTED, modeChanged(0), planChanged(0), alert(400), ...samples]);
  return history;
}

test("the least separation is drawn, however short it was", () => {
  const outline = outlineOf(flown());
  expect(outline?.flown.length).toBeLessThan(500);
  expect(Math.min(...(outline?.flown ?? []).map(({ d }) => d))).toBe(9000);
  expect(outline).toMatchObject({ first: 0, last: 1000, end: 1000, minSeparation: 9260 });
});

test("what happened is marked once, the join among it", () => {
  const outline = outlineOf(flown());
  expect(outline?.marks.map(({ t, kind }) => [t, kind])).toEqual([
    [0, "mode"],
    [0, "plan"],
    [400, "caution"],
    [900, "joined"],
  ]);
  if (outline === null) throw new Error("No outline");
  expect(nextMark(outline, 0, 1)?.t).toBe(400);
  expect(nextMark(outline, 400, -1)?.t).toBe(0);
  expect(nextMark(outline, 900, 1)).toBeNull();
});

test("what is proved holds from a plan until the next, or until there is none", () => {
  const history = createHistory();
  const second = planChanged(100, { separation: { least_m: 9300, at_s: 1, proved_above_m: 9290 } });
  history.merge([STARTED, planChanged(0), second, noPlan(150), sample(0), sample(300)]);
  expect(outlineOf(history)?.proved).toEqual([
    { from: 0, to: 100, above: 9999 },
    { from: 100, to: 150, above: 9290 },
  ]);
});

/** What is laid out can be taken back and done again, step by step. */

import { expect, test } from "vitest";
import { edit, openEditor, putSituation } from "../../src/map/editing";
import { createEditor, step } from "../../src/map/editor";
import { FIRST } from "../../src/map/first";
import type { Situation } from "../../src/map/situation";

const east = (x_m: number) => (now: Situation) => ({ ...now, pursuer: { ...now.pursuer, x_m } });

function begun() {
  const map = openEditor(createEditor());
  putSituation(map, FIRST);
  return map;
}

test("what one hand does is one step", () => {
  const map = begun();
  const hand = {};
  for (const x of [1000, 2000, 3000]) edit(map, east(x), hand);
  edit(map, east(9000));
  expect(map.steps.past.value).toHaveLength(2);
  step(map, -1);
  expect(map.situation.value.pursuer.x_m).toBe(3000);
  step(map, -1);
  expect(map.situation.value.pursuer.x_m).toBe(FIRST.pursuer.x_m);
  step(map, -1);
  expect(map.situation.value.pursuer.x_m).toBe(FIRST.pursuer.x_m);
  step(map, 1);
  step(map, 1);
  expect(map.situation.value.pursuer.x_m).toBe(9000);
});

test("another change makes what was taken back unknown, and no change makes no step", () => {
  const map = begun();
  edit(map, east(1000));
  step(map, -1);
  edit(map, (now) => now);
  expect(map.steps.future.value).toHaveLength(1);
  edit(map, east(2000));
  expect(map.steps.future.value).toHaveLength(0);
});

test("a situation of the gallery is a step too, and what comes back is brought into sight", () => {
  const map = begun();
  const centre = map.centre.value;
  putSituation(map, { ...FIRST, ...{ pursuer: { ...FIRST.pursuer, x_m: 700_000 } } });
  expect(map.centre.value).not.toEqual(centre);
  step(map, -1);
  expect(map.situation.value.pursuer.x_m).toBe(FIRST.pursuer.x_m);
  expect(map.isToFit.value).toBe(true);
});

/** What the map asks of the service, and asks again. */

import { signal } from "@preact/signals";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { followMap, isAreaCut } from "../../src/map/asking";
import { edit, openEditor, putSituation } from "../../src/map/editing";
import { createEditor } from "../../src/map/editor";
import { FIRST } from "../../src/map/first";
import { bodyOf, settle } from "../../src/map/situation";
import type { NdMode } from "../../src/session";
import { documentsOf } from "../nd/fixture";

const { plan } = documentsOf("fig_6b").plan;

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

/** A service that is preparing until `ready`, and plans everything after. */
function prepared(ready: () => boolean): { asked: string[] } {
  const asked: string[] = [];
  vi.stubGlobal("fetch", async (url: string, init: { body: string }) => {
    if (!url.includes("/plans")) return new Response("{}", { status: 404 });
    asked.push(init.body);
    return ready()
      ? new Response(JSON.stringify(plan))
      : new Response("{}", { status: 503, headers: { "retry-after": "1" } });
  });
  return { asked };
}

test("pictures of the gallery that a first start refuses are asked for until they are answered", async () => {
  let isReady = false;
  const { asked } = prepared(() => isReady);
  const [ndMode, map] = [signal<NdMode>("PLAN"), openEditor(createEditor())];
  followMap({ ndMode, map, firstStart: signal(null) });
  await vi.advanceTimersByTimeAsync(3500);
  expect(map.thumbs.value.every(({ answered }) => answered.value === null)).toBe(true);
  isReady = true;
  await vi.advanceTimersByTimeAsync(1500);
  expect(map.thumbs.value.every(({ answered }) => answered.value !== null)).toBe(true);
  const before = asked.length;
  ndMode.value = "ARC";
  ndMode.value = "PLAN";
  await vi.advanceTimersByTimeAsync(5000);
  expect(asked.length - before).toBeLessThan(2);
});

test("they are asked for no longer than the map is shown", async () => {
  const { asked } = prepared(() => false);
  const [ndMode, map] = [signal<NdMode>("PLAN"), openEditor(createEditor())];
  followMap({ ndMode, map, firstStart: signal(null) });
  const first = map.thumbs.value[0]?.entry.situation;
  if (first === undefined) throw new Error("An empty gallery.");
  const body = JSON.stringify(bodyOf(settle(first)));
  const count = () => asked.filter((each) => each === body).length;
  await vi.advanceTimersByTimeAsync(2500);
  const before = count();
  expect(before).toBe(3);
  ndMode.value = "ARC";
  await vi.advanceTimersByTimeAsync(5000);
  expect(count()).toBe(before);
});

test("an answer that is late dims the plan before it, and takes nothing away", async () => {
  let answer: (response: Response) => void = () => undefined;
  const planned = () => new Response(JSON.stringify(plan));
  let isQuick = true;
  vi.stubGlobal("fetch", (url: string) => {
    if (!url.includes("/plans")) return Promise.resolve(new Response("{}", { status: 404 }));
    if (isQuick) return Promise.resolve(planned());
    return new Promise<Response>((resolve) => {
      answer = resolve;
    });
  });
  const [ndMode, map] = [signal<NdMode>("PLAN"), openEditor(createEditor())];
  followMap({ ndMode, map, firstStart: signal(null) });
  await vi.advanceTimersByTimeAsync(1000);
  const before = map.answered.value;
  expect(before).not.toBeNull();
  isQuick = false;
  edit(map, (now) => ({ ...now, slot_distance_m: 20_000 }));
  await vi.advanceTimersByTimeAsync(100);
  expect(map.isLate.value).toBe(false);
  await vi.advanceTimersByTimeAsync(400);
  expect(map.isLate.value).toBe(true);
  expect(map.answered.value).toBe(before);
  isQuick = true;
  answer(planned());
  await vi.advanceTimersByTimeAsync(100);
  expect(map.isLate.value).toBe(false);
  expect(map.answered.value).not.toBe(before);
});

test("no area is asked for beyond what is planned", async () => {
  const asked: { x_m: number; width_m: number }[] = [];
  vi.stubGlobal("fetch", async (url: string, init: { body: string }) => {
    if (url.includes("/areas")) asked.push(JSON.parse(init.body));
    return new Response("{}", { status: 404 });
  });
  const [ndMode, map] = [signal<NdMode>("PLAN"), openEditor(createEditor())];
  putSituation(map, { ...FIRST, pursuer: { ...FIRST.pursuer, x_m: -900_000 } });
  map.centre.value = { x_m: -800_000, y_m: 0 };
  map.range.value = 240;
  expect(isAreaCut(map)).toBe(true);
  followMap({ ndMode, map, firstStart: signal(null) });
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked.length).toBeGreaterThan(0);
  for (const { x_m, width_m } of asked)
    expect(Math.abs(x_m) + width_m / 2).toBeLessThanOrEqual(1e6);
  const before = asked.length;
  map.centre.value = { x_m: -3_000_000, y_m: 0 };
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toHaveLength(before);
});

/** What the map asks of the service, and asks again. */

import { signal } from "@preact/signals";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { followMap } from "../../src/map/asking";
import { createEditor } from "../../src/map/editor";
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
  const [ndMode, map] = [signal<NdMode>("PLAN"), createEditor()];
  followMap({ ndMode, map, firstStart: signal(null) });
  await vi.advanceTimersByTimeAsync(3500);
  expect(map.thumbs.every(({ answered }) => answered.value === null)).toBe(true);
  isReady = true;
  await vi.advanceTimersByTimeAsync(1500);
  expect(map.thumbs.every(({ answered }) => answered.value !== null)).toBe(true);
  const before = asked.length;
  ndMode.value = "ARC";
  ndMode.value = "PLAN";
  await vi.advanceTimersByTimeAsync(5000);
  expect(asked.length - before).toBeLessThan(2);
});

test("they are asked for no longer than the map is shown", async () => {
  const { asked } = prepared(() => false);
  const [ndMode, map] = [signal<NdMode>("PLAN"), createEditor()];
  followMap({ ndMode, map, firstStart: signal(null) });
  const first = map.thumbs[0]?.entry.situation;
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

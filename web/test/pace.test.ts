/** How often the picture is drawn: as often as something moves that can be seen, and with news. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { layoutOf } from "../src/nd/view";
import { drawPictures, patience } from "../src/pace";
import { createSession } from "../src/session";
import { createFlightStore, type FlightStore } from "../src/store/flight";
import { aircraft, modeChanged, pairAt, planChanged, STARTED, sample, tick } from "./samples";

const AT_20 = layoutOf("ARC", 20);

beforeEach(() => {
  vi.useFakeTimers({
    toFake: ["setTimeout", "clearTimeout", "performance", "requestAnimationFrame"],
  });
});
afterEach(() => {
  vi.useRealTimers();
});

/** A flight that flies straight on, drawn at its own pace, and how often it was drawn. */
function drawn(): { store: FlightStore; receive: ReturnType<typeof drawPictures>; at: number[] } {
  const store = createFlightStore();
  const at: number[] = [];
  const counted = {
    ...store,
    advance(wall: number) {
      at.push(wall);
      store.advance(wall);
    },
  };
  const session = createSession(store.flight);
  session.ndRange.value = 20;
  const receive = drawPictures(counted, session);
  receive(tick(0, [STARTED, modeChanged(0), planChanged(0), sample(0)]), performance.now());
  vi.advanceTimersByTime(100);
  return { store, receive, at };
}

test("straight flight is drawn in steps of a third of a pixel", () => {
  // 240 m/s at 20 NM in 500 px: 3.24 px/s
  expect(patience(pairAt(0), AT_20, 1)).toBeCloseTo(101.9, 0);
  expect(patience(pairAt(0), AT_20, 10)).toBeCloseTo(10.2, 1);
});

test("a turn is drawn more often, and what stands still as numbers are read", () => {
  const turning = pairAt(0, { pursuer: aircraft({ turn_rate_degps: 1.1 }) });
  expect(patience(turning, AT_20, 1)).toBeLessThan(30);
  expect(patience(pairAt(0), AT_20, 0)).toBe(200);
  expect(patience(null, AT_20, 1)).toBe(200);
});

test("two that meet head-on are drawn by the speed at which they pass", () => {
  const coming = aircraft({ track_deg: 270, heading_deg: 270 });
  const alone = patience(pairAt(0), AT_20, 1);
  expect(patience(pairAt(0, { leader: coming }), AT_20, 1)).toBeCloseTo(alone / 2, 3);
});

test("ticks between two pictures draw nothing by themselves", () => {
  const { receive, store, at } = drawn();
  const before = at.length;
  for (let k = 1; k <= 40; k += 1) {
    receive(tick(k / 20, [sample(k / 20)]), performance.now());
    vi.advanceTimersByTime(50);
  }
  // two seconds of 102 ms steps
  expect(at.length - before).toBeGreaterThan(16);
  expect(at.length - before).toBeLessThan(23);
  expect(store.flight.sample.value?.t_s).toBeGreaterThan(1.8);
});

test("news is drawn with the next frame", () => {
  const { receive, store, at } = drawn();
  vi.advanceTimersByTime(5);
  const before = at.length;
  receive(tick(0.2, [modeChanged(0.2, "capture"), sample(0.2)]), performance.now());
  vi.advanceTimersByTime(17);
  expect(at.length).toBe(before + 1);
  expect(store.flight.mode.value?.mode).toBe("capture");
});

test("a hidden page is given no frames, and hears all the same", () => {
  vi.stubGlobal("requestAnimationFrame", () => 0);
  const hidden = vi.spyOn(document, "hidden", "get").mockReturnValue(true);
  const { receive, store } = drawn();
  receive(tick(1, [sample(1)]), performance.now());
  vi.advanceTimersByTime(300);
  expect(store.flight.sample.value?.t_s).toBe(1);
  hidden.mockRestore();
  vi.unstubAllGlobals();
});

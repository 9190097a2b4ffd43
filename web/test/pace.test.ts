/** How often the picture is drawn, and how often it is carried on in between. */

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { layoutOf } from "../src/nd/view";
import { drawPictures, lifetime, patience } from "../src/pace";
import { createSession } from "../src/session";
import { createFlightStore, type FlightStore } from "../src/store/flight";
import type { Document } from "../src/wire";
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

/** A flight that flies straight on, at its own pace, and when it was drawn and carried on. */
function drawn(): {
  store: FlightStore;
  receive: ReturnType<typeof drawPictures>;
  at: number[];
  glides: number[];
} {
  const store = createFlightStore();
  const at: number[] = [];
  const glides: number[] = [];
  const counted = {
    ...store,
    advance(wall: number) {
      at.push(wall);
      store.advance(wall);
    },
    glide(wall: number) {
      glides.push(wall);
      store.glide(wall);
    },
  };
  const session = createSession(store.flight);
  session.ndRange.value = 20;
  const receive = drawPictures(counted, session);
  receive(tick(0, [STARTED, modeChanged(0), planChanged(0), sample(0)]), performance.now());
  vi.advanceTimersByTime(100);
  return { store, receive, at, glides };
}

test("straight flight is carried on in steps of a third of a pixel", () => {
  // 240 m/s at 20 NM in 500 px: 3.24 px/s
  expect(patience(pairAt(0), AT_20, 1)).toBeCloseTo(101.9, 0);
  expect(patience(pairAt(0), AT_20, 10)).toBeCloseTo(10.2, 1);
});

test("in a turn more often, and what stands still as numbers are read", () => {
  const turning = pairAt(0, { pursuer: aircraft({ turn_rate_degps: 1.1 }) });
  expect(patience(turning, AT_20, 1)).toBeLessThan(30);
  expect(patience(pairAt(0), AT_20, 0)).toBe(200);
  expect(patience(null, AT_20, 1)).toBe(200);
});

test("two that meet head-on are carried on by the speed at which they pass", () => {
  const coming = aircraft({ track_deg: 270, heading_deg: 270 });
  const alone = patience(pairAt(0), AT_20, 1);
  expect(patience(pairAt(0, { leader: coming }), AT_20, 1)).toBeCloseTo(alone / 2, 3);
});

test("a picture is drawn five times a second, sooner only where it cannot be carried on", () => {
  const turning = pairAt(0, { pursuer: aircraft({ turn_rate_degps: 1.3 }) });
  expect(lifetime(turning, layoutOf("ARC", 10), 1)).toBe(200);
  expect(lifetime(turning, layoutOf("ARC", 10), 0)).toBe(200);
  expect(lifetime(null, AT_20, 1)).toBe(200);
  // at ×60 it has turned by 0.5° in 6.4 ms, and flown 6 px in 31 ms
  expect(lifetime(turning, AT_20, 60)).toBeCloseTo(6.4, 1);
  expect(lifetime(pairAt(0), AT_20, 60)).toBeCloseTo(30.9, 1);
});

test("ticks between two pictures draw nothing by themselves", () => {
  const { receive, store, at, glides } = drawn();
  const [before, glided] = [at.length, glides.length];
  for (let k = 1; k <= 40; k += 1) {
    receive(tick(k / 20, [sample(k / 20)]), performance.now());
    vi.advanceTimersByTime(50);
  }
  // in two seconds ten pictures
  expect(at.length - before).toBeGreaterThan(8);
  expect(at.length - before).toBeLessThan(12);
  // … and steps of 102 ms between them
  expect(glides.length - glided).toBeGreaterThan(7);
  expect(glides.length - glided).toBeLessThan(12);
  expect(store.flight.moment.value.sample?.t_s).toBeGreaterThan(1.8);
});

test("news is drawn with the next frame", () => {
  const { receive, store, at } = drawn();
  vi.advanceTimersByTime(5);
  const before = at.length;
  receive(tick(0.2, [modeChanged(0.2, "capture"), sample(0.2)]), performance.now());
  vi.advanceTimersByTime(17);
  expect(at.length).toBe(before + 1);
  expect(store.flight.moment.value.mode?.mode).toBe("capture");
});

test("a hidden page is given no frames, and hears all the same", () => {
  vi.stubGlobal("requestAnimationFrame", () => 0);
  const hidden = vi.spyOn(document, "hidden", "get").mockReturnValue(true);
  const { receive, store } = drawn();
  receive(tick(1, [sample(1)]), performance.now());
  vi.advanceTimersByTime(300);
  expect(store.flight.moment.value.sample?.t_s).toBe(1);
  hidden.mockRestore();
  vi.unstubAllGlobals();
});

test("a stick that moves is no news for the display: 20 orders a second draw it no oftener", () => {
  const stick = { kind: "stick", roll: 0.5, pitch: 0, ident: "" } as const;
  const drawsOf = (orders: readonly Document[]) => {
    const { receive, at } = drawn();
    const before = at.length;
    for (let t = 1; t < 2; t += 0.05) {
      receive(
        tick(t, [...orders.map((each) => ({ ...each, t_s: t })), sample(t)]),
        performance.now(),
      );
      vi.advanceTimersByTime(50);
    }
    return at.length - before;
  };
  const calm = drawsOf([]);
  expect(drawsOf([{ kind: "command_given", t_s: 1, command: stick }])).toBe(calm);
  expect(drawsOf([modeChanged(1)])).toBeGreaterThan(calm);
});

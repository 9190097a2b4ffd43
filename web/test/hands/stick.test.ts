import { describe, expect, test } from "vitest";
import { readController } from "../../src/hands/controller";
import { createFrames } from "../../src/hands/frames";
import { createLatency } from "../../src/hands/latency";
import { nextStep, toward } from "../../src/hands/steps";
import { type Deflection, keyed, NEUTRAL, sayStick, shaped, together } from "../../src/hands/stick";
import { tick } from "../samples";

const roll = (part: number): Deflection => ({ roll: part, pitch: 0 });

describe("the stick", () => {
  test("a key deflects it at once, and it springs back within half a second", () => {
    expect(keyed(0, 1, 0)).toBeGreaterThan(0);
    let held = 0;
    for (let at = 0; at < 500; at += 16) held = keyed(held, -1, 16);
    expect(held).toBe(-1);
    for (let at = 0; at < 500; at += 16) held = keyed(held, 0, 16);
    expect(held + 0).toBe(0);
    expect(keyed(-0.5, 1, 0)).toBeGreaterThan(0); // the other key answers at once, too
  });

  test("a controller at rest is neutral, and its whole way is the whole way", () => {
    for (const raw of [0, 0.05, -0.08]) expect(shaped(raw) + 0).toBe(0);
    expect([shaped(1), shaped(-1)]).toEqual([1, -1]);
    const ways = Array.from({ length: 21 }, (_, k) => shaped(-1 + k / 10));
    expect(ways).toEqual(ways.toSorted((a, b) => a - b));
    for (const raw of [0.2, 0.5, 0.9]) {
      expect(shaped(raw)).toBeLessThan(raw);
      expect(shaped(-raw)).toBe(-shaped(raw));
    }
  });

  test("the input that deflects it most has it, axis by axis, in hundredths", () => {
    const both = [roll(0.2), { roll: -0.456, pitch: 0.1 }, { roll: 0, pitch: -0.7 }];
    expect(together(both)).toEqual({ roll: -0.46, pitch: -0.7 });
    expect(together([roll(7)])).toEqual(roll(1));
    expect(together([roll(-0.001)])).toEqual(NEUTRAL);
  });

  test("what is said of it", () => {
    expect(sayStick(NEUTRAL)).toBe("Stick neutral");
    expect(sayStick({ roll: 0.41, pitch: -0.2 })).toBe("Stick 40 % right, 20 % pushed");
    expect(sayStick({ roll: -1, pitch: 0.02 })).toBe("Stick 100 % left");
  });
});

describe("controllers", () => {
  const pad = (axes: number[], connected = true) => ({ id: "Pad (Vendor: 1)", axes, connected });

  test("the first that is there is read; one that is gone, or has no axes, is not", () => {
    expect(readController([null, pad([]), pad([1, 0], false)])).toBeNull();
    expect(readController([null, pad([-1, 1, 0, 0])])).toEqual({
      name: "Pad",
      stick: { roll: -1, pitch: 1 },
    });
  });
});

describe("steps of bank", () => {
  test("lead to the next five degrees, and no farther than a stick rolls", () => {
    expect([0, 2, 4.5, 5, 13, -3].map((bank) => nextStep(bank, 1))).toEqual([5, 5, 10, 10, 15, 0]);
    expect([0, -2, -4.5, 3].map((bank) => nextStep(bank, -1) + 0)).toEqual([-5, -5, -10, 0]);
    expect([nextStep(44, 1), nextStep(-45, -1)]).toEqual([45, -45]);
  });

  test.each([1, 2, 5])(
    "are flown without overshoot at ×%i, through delay and roll mode",
    (rate) => {
      const [lag, step, most] = [0.5, 0.05, 3.75]; // roll mode [s], step [s of flight], rate of roll [°/s]
      const seen: number[] = [];
      let [bank, rolling, stick, highest] = [0, 0, 0, 0];
      for (let t = 0; t < 30; t += step) {
        seen.push(bank);
        const old = seen.at(-1 - Math.round((0.12 * rate) / step)) ?? 0; // seen 120 ms of the viewer late
        if (Math.round(t / step) % rate === 0) stick = toward(5, old, rate);
        rolling += ((stick * most - rolling) * step) / lag;
        bank += rolling * step;
        highest = Math.max(highest, bank);
      }
      expect(Math.abs(bank - 5)).toBeLessThan(0.5);
      expect(highest).toBeLessThan(6);
    },
  );
});

describe("frames of the stick", () => {
  test("20 a second at most while it moves, each 0.2 s while it is held, one at release, then none", () => {
    const frames = createFrames();
    const sent: [number, number][] = [];
    const at = (now: number, stick: Deflection) => {
      if (frames.due(stick, now) !== null) sent.push([now, stick.roll]);
    };
    for (let now = 0; now < 300; now += 10) at(now, roll((now + 1) / 1000));
    expect(sent.map(([now]) => now)).toEqual([0, 50, 100, 150, 200, 250]);
    sent.length = 0;
    for (let now = 300; now < 1000; now += 10) at(now, roll(1));
    expect(sent.map(([now]) => now)).toEqual([300, 500, 700, 900]);
    sent.length = 0;
    for (let now = 1000; now < 3000; now += 10) at(now, NEUTRAL);
    expect(sent).toEqual([[1000, 0]]);
  });
});

describe("the delay from stick to picture", () => {
  const heard = (...parts: number[]) =>
    tick(
      1,
      parts.map((part) => ({
        kind: "command_given",
        t_s: 1,
        command: { kind: "stick", roll: part, pitch: 0, ident: "" },
      })),
    );

  test("is from the first move that a frame tells of to the frame drawn after the flight has it", () => {
    const latency = createLatency();
    latency.moved(roll(0.1), 1000);
    latency.sent();
    latency.moved(roll(0.2), 1010);
    latency.moved(roll(0.3), 1030);
    latency.sent(); // tells of both
    expect(latency.heard(heard(0.1))).toBe(true);
    latency.drawn(1060);
    expect(latency.heard(heard())).toBe(false);
    expect(latency.heard(heard(0.3))).toBe(true);
    latency.drawn(1090);
    expect(latency.measure()).toMatchObject({ half: 60, most: 80 });
  });

  test("what was never flown is not waited for, and what another has sent is not counted", () => {
    const latency = createLatency();
    latency.moved(roll(0.5), 0);
    latency.sent();
    latency.moved(NEUTRAL, 5000);
    latency.sent();
    latency.moved(roll(0.5), 5100);
    latency.sent();
    expect(latency.heard(heard(0.7))).toBe(false);
    latency.heard(heard(0, 0.5));
    latency.drawn(5150);
    expect(latency.measure()).toMatchObject({ half: 50, most: 150 });
  });

  test("frames are those of the last second", () => {
    const latency = createLatency();
    for (let now = 0; now < 3000; now += 20) latency.frame(now);
    expect(latency.measure()).toEqual({ framesPerSecond: 50, half: null, most: null });
  });
});

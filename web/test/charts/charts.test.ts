import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { aheadOf } from "../../src/charts/ahead";
import { apartLabels, boundsOf, ticksOf, timesOf } from "../../src/charts/scale";
import { type Line, type Strip, spanOf, stripsOf, valueAt } from "../../src/charts/strips";
import { chartSvg } from "../../src/charts/svg";
import { createHistory, momentAt } from "../../src/store/history";
import { NM } from "../../src/units";
import { historyOf } from "../flights/recorded";

const [A, B] = [historyOf("fig_6a"), historyOf("fig_6b")];

function find(strips: readonly Strip[], name: string, label: string): [Strip, Line] {
  const strip = strips.find((each) => each.name === name);
  const line = strip?.lines.find((each) => each.label === label);
  if (strip === undefined || line === undefined) throw new Error(`no ${name} ${label}`);
  return [strip, line];
}

describe("strips", () => {
  const strips = stripsOf(A, aheadOf(momentAt(A, 845)), { name: "6B", history: B, offset: 0 });

  test("say what the samples say, in the units of the page", () => {
    const [strip, line] = find(strips, "separation", "d");
    expect(valueAt(strip, line, 845)).toBeCloseTo(
      (A.knots.sampleAt(845)?.separation_m ?? 0) / NM,
      6,
    );
    expect(find(strips, "separation", "d")[0].levels.map(({ label }) => label)).toEqual([
      "MIN",
      "PROVED",
    ]);
  });

  test("have the plan as it was at the instant, and nothing of it before it was made", () => {
    const plan = momentAt(A, 845).plan;
    const [bank, planned] = find(strips, "bank", "PLAN");
    expect(valueAt(bank, planned, (plan?.t_s ?? 0) - 5)).toBeNull();
    const turn = plan?.plan.segments.find(({ kind }) => kind === "turn");
    const middle = (plan?.t_s ?? 0) + ((turn?.start.t_s ?? 0) + (turn?.end.t_s ?? 0)) / 2;
    expect(Math.abs(valueAt(bank, planned, middle) ?? 0)).toBeCloseTo(25, 6);
    expect(valueAt(bank, planned, (plan?.t_s ?? 0) + 2000)).toBeNull();
  });

  test("turn through north without a jump", () => {
    const crossing = createHistory();
    const documents = historyOf("fig_6a").events.slice(0, 1);
    crossing.merge(documents);
    const [strip, line] = find(strips, "heading", "FLOWN");
    const steps = line.values
      .slice(1)
      .map((value, k) => Math.abs((value ?? 0) - (line.values[k] ?? 0)));
    expect(Math.max(...steps.filter((_, k) => (strip.times[k + 1] ?? 0) <= 1136))).toBeLessThan(4);
    expect(stripsOf(crossing, null, null)).toEqual([]);
  });

  test("have the other flight at its own time, and nothing of it after its end", () => {
    const shifted = stripsOf(A, null, { name: "6B", history: B, offset: -100 });
    const [strip, line] = find(shifted, "speed", "6B");
    const there = B.knots.sampleAt(700)?.pursuer.tas_mps ?? 0;
    expect(valueAt(strip, line, 800)).toBeCloseTo((there * 3600) / 1852, 3);
    expect(valueAt(strip, line, 50)).toBeNull();
    const [same, theirs] = find(strips, "separation", "6B");
    expect(valueAt(same, theirs, 1100)).toBeNull();
  });

  test("reach to the end of what is known of the way", () => {
    const early = historyOf("fig_6b", 300);
    const ahead = aheadOf(momentAt(early, 300));
    const made = stripsOf(early, ahead, null);
    expect(spanOf(made).to).toBeGreaterThan(900);
    const [strip, line] = find(made, "separation", "FORECAST");
    expect(valueAt(strip, line, 800)).toBeGreaterThan(5);
    expect(valueAt(strip, find(made, "separation", "d")[1], 800)).toBeNull();
  });
});

describe("axes", () => {
  test("ticks are round and within", () => {
    expect(ticksOf(0.3, 4.2, 4)).toEqual([1, 2, 3, 4]);
    expect(timesOf(0, 1136)).toEqual([0, 300, 600, 900]);
    expect(ticksOf(-12, 31, 4)).toEqual([0, 20]);
  });

  test("levels are in sight, and labels at the ends of lines keep off each other", () => {
    const strips = stripsOf(A, aheadOf(momentAt(A, 845)), { name: "6B", history: B, offset: 0 });
    for (const strip of strips) {
      const [low, high] = boundsOf(strip, 1100, 1136);
      for (const { value } of strip.levels) {
        expect(value).toBeGreaterThan(low);
        expect(value).toBeLessThan(high);
      }
      const y = (value: number) => 92 - (92 * (value - low)) / (high - low);
      const labels = apartLabels(strip, 1136, y, 12, 5, 90);
      expect(labels).toHaveLength(strip.lines.length + strip.levels.length);
      labels.slice(1).forEach(({ at }, k) => {
        expect(at - (labels[k]?.at ?? 0)).toBeGreaterThanOrEqual(12 - 1e-9);
      });
    }
  });
});

test("the drawing stands alone: every colour is written out, and it says of which flight it is", () => {
  const strips = stripsOf(A, aheadOf(momentAt(A, 845)), { name: "6B", history: B, offset: 0 });
  const about = {
    title: "Fig. 6a <&>",
    source: "flight x · relguide 1",
    from: 0,
    to: 1136,
    cursor: 845,
  };
  const drawing = chartSvg(strips, about);
  const parsed = new DOMParser().parseFromString(drawing, "image/svg+xml");
  expect(parsed.querySelector("parsererror")).toBeNull();
  expect(drawing).not.toContain("var(");
  expect(drawing).not.toContain("NaN");
  expect(drawing).toContain("Fig. 6a &lt;&amp;&gt;");
  expect(drawing).toContain("flight x · relguide 1");
  for (const { title, unit } of strips) expect(drawing).toContain(`${title} [${unit}]`);
  // lines of a strip are told apart without colour
  for (const { lines } of strips) {
    const dashes = lines.map(({ dash }) => dash);
    expect(new Set(dashes).size).toBe(dashes.length);
  }
  expect(drawing.length).toBeLessThan(800_000);
});

test("uPlot is loaded by the charts alone", () => {
  const files = ["main.tsx", "cockpit.tsx", "session.ts", "actions.ts"];
  for (const file of files) expect(readFileSync(`src/${file}`, "utf8")).not.toMatch(/from "uplot"/);
});

import { expect, test } from "vitest";
import { ActivePath } from "../../src/nd/plan";
import { toMap } from "../../src/nd/view";
import { amend } from "../samples";
import { mount, screenOf } from "./draw";
import { flightAt, forecastOf } from "./fixture";

function strokes(root: Element, width: string): string[] {
  return [...root.querySelectorAll(`.nd-stroke[stroke-width='${width}']`)]
    .map((path) => path.getAttribute("d") ?? "")
    .filter((data) => data !== "");
}

function points(data: string): [number, number][] {
  return [...data.matchAll(/[ML](\S+) ([^ML]+)/g)].map(([, x, y]) => [Number(x), Number(y)]);
}

function picture(t: number, mode: "converge" | "follow" | "escape" = "converge") {
  const flight = flightAt("fig_6b", t, mode);
  amend(flight, { forecast: forecastOf("fig_6b") });
  const { shown, view } = screenOf(flight, "ARC", 10);
  return { flight, view, root: mount(ActivePath, { shown, view }) };
}

test("the layer draws exactly the points of the forecast, solid, from own ship on", () => {
  const { flight, view, root } = picture(0);
  const forecast = flight.moment.value.forecast;
  if (forecast === null) throw new Error("A flight without a forecast.");
  const [current, coming] = strokes(root, "3").map(points);
  const expected = forecast.times_s.map((_, k) => {
    const at = { x_m: forecast.x_m[k] ?? 0, y_m: forecast.y_m[k] ?? 0 };
    const { x, y } = toMap(view.layout.value, at);
    return [x, y];
  });
  const drawn = [current?.[0], ...(coming ?? [])];
  expect(drawn.length).toBe(expected.length);
  for (const [k, [x, y]] of drawn.map((each) => each ?? [0, 0]).entries()) {
    expect(x).toBeCloseTo(expected[k]?.[0] ?? 0, 1);
    expect(y).toBeCloseTo(expected[k]?.[1] ?? 0, 1);
  }
  expect(current?.[1]).toEqual(coming?.[0]);
});

test("the plan's ideal path is a thin line under it, and goes with the plan", () => {
  const engaged = picture(300).root;
  expect(strokes(engaged, "1").length).toBeGreaterThan(0);
  const widths = [...engaged.querySelectorAll(".nd-stroke")].map((path) =>
    path.getAttribute("stroke-width"),
  );
  expect(widths.lastIndexOf("1")).toBeLessThan(widths.indexOf("3"));
  const turnedAway = picture(300, "escape").root;
  expect(strokes(turnedAway, "1")).toEqual([]);
  expect(strokes(turnedAway, "3").length).toBeGreaterThan(0);
});

test("what is flown is gone, and so is what lies beyond the join", async () => {
  const { flight, root } = picture(400);
  const forecast = flight.moment.value.forecast;
  if (forecast === null) throw new Error("A flight without a forecast.");
  const left = forecast.times_s.filter((t) => t > 400).length;
  expect(points(strokes(root, "3")[1] ?? "").length).toBe(left);
  const sample = flight.moment.value.sample;
  if (sample === null) throw new Error("An empty flight.");
  amend(flight, { sample: { ...sample, time_to_go_s: 100 } });
  await new Promise((done) => setTimeout(done, 0));
  const shorter = points(strokes(root, "3")[1] ?? "");
  expect(shorter.length).toBeLessThan(left);
});

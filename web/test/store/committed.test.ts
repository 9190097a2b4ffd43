import { expect, test } from "vitest";
import {
  closestApproach,
  committedPoint,
  flownPlan,
  joinPoint,
  nextTurn,
  timeToJoin,
} from "../../src/store/committed";
import { forecastPoint } from "../../src/store/forecast";
import { documentsOf, flightAt, forecastOf } from "../nd/fixture";
import { amend, planChanged, point, rightTurn, straight, unable } from "../samples";

test("the next turn is the one that begins next; a correction is none", () => {
  const lead = straight(point(0, 0, 0, 0), 60, 100);
  const turn = rightTurn(90);
  const later = (p: typeof turn.start) => ({ ...p, t_s: p.t_s + 60 });
  const moved = { ...turn, start: later(turn.start), end: later(turn.end) };
  const correction = { ...rightTurn(0.4), direction: "left" as const };
  const changed = planChanged(100, { segments: [correction, lead, moved] });
  expect(nextTurn(changed, 130)).toMatchObject({ name: "T1", size: "R90", at: 160, in: 30 });
  expect(nextTurn(changed, 161)).toBeNull();
  const atOnce = planChanged(0, { segments: [rightTurn(90)] });
  expect(nextTurn(atOnce, 0)).toMatchObject({ name: "T1", in: 0 });
});

test("a plan that was given up is flown no more", () => {
  const plan = documentsOf("fig_6b").plan;
  for (const mode of ["converge", "capture"] as const)
    expect(flownPlan(flightAt("fig_6b", 300, mode).moment.value)).toBe(plan);
  for (const mode of ["heading", "escape", "follow"] as const)
    expect(flownPlan(flightAt("fig_6b", 300, mode).moment.value)).toBeNull();
  const flight = flightAt("fig_6b", 300);
  amend(flight, { unable: unable(300) });
  expect(flownPlan(flight.moment.value)).toBeNull();
});

test("where it joins, and how close it comes, are the forecast's", () => {
  const flight = flightAt("fig_6b", 300);
  const forecast = forecastOf("fig_6b");
  const ideal = committedPoint(flight.moment.value, 600);
  amend(flight, { forecast: forecast });
  const flown = committedPoint(flight.moment.value, 600);
  expect(flown).toEqual(forecastPoint(forecast, 600));
  expect(
    Math.hypot((flown?.x_m ?? 0) - (ideal?.x_m ?? 0), (flown?.y_m ?? 0) - (ideal?.y_m ?? 0)),
  ).toBeGreaterThan(100);
  expect(closestApproach(flight.moment.value)?.least).toBe(forecast.least_separation_m);
  const left = timeToJoin(flight.moment.value) ?? Number.NaN;
  expect(joinPoint(flight.moment.value)?.t_s).toBeCloseTo(300 + left, 0);
});

test("a forecast that ends too early says nothing of the join: the plan does", () => {
  const flight = flightAt("fig_6b", 300);
  const whole = forecastOf("fig_6b");
  const few = { times_s: [300, 330], x_m: [0, 1], y_m: [0, 1], heading_deg: [90, 90] };
  amend(flight, { forecast: { ...whole, ...few } });
  const plan = documentsOf("fig_6b").plan;
  expect(closestApproach(flight.moment.value)?.least).toBe(plan.plan.separation.least_m);
  expect(joinPoint(flight.moment.value)?.x_m).toBeCloseTo(
    plan.plan.segments.at(-1)?.end.x_m ?? 0,
    -1,
  );
});

test("a column point between two is between them, its heading the shorter way round", () => {
  const forecast = {
    ...forecastOf("fig_6b"),
    times_s: [0, 10, 20],
    x_m: [0, 100, 200],
    y_m: [0, 0, 50],
    heading_deg: [358, 2, 2],
  };
  expect(forecastPoint(forecast, 5)).toEqual({ t_s: 5, x_m: 50, y_m: 0, heading_deg: 0 });
  expect(forecastPoint(forecast, 15)).toMatchObject({ x_m: 150, y_m: 25, heading_deg: 2 });
  expect(forecastPoint(forecast, 99)).toMatchObject({ x_m: 200, y_m: 50 });
});

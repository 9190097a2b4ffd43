/** What is uncertain: the fan of joins, the width of the path, and a join that moves. */

import { describe, expect, test } from "vitest";
import { Fan, fanLabels } from "../../src/nd/fan";
import { Tube } from "../../src/nd/tube";
import { project, toMap } from "../../src/nd/view";
import { noticesOf } from "../../src/store/notices";
import { numbersOf } from "../../src/store/numbers";
import { NOTHING_KNOWN, reduce } from "../../src/store/reduce";
import type { FanChanged, PromiseChanged } from "../../src/wire";
import { amend, OWN, planChanged, STARTED } from "../samples";
import { mount, screenOf } from "./draw";
import { flightAt, forecastOf } from "./fixture";

const T = 100;
const FAN: FanChanged = {
  kind: "fan_changed",
  t_s: T,
  ident: OWN,
  joins: [-30, -20, -10, 0, 10, 20, 30].map((turn) => ({
    turn_deg: turn,
    joins_s: T + 300 + 2 * turn,
    x_m: 20_000 - 100 * turn,
    y_m: -500 * turn,
    least_m: 9_400,
  })),
  most_saved_s: 135,
  mean_saved_s: 78,
};

function flightWith(fan: FanChanged | null) {
  const flight = flightAt("fig_6a", T);
  amend(flight, { fan });
  return flight;
}

describe("the fan", () => {
  test("has a ray from the leader to each join but the path's own, and a hollow sign at its end", () => {
    const flight = flightWith(FAN);
    const { shown, view } = screenOf(flight, "ARC", 80);
    const root = mount(Fan, { shown, view });
    const [rays, signs] = [...root.querySelectorAll(".nd-stroke")];
    const data = rays?.getAttribute("d") ?? "";
    const ends = [...data.matchAll(/M(\S+ \S+)L(\S+) ([^M]+)/g)];
    expect(ends).toHaveLength(6);
    const leader = shown.picture.value.leader;
    if (leader === null) throw new Error("No leader.");
    const { x, y } = toMap(view.layout.value, leader);
    for (const [, from] of ends)
      expect(from).toBe(`${Math.round(10 * x) / 10} ${Math.round(10 * y) / 10}`);
    expect(rays?.getAttribute("stroke-dasharray")).not.toBe("");
    expect(signs?.getAttribute("stroke-dasharray")).toBe("");
    expect((signs?.getAttribute("d") ?? "").match(/Z/g)).toHaveLength(6);
  });

  test("says at each end how long until own ship would join", () => {
    const flight = flightWith(FAN);
    const { shown, view } = screenOf(flight, "ARC", 80);
    const labels = fanLabels({ shown, view });
    const times = new Map(labels.map(({ id, lines }) => [id, lines[0]?.text]));
    expect(times.get("fan -30")).toBe("04:00");
    expect(times.get("fan 30")).toBe("06:00");
    expect(times.has("fan 0")).toBe(false);
    const pose = view.pose.value;
    const join = FAN.joins[0];
    if (pose === null || join === undefined) throw new Error("Nothing to look at.");
    expect(labels.find(({ id }) => id === "fan -30")?.at).toEqual(
      project(view.layout.value, pose, join),
    );
  });

  test("is drawn only while the intent is not known, and a path is proposed or flown", () => {
    const drawn = (flight: ReturnType<typeof flightAt>) =>
      mount(Fan, screenOf(flight, "ARC", 80)).querySelectorAll(".nd-fan").length;
    expect(drawn(flightWith(FAN))).toBe(1);
    expect(drawn(flightWith(null))).toBe(0);
    const following = flightAt("fig_6a", T, "follow");
    amend(following, { fan: FAN });
    expect(drawn(following)).toBe(0);
  });

  test("is closed by one without joins", () => {
    const begun = [STARTED, FAN].reduce(reduce, NOTHING_KNOWN);
    expect(begun.fan).toEqual(FAN);
    expect(reduce(begun, { ...FAN, joins: [] }).fan).toBeNull();
  });

  test("what knowing saves is a number; a few seconds are none", () => {
    expect(numbersOf(flightWith(FAN).moment.value).saving).toBe("02:15, on average 01:18");
    expect(numbersOf(flightWith({ ...FAN, most_saved_s: 3 }).moment.value).saving).toBe("");
  });
});

describe("the width of the path", () => {
  function edges(aside: number): string {
    const flight = flightAt("fig_6b", T);
    const forecast = forecastOf("fig_6b");
    const aside_m = forecast.times_s.map((t) => (aside * t) / 900);
    amend(flight, { forecast: { ...forecast, aside_m } });
    const root = mount(Tube, screenOf(flight, "ARC", 40));
    return root.querySelector(".nd-stroke")?.getAttribute("d") ?? "";
  }

  test("is two edges, one on each side", () => {
    expect(edges(3_000).match(/M/g)).toHaveLength(2);
  });

  test("is not drawn where it would not be told from the path", () => {
    expect(edges(0)).toBe("");
    expect(edges(50)).toBe("");
  });
});

describe("a join that moves", () => {
  const moved: PromiseChanged = {
    kind: "promise_changed",
    t_s: T,
    ident: OWN,
    promised_s: 218,
    was_s: 48,
    message: "Joins in 3 min 38 s, was 0 min 48 s.",
  };

  test("is on the message line with both times, for a while", () => {
    const texts = (t: number) => {
      const flight = flightAt("fig_6a", t);
      amend(flight, { promise: moved });
      return noticesOf(flight.moment.value).map(({ text }) => text);
    };
    expect(texts(T + 2)).toContain("JOIN 03:38 WAS 00:48");
    expect(texts(T + 30)).not.toContain("JOIN 03:38 WAS 00:48");
  });

  test("of a recording that does not say what it was has the new time alone", () => {
    const flight = flightAt("fig_6a", T + 2);
    const { was_s: _, ...old } = moved;
    amend(flight, { promise: old });
    expect(noticesOf(flight.moment.value).map(({ text }) => text)).toContain("JOIN 03:38");
  });

  test("holds until a plan is announced: what is not announced says nothing", () => {
    const known = [STARTED, planChanged(0), moved].reduce(reduce, NOTHING_KNOWN);
    const silent = { ...planChanged(T + 1), announced: false };
    expect(reduce(known, silent).promise).toEqual(moved);
    expect(reduce(known, planChanged(T + 2)).promise).toBeNull();
    expect(known.messages[0]?.text).toContain("was 0 min 48 s");
  });
});

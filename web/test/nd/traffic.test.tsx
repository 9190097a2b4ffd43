import { batch } from "@preact/signals";
import { render } from "preact";
import { act } from "preact/test-utils";
import { expect, test } from "vitest";
import { chooseLabels } from "../../src/nd/labelled";
import { NavigationDisplay } from "../../src/nd/nd";
import { OffScaleTraffic, TrafficSymbols } from "../../src/nd/traffic";
import { hatchOf, Weather } from "../../src/nd/weather";
import type { Flight } from "../../src/store/types";
import { elementOf } from "../../src/words";
import { aircraft, alert, amend } from "../samples";
import { mount, screenOf } from "./draw";
import { flightAt } from "./fixture";

const FT = 0.3048;

/** Fig. 6b with others: so far ahead and to the right of own ship [NM], so high over it [ft]. */
function among(
  ...others: {
    ident: string;
    ahead: number;
    right?: number;
    height?: number;
    level?: "caution" | "warning";
  }[]
): Flight {
  const flight = flightAt("fig_6b", 60);
  const { now, started } = flight.moment.value;
  if (now === null || started === null) throw new Error("An empty flight.");
  const psi = (now.pursuer.heading_deg * Math.PI) / 180;
  const seen = others.map(({ ident, ahead, right = 0, height = 0 }) =>
    aircraft({
      ident,
      x_m: now.pursuer.x_m + 1852 * (ahead * Math.sin(psi) + right * Math.cos(psi)),
      y_m: now.pursuer.y_m + 1852 * (ahead * Math.cos(psi) - right * Math.sin(psi)),
      altitude_m: now.pursuer.altitude_m + height * FT,
      track_deg: now.pursuer.heading_deg + 90,
    }),
  );
  const sample = { ...now, others: seen };
  amend(flight, {
    sample,
    now: sample,
    started: {
      ...started,
      others: seen.map(({ ident }) => ({ ident, aircraft_type: "", max_bank_deg: 0, follows: "" })),
    },
    alerts: others.flatMap(({ ident, level }) =>
      level === undefined ? [] : [alert(50, { other: ident, level })],
    ),
    climbs: new Map([["UP1", (600 * FT) / 60]]),
  });
  return flight;
}

function symbol(root: Element, ident: string): Element | null {
  return root.querySelector(`[data-ident="${ident}"]`);
}

test("each symbol says by its shape how urgent it is, and points along its track", () => {
  const flight = among(
    { ident: "FAR", ahead: 15 },
    { ident: "NEAR", ahead: 3, right: 3 },
    { ident: "CAUT", ahead: 10, level: "caution" },
    { ident: "WARN", ahead: 6, right: -4, level: "warning" },
  );
  const root = mount(TrafficSymbols, screenOf(flight, "ROSE", 40));
  const look = (ident: string) => {
    const found = symbol(root, ident);
    return {
      hollow: found?.querySelectorAll(".nd-hollow").length,
      disc: found?.querySelectorAll("circle.nd-solid").length,
      solid: found?.querySelectorAll("path.nd-solid").length,
    };
  };
  expect(look("FAR")).toEqual({ hollow: 1, disc: 0, solid: 0 });
  expect(look("NEAR")).toEqual({ hollow: 0, disc: 0, solid: 1 });
  expect(look("CAUT")).toEqual({ hollow: 0, disc: 1, solid: 1 });
  expect(look("WARN")).toEqual({ hollow: 0, disc: 0, solid: 2 });
  for (const ident of ["FAR", "NEAR", "CAUT", "WARN"])
    expect(symbol(root, ident)?.querySelector("g")?.getAttribute("transform")).toBe("rotate(90)");
  for (const mark of root.querySelectorAll("path, text"))
    expect(elementOf(mark)?.title).toBe("Other aircraft");
});

test("levels are in hundreds of feet, above the symbol if higher, with an arrow from 500 ft a minute", () => {
  const flight = among(
    { ident: "UP1", ahead: 8, height: 1200 },
    { ident: "LOW", ahead: 8, right: 6, height: -540 },
  );
  const root = mount(TrafficSymbols, screenOf(flight, "ROSE", 40));
  const text = (ident: string) => symbol(root, ident)?.querySelector("text");
  expect(text("UP1")?.textContent).toBe("+12");
  expect(Number(text("UP1")?.getAttribute("y"))).toBeLessThan(0);
  expect(text("LOW")?.textContent).toBe("−05");
  expect(Number(text("LOW")?.getAttribute("y"))).toBeGreaterThan(0);
  expect(symbol(root, "UP1")?.querySelectorAll(".nd-halo")).toHaveLength(1);
  expect(symbol(root, "LOW")?.querySelectorAll(".nd-halo")).toHaveLength(0);
});

test("what is 9,900 ft away is left out unless an alert stands; far out, levels and idents go", () => {
  const flight = among(
    { ident: "HIGH", ahead: 10, height: 12_000 },
    { ident: "HIGH2", ahead: 10, right: 8, height: 12_000, level: "caution" },
    { ident: "FAR", ahead: 30 },
  );
  const near = screenOf(flight, "ROSE", 80);
  const root = mount(TrafficSymbols, near);
  expect(symbol(root, "HIGH")).toBeNull();
  expect(symbol(root, "HIGH2")).not.toBeNull();
  expect(symbol(root, "FAR")?.querySelector("text")?.textContent).toBe("+00");
  const names = (range: number) =>
    chooseLabels(screenOf(flight, "ROSE", range)).map(({ label }) => label.id);
  expect(names(160)).toContain("traffic HIGH2");
  expect(names(160)).not.toContain("traffic FAR");
  const far = mount(TrafficSymbols, screenOf(flight, "ROSE", 160));
  expect(symbol(far, "FAR")?.querySelector("text")).toBeNull();
});

test("off the map, only what alerts has half a symbol on the edge", () => {
  const flight = among(
    { ident: "OUT", ahead: 60 },
    { ident: "WARN", ahead: 60, right: 5, level: "warning" },
  );
  const screen = screenOf(flight, "ROSE", 20);
  const root = mount(OffScaleTraffic, screen);
  expect(symbol(root, "OUT")).toBeNull();
  expect(symbol(root, "WARN")).not.toBeNull();
  expect(chooseLabels(screen).map(({ label }) => label.lines[0]?.text)).toContain("WARN");
});

test("a click shows ident, distance, speed and closest approach, and another takes them away", () => {
  const flight = among({ ident: "BAW12", ahead: 9 });
  const { shown, mode, range } = screenOf(flight, "ROSE", 40);
  const root = document.body.appendChild(document.createElement("div"));
  act(() => render(<NavigationDisplay shown={shown} mode={mode} range={range} />, root));
  const click = () =>
    act(() => {
      symbol(root, "BAW12")
        ?.querySelector(".nd-touch")
        ?.dispatchEvent(new Event("click", { bubbles: true }));
    });
  click();
  expect(shown.chosen.value).toBe("BAW12");
  expect(root.textContent).toMatch(/BAW129\.0 NM 467 KTCPA \d+\.\d NM \d\d:\d\d/);
  click();
  expect(shown.chosen.value).toBeNull();
  root.remove();
});

test("a cell is hatched inside its edge, and dashed where it will be", () => {
  const flight = among();
  const { started, now } = flight.moment.value;
  if (started === null || now === null) throw new Error("An empty flight.");
  const { x_m, y_m } = now.pursuer;
  const cell = { ident: "CB1", x_m: [x_m + 9000], y_m: [y_m], radius_m: 6000 };
  batch(() =>
    amend(flight, {
      started: { ...started, cells: [{ ...cell, east_mps: 10, north_mps: 0, growth_mps: 0 }] },
    }),
  );
  const root = mount(Weather, screenOf(flight, "ROSE", 40));
  expect(root.querySelectorAll(".nd-weather [stroke-dasharray='9 7']")).not.toHaveLength(0);
  const square = [
    { x: 0, y: 0 },
    { x: 100, y: 0 },
    { x: 100, y: 100 },
    { x: 0, y: 100 },
  ];
  for (const [, x1, y1, x2, y2] of hatchOf(square).matchAll(/M(\S+) (\S+)L(\S+) (\S+?)(?=M|$)/g))
    for (const value of [x1, y1, x2, y2].map(Number)) {
      expect(value).toBeGreaterThanOrEqual(0);
      expect(value).toBeLessThanOrEqual(100);
    }
});

import { expect, test } from "vitest";
import { chooseLabels } from "../../src/nd/labelled";
import { type Label, placeLabels } from "../../src/nd/labels";
import { type Box, overlap, READOUTS } from "../../src/nd/view";
import { screenOf } from "./draw";
import { type FlightName, flightAt } from "./fixture";

const NO_SURROUNDINGS = { isSeen: () => true, boxes: [], points: [] };

function label(id: string, x: number, y: number, more: Partial<Label> = {}): Label {
  const lines = [{ text: "LABEL", colour: "label" as const }];
  return { id, at: { x, y }, lines, side: 90, gap: 10, size: 20, optional: false, ...more };
}

test("a label with room stands on the side it prefers", () => {
  const box = placeLabels([label("a", 384, 384)], NO_SURROUNDINGS, new Map()).get("a")?.box;
  expect(box?.x).toBeCloseTo(10, 6);
});

test("two labels of one point do not cover each other", () => {
  const labels = [label("a", 384, 384), label("b", 384, 384)];
  const placed = [...placeLabels(labels, NO_SURROUNDINGS, new Map()).values()];
  const [a, b] = placed.map(({ box }) => box) as [Box, Box];
  expect(overlap(a, b)).toBe(0);
});

test("a label that finds its old place nearly as good keeps it", () => {
  const first = placeLabels([label("a", 384, 384, { side: 45 })], NO_SURROUNDINGS, new Map());
  const before = new Map(first).set("a", {
    box: { x: 0, y: 0, width: 0, height: 0 },
    choice: "30 0",
  });
  const next = placeLabels([label("a", 384, 384, { side: 45 })], NO_SURROUNDINGS, before);
  expect(next.get("a")?.choice).toBe("30 0");
});

test("what may be left out is left out where there is no room", () => {
  const wall = { x: 0, y: 0, width: 768, height: 768 };
  const around = { ...NO_SURROUNDINGS, boxes: [wall] };
  const labels = [label("a", 384, 384, { optional: true }), label("b", 300, 300)];
  expect([...placeLabels(labels, around, new Map()).keys()]).toEqual(["b"]);
});

const FLIGHTS: [FlightName, "ROSE" | "ARC", number][] = [
  ["fig_6b", "ROSE", 80],
  ["fig_6b", "ARC", 40],
  ["fig_6b", "ARC", 80],
  ["fig_6a", "ROSE", 80],
  ["fig_6b_wind", "ARC", 40],
  ["left", "ROSE", 80],
];

test.each(FLIGHTS)("no label of %s covers another or a readout, %s %i", (name, mode, range) => {
  for (let t = 0; t < 840; t += 20) {
    const flight = flightAt(name, t);
    const { shown, view } = screenOf(flight, mode, range);
    const boxes = chooseLabels({ shown, view }).map(({ label: { at }, placement: { box } }) => ({
      ...box,
      x: box.x + at.x,
      y: box.y + at.y,
    }));
    const others = [...boxes, ...Object.values(READOUTS)];
    boxes.forEach((box, i) => {
      for (const other of others.slice(i + 1))
        expect(overlap(box, other), `${name} at ${t} s`).toBeLessThan(1);
    });
  }
});

import { expect, test } from "vitest";
import { placeLabels } from "../src/nd/labels";
import { overlap } from "../src/nd/view";
import { type Camera, chaseCamera, see } from "../src/scene/camera";
import { posterCamera, strokesOf } from "../src/scene/poster";
import { aroundTexts, northOf, textsOf } from "../src/scene/texts";
import { emptyFlight } from "../src/store/flight";
import { createShown } from "../src/store/picture";
import { NM } from "../src/units";
import { flightAt, forecastOf } from "./nd/fixture";
import { flightIn } from "./nd/in-state";
import { amend } from "./samples";

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
/** 45° of view, as wide as high. */
const F = 1 / Math.tan(Math.PI / 8);
const PROJECTION = [F, 0, 0, 0, 0, F, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0];
/** At the origin of the scene, looking east. */
const EAST: Camera = { projection: PROJECTION, view: IDENTITY };
const ORIGIN = { x_m: 0, y_m: 0 };

test("a camera that looks east sees north on its left, heights twice as high, and nothing behind", () => {
  const at = (x_m: number, y_m: number, altitude_m: number) =>
    see(EAST, ORIGIN, { x_m, y_m, altitude_m });
  expect(at(10_000, 0, 0)).toEqual({ x: 0, y: 0 });
  expect(at(10_000, 1000, 0)?.x).toBeCloseTo(-F / 10, 9);
  expect(at(10_000, 0, 1000)?.y).toBeCloseTo((2 * F) / 10, 9);
  expect(at(-10_000, 0, 0)).toBeNull();
});

/** From above, so high that `half` [m] east and west of the middle is seen; north is up. */
function above(half: number): Camera {
  const high = (half / 1000) * F;
  // right is east (−z in what draws), up is north (−x), and it looks down (−y)
  const view = [0, -1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0, -high, 1];
  return { projection: PROJECTION, view };
}

test("north is up where it is drawn up", () => {
  const shown = createShown(flightAt("fig_6b", 300));
  expect(northOf(shown, above(60 * NM), { width: 600, height: 600 })).toBeCloseTo(0, 6);
});

test("texts stand beside what they name, in the glass and apart from each other", () => {
  const size = { width: 600, height: 400 };
  for (const t of [0, 150, 300, 450, 600, 750]) {
    const flight = flightAt("fig_6b", t);
    amend(flight, { forecast: forecastOf("fig_6b") });
    const shown = createShown(flight);
    const camera = above(90 * NM);
    const texts = textsOf(shown, camera, size);
    expect(texts.map(({ id }) => id)).toEqual(expect.arrayContaining(["own", "leader", "slot"]));
    const placed = placeLabels(texts, aroundTexts(shown, camera, size), new Map());
    const boxes = texts.map(({ id, at }) => {
      const box = placed.get(id)?.box ?? { x: 0, y: 0, width: 0, height: 0 };
      return { ...box, x: box.x + at.x, y: box.y + at.y };
    });
    boxes.forEach((box, i) => {
      for (const other of boxes.slice(i + 1)) expect(overlap(box, other), `${t} s`).toBeLessThan(1);
    });
  }
});

test("what is written is what the display says", () => {
  const shown = createShown(flightIn("proposed"));
  const texts = textsOf(shown, above(90 * NM), { width: 600, height: 600 });
  const lines = new Map(texts.map(({ id, lines }) => [id, lines]));
  const numbers = shown.numbers.value;
  expect(lines.get("join")).toEqual([{ text: `CNV ${numbers.toJoin}`, colour: "proposed" }]);
  expect(lines.get("min")?.[0]?.text).toBe(`MIN ${numbers.minSeparation}`);
  expect(lines.get("own")?.[1]?.text).toContain(`${numbers.gs} kt`);
  expect(lines.get("leader")?.[1]?.text).toContain(`${numbers.leaderSpeed} kt`);
  expect(
    textsOf(createShown(flightIn("off")), above(90 * NM), { width: 6, height: 6 }).some(
      ({ id }) => id === "slot" || id === "min",
    ),
  ).toBe(false);
});

test("the poster's camera stands where the scene's does, and sees the same", () => {
  const own = { x_m: -40_000, y_m: -20_000, altitude_m: 9000 };
  const leader = { x_m: 40_000, y_m: 20_000, altitude_m: 6000 };
  const { view } = chaseCamera(own, leader, 9260, 1.6);
  // what the server's `Cameras.eye` gives for the same pair: east, north, up
  const [east, north, up] = [-71.79093312354233, -35.895466561771165, 45.81073288587359 + 0];
  const eye = [-north, up, -east];
  for (const row of [0, 1, 2]) {
    const at = [0, 1, 2].reduce((sum, k) => sum + (view[4 * k + row] ?? 0) * (eye[k] ?? 0), 0);
    expect(at + (view[12 + row] ?? 0)).toBeCloseTo(0, 6);
  }
});

test.each([
  ["wide", { width: 900, height: 400 }],
  ["narrow", { width: 400, height: 900 }],
])("both aircraft and the minimum are in the poster, whatever its shape: %s", (_, size) => {
  for (const t of [0, 200, 500, 800]) {
    const flight = flightAt("fig_6b", t);
    amend(flight, { forecast: forecastOf("fig_6b") });
    const picture = createShown(flight).picture.value;
    const camera = posterCamera(picture, size);
    if (camera === null) throw new Error("A flight without a position.");
    const drawn = new Map(strokesOf(picture, camera, size).map(({ name, d }) => [name, d]));
    for (const name of ["own", "leader", "min"]) {
      const points = [...(drawn.get(name) ?? "").matchAll(/[ML](\S+) ([^MLZ]+)/g)];
      expect(points.length, name).toBeGreaterThan(3);
      // the tail of an aircraft that is drawn 80 times as large may reach a little further
      const middle = { x: 0, y: 0 };
      for (const [, x, y] of points) {
        middle.x += Number(x) / points.length / size.width;
        middle.y += Number(y) / points.length / size.height;
        for (const part of [Number(x) / size.width, Number(y) / size.height])
          expect(Math.abs(part - 0.5)).toBeLessThan(0.56);
      }
      for (const part of [middle.x, middle.y]) expect(Math.abs(part - 0.5)).toBeLessThan(0.5);
    }
  }
});

test("the poster draws the state: what is proposed is dashed, what is flown is solid", () => {
  const size = { width: 600, height: 400 };
  const pathIn = (state: "off" | "proposed" | "armed" | "converge") => {
    const flight = flightIn(state);
    amend(flight, { forecast: forecastOf("fig_6b") });
    const picture = createShown(flight).picture.value;
    const camera = posterCamera(picture, size);
    if (camera === null) throw new Error("A flight without a position.");
    return strokesOf(picture, camera, size).find(({ name }) => name === "path");
  };
  expect(pathIn("off")).toBeUndefined();
  expect([pathIn("proposed")?.colour, pathIn("proposed")?.dash]).toEqual(["proposed", "15 12"]);
  expect([pathIn("armed")?.colour, pathIn("armed")?.dash]).toEqual(["armed", "15 12"]);
  expect([pathIn("converge")?.colour, pathIn("converge")?.dash]).toEqual(["plan", ""]);
});

test("before the first position there is no poster", () => {
  expect(
    posterCamera(createShown(emptyFlight()).picture.value, { width: 9, height: 9 }),
  ).toBeNull();
});

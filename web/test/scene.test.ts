import { expect, test } from "vitest";
import { placeLabels } from "../src/nd/labels";
import { overlap } from "../src/nd/view";
import { type Camera, see } from "../src/scene/camera";
import { aroundTexts, northOf, textsOf } from "../src/scene/texts";
import { createShown } from "../src/store/picture";
import { NM } from "../src/units";
import { flightAt, forecastOf } from "./nd/fixture";
import { flightIn } from "./nd/in-state";

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
    flight.forecast.value = forecastOf("fig_6b");
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

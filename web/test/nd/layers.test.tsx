import { describe, expect, test } from "vitest";
import { MarginCircle } from "../../src/nd/margin";
import { GLASS_LAYERS, GROUND_LAYERS, MAP_LAYERS } from "../../src/nd/nd";
import { amend } from "../samples";
import { drawLayer, screenOf } from "./draw";
import { flightAt } from "./fixture";

const LAYERS = [...GROUND_LAYERS, ...MAP_LAYERS, ...GLASS_LAYERS];

const CASES = [
  { name: "converging", flight: flightAt("crossing", 60), mode: "ROSE", range: 40 },
  { name: "following", flight: flightAt("fig_6b", 900, "follow"), mode: "ARC", range: 20 },
  { name: "no_intent", flight: flightAt("fig_6a", 300), mode: "ARC", range: 80 },
] as const;

describe.each(CASES)("$name", ({ name, flight, mode, range }) => {
  test.each(LAYERS.map((layer) => [layer.name, layer] as const))("%s", async (title, layer) => {
    await expect(drawLayer(layer, screenOf(flight, mode, range))).toMatchFileSnapshot(
      `snapshots/${name}/${title}.svg`,
    );
  });
});

/** Where the leader's position is uncertain by so much [m]. */
function uncertain(margin_m: number) {
  const flight = flightAt("crossing", 60);
  if (flight.moment.value.now !== null)
    amend(flight, { now: { ...flight.moment.value.now, margin_m } });
  return drawLayer(MarginCircle, screenOf(flight, "ROSE", 40));
}

test("what is uncertain is a thin dashed ring round the minimum, if it can be told from it", async () => {
  await expect(uncertain(1852)).toMatchFileSnapshot("snapshots/uncertain/MarginCircle.svg");
  expect(uncertain(50)).not.toContain("circle");
  expect(uncertain(0)).not.toContain("circle");
});

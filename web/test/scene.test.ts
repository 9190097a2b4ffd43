import { signal } from "@preact/signals";
import { describe, expect, test } from "vitest";
import { placeLabels } from "../src/nd/labels";
import { overlap } from "../src/nd/view";
import {
  type Camera,
  cameraAt,
  enlargement,
  see,
  standFor,
  standOf,
  turned,
  VIEWS,
  zoomed,
} from "../src/scene/camera";
import { glassOf, type Size } from "../src/scene/glass";
import { sightsOf } from "../src/scene/poster";
import { middleOf, strokesOf } from "../src/scene/strokes";
import { aroundTexts, northOf, textsOf } from "../src/scene/texts";
import { emptyFlight } from "../src/store/flight";
import type { Picture } from "../src/store/picture";
import { createShown } from "../src/store/shown";
import type { Guidance } from "../src/store/states";
import type { Flight } from "../src/store/types";
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
function sampleOf(flight: Flight) {
  const { sample } = flight.moment.value;
  if (sample === null) throw new Error("A flight without a sample.");
  return sample;
}

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

const PRESETS = VIEWS.filter((view) => view !== "Free");

/** The camera of a view on a flight's picture. */
function cameraOf(picture: Picture, { width, height }: Size, view = PRESETS[0] ?? "Chase") {
  const sights = sightsOf(picture);
  if (sights === null) throw new Error("A flight without a position.");
  return cameraAt(standFor(view, sights, width / height), width / height);
}

/** What the server's `Cameras.standpoint` gives for the same pair in a window 1.6 as wide as high: east,
 * north, up. */
const STANDPOINTS = {
  Chase: [-76.26669068902781, -20.217280887241465, 38.54954820911401],
  Top: [2.5961408684568035, 43.668771875603525, 244.55054580743058],
  Side: [-3.4138565741883307, -93.83390496860248, 22.532507536053174],
} as const;

test.each(PRESETS)("the poster's camera stands where the server's does: %s", (view) => {
  const high = (x: number, y: number, z: number) => ({
    x_m: 1000 * x,
    y_m: 1000 * y,
    altitude_m: 500 * z,
  });
  const sights = {
    own: high(-40, -20, 18),
    leader: high(40, 20, 12),
    radius: 9260,
    length: 5400,
    ahead: [high(0, 60, 18), high(30, 120, 18)],
  };
  const camera = cameraAt(standFor(view, sights, 1.6), 1.6);
  const [east, north, up] = STANDPOINTS[view];
  const eye = [-north, up, -east];
  for (const row of [0, 1, 2]) {
    const at = [0, 1, 2].reduce(
      (sum, k) => sum + (camera.view[4 * k + row] ?? 0) * (eye[k] ?? 0),
      0,
    );
    // the server's north is a hundredth of a degree beside the page's, seen from above
    expect(at + (camera.view[12 + row] ?? 0)).toBeCloseTo(0, 1);
  }
});

describe.each(PRESETS)("%s", (view) => {
  test.each([
    ["wide", { width: 900, height: 400 }],
    ["narrow", { width: 400, height: 900 }],
  ])(
    "both aircraft, the minimum and the join are in the poster, whatever its shape: %s",
    (_, size) => {
      for (const t of [0, 200, 500, 800]) {
        const flight = flightAt("fig_6b", t);
        amend(flight, { forecast: forecastOf("fig_6b") });
        const picture = createShown(flight).picture.value;
        const { now, join } = picture;
        if (now === null || join === null) throw new Error("A flight without a join.");
        const glass = glassOf(cameraOf(picture, size, view), middleOf(now), size);
        const { altitude_m } = now.pursuer;
        for (const place of [now.pursuer, now.leader, { ...join, altitude_m }]) {
          const { x, y } = glass.at(place) ?? { x: Number.NaN, y: Number.NaN };
          expect(Math.abs(x / size.width - 0.5), `${t} s`).toBeLessThan(0.39);
          expect(Math.abs(y / size.height - 0.5), `${t} s`).toBeLessThan(0.39);
        }
        const drawn = strokesOf(picture, cameraOf(picture, size, view), size);
        const min = drawn.find(({ name }) => name === "min")?.d ?? "";
        const points = [...min.matchAll(/[ML](\S+) ([^MLZ]+)/g)];
        expect(points.length).toBeGreaterThan(60);
        for (const [, x, y] of points) {
          expect(Math.abs(Number(x) / size.width - 0.5)).toBeLessThan(0.39);
          expect(Math.abs(Number(y) / size.height - 0.5)).toBeLessThan(0.39);
        }
      }
    },
  );
});

test("a hand turns the camera round what it looks at, and brings it nearer", () => {
  const picture = createShown(flightAt("fig_6b", 300)).picture.value;
  const sights = sightsOf(picture);
  if (sights === null || picture.pose === null) throw new Error("A flight without a position.");
  const stand = standFor("Chase", sights, 1.6);
  expect(turned(stand, 100, 0).bearing).toBeCloseTo((stand.bearing + 30) % 360, 9);
  expect(turned(stand, 0, 1e5).elevation).toBeLessThan(90);
  expect(zoomed(stand, 0.5).distance).toBeCloseTo(stand.distance / 2, 9);
  expect(turned(stand, 100, 20).target).toEqual(stand.target);
  // a camera that is taken over from the server's picture stays where it is
  const camera = cameraAt(turned(stand, 40, 10), 1.6);
  const again = cameraAt(standOf(camera, picture.pose.altitude_m), 1.6);
  camera.view.forEach((each, k) => {
    expect(again.view[k]).toBeCloseTo(each, 6);
  });
});

test("aircraft are drawn smaller before they touch", () => {
  expect(enlargement(60_000)).toBe(100);
  for (const separation of [9000, 3000, 900])
    expect(54 * enlargement(separation)).toBeLessThanOrEqual(0.3 * separation);
});

const SIZE = { width: 600, height: 400 };

function strokesIn(flight: Flight) {
  amend(flight, { forecast: forecastOf("fig_6b") });
  const picture = createShown(flight).picture.value;
  return new Map(
    strokesOf(picture, cameraOf(picture, SIZE), SIZE).map((each) => [each.name, each]),
  );
}

test("the poster draws the state: what is proposed is dashed, what is flown is solid", () => {
  const pathIn = (state: Guidance) => strokesIn(flightIn(state)).get("path");
  expect(pathIn("off")).toBeUndefined();
  expect([pathIn("proposed")?.colour, pathIn("proposed")?.dash]).toEqual(["proposed", "15 12"]);
  expect([pathIn("armed")?.colour, pathIn("armed")?.dash]).toEqual(["armed", "15 12"]);
  expect([pathIn("converge")?.colour, pathIn("converge")?.dash]).toEqual(["plan", ""]);
});

test("joined, the gate leaves its middle free, and own ship is seen in it", () => {
  const open = strokesIn(flightIn("converge")).get("slot")?.d ?? "";
  const held = strokesIn(flightIn("follow")).get("slot")?.d ?? "";
  const lengths = (data: string) =>
    data
      .split("M")
      .slice(1)
      .map((piece) => piece.split("L").map((point) => point.split(" ").map(Number)))
      .map(([a, b]) => Math.hypot((a?.[0] ?? 0) - (b?.[0] ?? 0), (a?.[1] ?? 0) - (b?.[1] ?? 0)));
  expect(lengths(open)).toHaveLength(12);
  expect(lengths(held)).toHaveLength(24);
});

test("a lost minimum is red: the ring, the leader and a word", () => {
  const flight = flightIn("off");
  const near = { ...sampleOf(flight), separation_m: 3000 };
  amend(flight, { sample: near, now: near });
  const strokes = strokesIn(flight);
  expect([strokes.get("min")?.colour, strokes.get("min")?.dash]).toEqual(["alert", ""]);
  expect(strokes.get("leader-body")?.colour).toBe("alert");
  const shown = createShown(flight);
  const min = textsOf(shown, above(90 * NM), SIZE).find(({ id }) => id === "min");
  expect(min?.lines.map(({ text }) => text)).toEqual([
    `MIN ${shown.numbers.value.minSeparation}`,
    `d ${shown.numbers.value.separation} NM`,
  ]);
  expect(shown.picture.value.notices[0]).toEqual({ level: "warning", text: "SEPARATION" });
});

test("what is kept beside the minimum is a circle of its own", () => {
  const flight = flightIn("converge");
  expect(strokesIn(flight).has("margin")).toBe(false);
  const wary = { ...sampleOf(flight), margin_m: 900 };
  amend(flight, { sample: wary, now: wary });
  expect(strokesIn(flight).get("margin")?.dash).toBe("3 5");
});

test("of a leader that is not heard, what is not known is not written, and its age is", () => {
  const shown = createShown(flightIn("data_lost"));
  const texts = textsOf(shown, above(90 * NM), SIZE);
  const leader = texts.find(({ id }) => id === "leader");
  expect(leader?.lines.map(({ text }) => text)).toEqual([shown.picture.value.ident, "15 S OLD"]);
  expect(leader?.lines.every(({ colour }) => colour === "caution")).toBe(true);
  expect(texts.flatMap(({ lines }) => lines).every(({ text }) => !/^ ?kt|--/.test(text))).toBe(
    true,
  );
});

test("the other flight of a comparison is in the picture, hollow of colour and named", () => {
  const flight = flightIn("converge");
  const pursuer = { ...sampleOf(flight).pursuer, x_m: -150_000, y_m: 40_000 };
  const places = [pursuer, sampleOf(flight).pursuer];
  const ghost = {
    name: "FIG 6A",
    pursuer,
    leader: null,
    isOutside: false,
    flown: places,
    own: places,
  };
  const shown = createShown(flight, signal(ghost));
  const picture = shown.picture.value;
  const sights = sightsOf(picture, ghost);
  if (sights === null || picture.now === null) throw new Error("A flight without a position.");
  const camera = cameraAt(standFor("Chase", sights, 1.5), 1.5);
  const at = glassOf(camera, middleOf(picture.now), SIZE).at(pursuer);
  expect(Math.abs((at?.x ?? 0) / SIZE.width - 0.5)).toBeLessThan(0.39);
  const drawn = new Map(strokesOf(picture, camera, SIZE, ghost).map((each) => [each.name, each]));
  expect(drawn.get("other-flown")?.dash).not.toBe("");
  expect(drawn.get("other-body")?.colour).toBe("superseded");
  expect(textsOf(shown, camera, SIZE).find(({ id }) => id === "other")?.lines[0]?.text).toBe(
    "FIG 6A",
  );
});

test("heights have a scale, where it can be read", () => {
  const shown = createShown(flightIn("converge"));
  const written = (view: "Side" | "Top") =>
    textsOf(shown, cameraOf(shown.picture.value, SIZE, view), SIZE)
      .filter(({ id }) => id.startsWith("level"))
      .flatMap(({ lines }) => lines.map(({ text }) => text));
  expect(written("Side")).toEqual(["FL100", "FL200", "FL300"]);
  expect(written("Top")).toEqual([]);
});

test("a line that passes behind the camera is cut off before it", () => {
  const glass = glassOf(EAST, ORIGIN, SIZE);
  const at = (x_m: number, y_m: number) => ({ x_m, y_m, altitude_m: 0 });
  expect(glass.line([at(-5000, 100), at(-100, 100)])).toBe("");
  const cut = glass.line([at(-5000, 1000), at(10_000, 1000), at(20_000, 1000)]);
  expect(cut.match(/[ML]/g)).toEqual(["M", "L", "L"]);
  expect(cut).not.toMatch(/NaN|Infinity/);
});

test("before the first position there is no poster", () => {
  expect(sightsOf(createShown(emptyFlight()).picture.value)).toBeNull();
});

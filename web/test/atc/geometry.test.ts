import { describe, expect, it } from "vitest";
import { closestOf, straightOn } from "../../src/atc/closest";
import {
  createView,
  keepInSight,
  pan,
  showAll,
  toPlace,
  toPoint,
  zoom,
} from "../../src/atc/map/view";
import { conflictsOf, pairOf, soonOf } from "../../src/atc/pairs";
import { emptySky, fold } from "../../src/atc/sky";
import { apart, otherTrack, partOf, placeOn } from "../../src/atc/tracks";
import { wrap180 } from "../../src/units";
import { changed, clearance, NOW, pair, seen, straight, traffic, validation } from "./fixture";

/** Numbers in [0, 1) that are the same each time. */
function draws(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 48271) % 2147483647;
    return state / 2147483647;
  };
}

describe("two aircraft straight on", () => {
  it("are never closer than said, and as close as said when said", () => {
    const draw = draws(7);
    const some = () =>
      traffic("X", {
        x_m: 80_000 * (draw() - 0.5),
        y_m: 80_000 * (draw() - 0.5),
        track_deg: 360 * draw(),
        ground_speed_mps: 150 + 120 * draw(),
      });
    for (let k = 0; k < 200; k += 1) {
      const [a, b] = [some(), some()];
      const { least, after, range, bearing } = closestOf(a, b);
      const at = (t: number) => apart(straightOn(a, t), straightOn(b, t));
      const sampled = Array.from({ length: 1200 }, (_, t) => at(t));
      expect(Math.min(...sampled)).toBeGreaterThan(least - 1e-6);
      expect(at(after)).toBeCloseTo(least, 6);
      expect(range).toBeCloseTo(at(0), 6);
      // as seen from the other, the first is on the other side
      expect(Math.abs(wrap180(closestOf(b, a).bearing - bearing))).toBeCloseTo(180, 9);
    }
  });

  it("that fly abreast keep their distance", () => {
    const found = closestOf(traffic("A"), traffic("B", { y_m: 9000 }));
    expect([found.after, found.least, found.bearing]).toEqual([0, 9000, 0]);
  });
});

describe("a track", () => {
  const track = straight([0, 0], 90, 200);

  it("is at its knots, between them on the line, and beyond them straight on", () => {
    for (const t of [-100, 0, 1, 599, 600, 601, 1200, 1500])
      expect(placeOn(track, NOW + t).x_m).toBeCloseTo(200 * t, 3);
  });

  it("has all its knots between two times", () => {
    const part = partOf(track, NOW + 100, NOW + 700);
    expect(part.map(({ x_m }) => Math.round(x_m))).toEqual([20_000, 120_000, 140_000]);
  });
});

describe("the other aircraft of a pair", () => {
  it("is drawn along its known route where that leads through the closest approach", () => {
    const own = clearance("1");
    const other = clearance("2", { state: "flying", route: straight([0, 50_000], 180, 230) });
    const sky = [changed(own), changed(other)].reduce(fold, emptySky(""));
    const there = placeOn(other.route, NOW + 300);
    const found = pair("DLH2", { other: { t_s: NOW + 300, ...there } });
    expect(otherTrack(sky, own, found)).toBe(other.route);
  });

  it("else straight from where it is to where validation had it", () => {
    const sky = fold(emptySky(""), seen([traffic("BAW12", { x_m: 5, y_m: 7 })]));
    const track = otherTrack(sky, clearance("1"), pair("BAW12"));
    expect([track.x_m, track.y_m]).toEqual([
      [5, 10_000],
      [7, 12_000],
    ]);
  });
});

describe("CARD", () => {
  const cards = [
    clearance("1", {
      validation: [
        validation({
          pairs: [
            pair("FAR"),
            pair("NEAR", { certainty: "certain", since_s: NOW + 200, until_s: NOW + 260 }),
            pair("PAST", { since_s: NOW - 90, at_s: NOW - 60, until_s: NOW - 30 }),
          ],
        }),
      ],
    }),
    clearance("2", { state: "unable" }),
  ];
  const sky = [...cards.map((each) => changed(each)), seen([])].reduce(fold, emptySky(""));

  it("has what is to come of all that lives, too close first", () => {
    const found = conflictsOf(sky).map(({ pair: { ident }, after }) => [ident, after]);
    expect(found).toEqual([
      ["NEAR", 200],
      ["FAR", 300],
    ]);
  });

  it("is yellow under eight minutes and red under five", () => {
    expect([299, 300, 479, 480].map(soonOf)).toEqual(["5 min", "8 min", "8 min", "later"]);
  });

  it("looks at the pair with the least margin until another one is chosen", () => {
    const [card] = cards;
    if (card === undefined) throw new Error("no card");
    expect(pairOf(card, null)?.ident).toBe("FAR");
    expect(pairOf(card, "NEAR")?.ident).toBe("NEAR");
  });
});

describe("the map", () => {
  it("keeps what is under the pointer while it zooms", () => {
    const view = createView();
    for (const factor of [1.5, 0.4, 3]) {
      const at = { x: 130, y: 480 };
      const before = toPlace(view, at);
      zoom(view, factor, at);
      expect(toPoint(view, before).x).toBeCloseTo(at.x, 6);
      expect(toPoint(view, before).y).toBeCloseTo(at.y, 6);
    }
  });

  it("shows all, and stays where a hand has put it", () => {
    const view = createView();
    const places = [traffic("A"), traffic("B", { x_m: 200_000, y_m: -90_000 })];
    showAll(view, places);
    for (const each of places) {
      const { x, y } = toPoint(view, each);
      expect(Math.min(x, y, 800 - x, 600 - y)).toBeGreaterThan(0);
    }
    pan(view, 3000, 0);
    const { x } = toPoint(view, { x_m: 0, y_m: 0 });
    keepInSight(view, places);
    expect(toPoint(view, { x_m: 0, y_m: 0 }).x).toBe(x);
  });
});

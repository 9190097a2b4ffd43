import { describe, expect, test } from "vitest";
import { windVector } from "../../src/geometry";
import { FIRST } from "../../src/map/first";
import { entryOf, GALLERY } from "../../src/map/gallery";
import { leaderRoute, slotNow } from "../../src/map/leader-route";
import { pythonOf } from "../../src/map/python";
import { bodyOf, type Situation, settle } from "../../src/map/situation";
import { documentsOf } from "../nd/fixture";

const WINDY: Situation = {
  ...FIRST,
  leader: {
    ...FIRST.leader,
    intent: [
      { straight_s: 60.5 },
      { turn_to_heading_deg: 45.5, direction: "left", bank_deg: 22.5 },
    ],
  },
  wind: { from_deg: 310, speed_mps: 20.58 },
};

test("the body leaves out what is empty, and names every unit", () => {
  expect(bodyOf({ ...FIRST, leader: { ...FIRST.leader, intent: [] } })).toEqual({
    pursuer: FIRST.pursuer,
    leader: { x_m: 0, y_m: 0, heading_deg: 90, tas_mps: 200 },
    slot_distance_m: 10_000,
    min_separation_m: 9260,
  });
  expect(bodyOf(WINDY).wind).toEqual(WINDY.wind);
});

test("the program imports what it uses and no more", () => {
  const calm = pythonOf({ ...FIRST, leader: { ...FIRST.leader, intent: [] } });
  expect(calm).toContain("from relguide import Leader, Pursuer, Situation, plan\n");
  const windy = pythonOf(WINDY);
  expect(windy).toContain(
    "import LEFT, FlyStraight, Leader, Pursuer, Situation, TurnTo, plan, wind_from",
  );
  expect(windy).toContain("TurnTo(heading=radians(45.5), turn=LEFT, bank=radians(22.5))");
});

test("an entry of the gallery is known until it is changed", () => {
  const [first] = GALLERY;
  if (first === undefined) throw new Error("An empty gallery.");
  const here = settle(first.situation);
  expect(entryOf(here)?.name).toBe("6a");
  expect(entryOf({ ...here, slot_distance_m: here.slot_distance_m + 1 })).toBeNull();
  expect(new Set(GALLERY.map(({ name }) => name)).size).toBe(12);
});

describe("the leader's route", () => {
  test.each(["fig_6b", "fig_6b_wind"] as const)("is the one that the service sends: %s", (name) => {
    const { started, route } = documentsOf(name);
    const wind = windVector(started.wind);
    const [, turn] = route.segments;
    const first = route.segments[0];
    if (first?.kind !== "straight" || turn?.kind !== "turn") throw new Error("Another route.");
    const situation: Situation = {
      ...FIRST,
      leader: {
        x_m: first.start.x_m,
        y_m: first.start.y_m,
        heading_deg: first.start.heading_deg,
        tas_mps: first.length_m / first.duration_s,
        intent: [
          { straight_s: first.duration_s },
          {
            turn_to_heading_deg: turn.end.heading_deg,
            direction: turn.direction,
            bank_deg: turn.bank_deg,
          },
        ],
      },
      wind: started.wind,
    };
    const built = leaderRoute(situation, wind);
    expect(built).toHaveLength(3);
    for (const [i, segment] of route.segments.slice(0, 2).entries()) {
      expect(built[i]?.end.x_m).toBeCloseTo(segment.end.x_m, 0);
      expect(built[i]?.end.y_m).toBeCloseTo(segment.end.y_m, 0);
      expect(built[i]?.end.t_s).toBeCloseTo(segment.end.t_s, 1);
    }
  });

  test("has the slot D back along its final track over the ground", () => {
    const wind = windVector(WINDY.wind);
    const route = leaderRoute(WINDY, wind);
    const { point, origin, ahead, opens } = slotNow(WINDY, route, wind);
    expect(Math.hypot(ahead.x, ahead.y)).toBeCloseTo(1, 12);
    expect(Math.hypot(point.x_m - origin.x, point.y_m - origin.y)).toBeCloseTo(10_000, 6);
    const last = route.at(-1);
    if (last === undefined) throw new Error("No final leg.");
    // When the final leg begins, the leader is where the slot for D = 0 has come.
    const speed = Math.hypot(last.end.x_m - last.start.x_m, last.end.y_m - last.start.y_m) / 7200;
    expect(origin.x + ahead.x * speed * last.start.t_s).toBeCloseTo(last.start.x_m, 3);
    expect(opens).toBeCloseTo(last.start.t_s + 10_000 / speed, 6);
  });
});

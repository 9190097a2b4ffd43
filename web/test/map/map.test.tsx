/** The map as it is seen and held: its picture, its handles by hand and by key. */

import { describe, expect, test, vi } from "vitest";
import { areaLabels } from "../../src/map/area";
import { MapBench } from "../../src/map/bench";
import { edit, openEditor, putSituation } from "../../src/map/editing";
import { createEditor, halfExtent, zoom } from "../../src/map/editor";
import { FIRST } from "../../src/map/first";
import { situationOf } from "../../src/map/from-flight";
import { dragHandle, HANDLES, handlePoint, handlesOf, keyHandle } from "../../src/map/handles";
import { labelPlace } from "../../src/map/label-place";
import { mapView, PlanMap } from "../../src/map/map";
import { sayHandle } from "../../src/map/say-handle";
import { settle } from "../../src/map/situation";
import { firstTurn } from "../../src/map/turn-handles";
import { chooseLabels } from "../../src/nd/labelled";
import { ringLabelPoints } from "../../src/nd/rings";
import { LINES } from "../../src/nd/style";
import { layoutOf, overlap, project } from "../../src/nd/view";
import { createSession } from "../../src/session";
import { createFlightStore } from "../../src/store/flight";
import { guidance } from "../../src/store/states";
import { formatClock, NM } from "../../src/units";
import type { FlownCard, FlownPoint, PathPoint, PlanCard } from "../../src/wire";
import { mount } from "../nd/draw";
import { documentsOf, flightAt } from "../nd/fixture";
import { noPlan, point, rightTurn, straight } from "../samples";
import { silentActions } from "../silence";

const { plan } = documentsOf("fig_6b").plan;

function answered(card: PlanCard = plan) {
  const map = openEditor(createEditor());
  putSituation(map, FIRST);
  map.answered.value = {
    situation: map.situation.value,
    answer: {
      ...card,
      others: [{ word: "LSR", time_to_converge_s: 900, segments: card.segments, why: "" }],
    },
  };
  return map;
}

test("a situation with its plan is drawn as a proposal, with its ghosts", () => {
  const map = answered();
  expect(guidance(map.flight.moment.value)).toBe("proposed");
  const root = mount(PlanMap, { map });
  for (const name of [
    "proposed",
    "others",
    "slot",
    "circle",
    "leader",
    "capture",
    "ownship",
    "intent",
  ])
    expect(root.querySelector(`.nd-${name}`), name).not.toBeNull();
  expect(root.querySelectorAll(`.grip[tabindex="0"]`)).toHaveLength(HANDLES.length);
  edit(map, (now) => ({ ...now, leader: { ...now.leader, intent: [] } }));
  expect(handlesOf(map.situation.value)).toHaveLength(HANDLES.length - 2);
  expect(map.shown.numbers.value.toJoin).not.toBe("");
});

/** The flight of a plan: later, by its own path. */
function flownCard(by = 60): FlownCard {
  const end = plan.time_to_converge_s + by;
  const place = ({ x_m, y_m, heading_deg }: PathPoint, t_s: number): FlownPoint => ({
    t_s,
    x_m,
    y_m,
    heading_deg,
    tas_mps: 240,
  });
  const [first, last] = [plan.segments[0], plan.segments.at(-1)];
  if (first === undefined || last === undefined) throw new Error("An empty plan.");
  return {
    status: "flown",
    join_s: end,
    least_m: 9_500,
    at_s: 300,
    word: "LRL",
    reason: by > 1 ? "It begins to turn 7 s later and keeps 5.10 NM: 60 s more." : "",
    segments: plan.segments,
    points: [place(first.start, 0), place(first.end, 60), place(last.end, end)],
  };
}

function beside(card: PlanCard): string {
  vi.useFakeTimers({ toFake: ["setTimeout", "performance"] });
  const session = { ...createSession(createFlightStore().flight), map: answered(card) };
  vi.advanceTimersByTime(1000);
  const text = mount(MapBench, { session, actions: silentActions() }).textContent ?? "";
  vi.useRealTimers();
  return text;
}

test("the headline is the flown time; the ideal one stands beside it with the reason", () => {
  const flown = flownCard();
  const text = beside({ ...plan, flown });
  const ideal = formatClock(plan.time_to_converge_s);
  expect(text).toContain(`Flown${formatClock(flown.join_s)}ideal ${ideal}`);
  expect(text).toContain(`Ideal ${ideal} by ${plan.word}. It begins to turn 7 s later`);
  expect(text).toContain("Optimal: no path is faster");
});

test("times that are alike need no reason, and a plan that is not flown says why", () => {
  const alike = beside({ ...plan, flown: flownCard(0) });
  expect(alike).toContain(`ideal ${formatClock(plan.time_to_converge_s)}`);
  expect(alike).not.toContain("It begins to turn");
  const reason = "An A306 cannot fly at 60 m/s.";
  const grounded = beside({ ...plan, flown: { status: "not_flown", reason } });
  expect(grounded).toContain(`Ideal${formatClock(plan.time_to_converge_s)}not flown`);
  expect(grounded).toContain("Not flown: An A306 cannot fly at 117 kt.");
});

test("the flown path is drawn, the ideal one thin under it, and the join is where it is flown", () => {
  const flown = flownCard();
  const map = answered({ ...plan, flown });
  const root = mount(PlanMap, { map });
  const dashes = [...root.querySelectorAll(".nd-proposed [stroke-dasharray]")].map((each) =>
    each.getAttribute("stroke-dasharray"),
  );
  expect(dashes).toContain(LINES.proposed.dash);
  expect(dashes).toContain(LINES.idealProposed.dash);
  const { join, proposed } = map.shown.picture.value;
  expect(join?.x_m).toBeCloseTo(flown.points.at(-1)?.x_m ?? 0, 0);
  expect(proposed?.plan.word).toBe("LRL");
  expect(proposed?.ideal?.word).toBe(plan.word);
});

test("while the next plan is late the last one stays, dimmed", () => {
  const map = answered();
  map.isLate.value = true;
  const root = mount(PlanMap, { map });
  expect(root.querySelector(".is-late .nd-proposed")).not.toBeNull();
  expect(guidance(map.flight.moment.value)).toBe("proposed");
});

test("without a plan the slot is crossed and the map says why; without an answer it says nothing", () => {
  const map = answered();
  map.answered.value = { situation: map.situation.value, answer: noPlan(0).answer };
  expect(guidance(map.flight.moment.value)).toBe("infeasible");
  const root = mount(PlanMap, { map });
  expect(root.querySelector(".nd-message")?.textContent).toBe("NO PLAN: SPEED");
  map.answered.value = null;
  expect(guidance(map.flight.moment.value)).toBe("designated");
  expect(mount(PlanMap, { map }).querySelector(".nd-message")).toBeNull();
});

test("own ship is drawn where it is, not in the middle", () => {
  const map = answered();
  const view = mapView(map);
  const own = project(view.layout.value, view.pose.value, FIRST.pursuer);
  expect(Math.hypot(own.x - 384, own.y - 384)).toBeGreaterThan(50);
  expect(handlePoint("own", FIRST, view.layout.value, view.pose.value)).toEqual(own);
});

describe("handles", () => {
  const layout = layoutOf("PLAN", 40);
  const middle = { x_m: 0, y_m: 0, heading_deg: 0 };
  const placeOf = ({ x, y }: { x: number; y: number }) => ({
    x_m: (x - layout.centre.x) / layout.scale,
    y_m: (layout.centre.y - y) / layout.scale,
  });

  test.each(HANDLES)("%s dragged to where it is changes nothing much", (name) => {
    const at = handlePoint(name, FIRST, layout, middle);
    const after = settle(dragHandle(name, FIRST, placeOf(at), at));
    const again = handlePoint(name, after, layout, middle);
    expect(Math.hypot(again.x - at.x, again.y - at.y)).toBeLessThan(1);
  });

  test("D never falls below MIN, and MIN never rises above D", () => {
    const near = settle(dragHandle("slot", FIRST, { x_m: 0, y_m: 0 }, { x: 0, y: 0 }));
    expect(near.slot_distance_m).toBe(FIRST.min_separation_m);
    const wide = settle(dragHandle("ring", FIRST, { x_m: 90_000, y_m: 0 }, { x: 0, y: 0 }));
    expect(wide.min_separation_m).toBe(FIRST.slot_distance_m);
  });

  test("the leader's turn begins where it is dragged to, and leads where its heading is pointed", () => {
    const later = settle(dragHandle("turn", FIRST, { x_m: 100_000, y_m: 7_000 }, { x: 0, y: 0 }));
    expect(later.leader.intent[0]).toEqual({ straight_s: 500 });
    const { ends } = firstTurn(later) ?? { ends: later.leader };
    const north = { x_m: ends.x_m + 50_000, y_m: ends.y_m + 50_000 };
    const [, turn] = settle(dragHandle("turn-heading", later, north, { x: 0, y: 0 })).leader.intent;
    expect(turn).toEqual({ turn_to_heading_deg: 45, direction: "left", bank_deg: 25 });
  });

  test("a turn that begins at once gets a straight before it", () => {
    const [, turn] = FIRST.leader.intent;
    if (turn === undefined) throw new Error("No turn.");
    const now = { ...FIRST, leader: { ...FIRST.leader, intent: [turn] } };
    const later = dragHandle("turn", now, { x_m: 20_000, y_m: 0 }, { x: 0, y: 0 });
    expect(later.leader.intent).toEqual([{ straight_s: 100 }, turn]);
    expect(keyHandle("turn", now, "ArrowLeft", false)).toEqual(now);
  });

  test.each(HANDLES)("%s is moved by arrows, finely with Shift, and by no other key", (name) => {
    const windy = { ...FIRST, wind: { from_deg: 100, speed_mps: 20 }, min_separation_m: 5 * NM };
    const by = (isFine: boolean) => {
      const after = keyHandle(name, windy, "ArrowUp", isFine);
      if (after === null) throw new Error("Not its key.");
      return settle(after);
    };
    expect(by(false)).not.toEqual(settle(windy));
    expect(by(true)).not.toEqual(by(false));
    expect(keyHandle(name, windy, "q", false)).toBeNull();
    const { label, text, value, least, most } = sayHandle(name, windy);
    expect(label.length * text.length).toBeGreaterThan(0);
    expect(value).toBeGreaterThanOrEqual(least);
    expect(value).toBeLessThanOrEqual(most);
  });
});

test("zooming keeps a place where it is seen", () => {
  const map = answered();
  const place = { x_m: 30_000, y_m: -12_000 };
  const seen = () =>
    project(layoutOf("PLAN", map.range.value), { ...map.centre.value, heading_deg: 0 }, place);
  const before = seen();
  const range = map.range.value;
  zoom(map, 1, place);
  expect(map.range.value).toBeGreaterThan(range);
  expect(seen().x).toBeCloseTo(before.x, 9);
  expect(seen().y).toBeCloseTo(before.y, 9);
});

test("all is in sight when a situation is put on the map", () => {
  const map = openEditor(createEditor());
  putSituation(map, { ...FIRST, pursuer: { ...FIRST.pursuer, x_m: -400_000 } });
  const half = halfExtent(map.range.value);
  expect(Math.abs(map.centre.value.x_m + 400_000)).toBeLessThan(half);
  expect(Math.abs(map.centre.value.x_m)).toBeLessThan(half);
});

test("the situation of a flight is where the two are, with what the leader has yet to turn", () => {
  const flight = flightAt("fig_6b", 200);
  const found = situationOf(flight);
  const now = flight.moment.value.now;
  expect(found?.pursuer.x_m).toBe(Math.round(now?.pursuer.x_m ?? 0));
  const [straight, turn] = found?.leader.intent ?? [];
  const whole = documentsOf("fig_6b").route.segments[0]?.duration_s ?? 0;
  expect(straight).toEqual({ straight_s: Math.round(10 * (whole - 200)) / 10 });
  expect(turn).toMatchObject({ direction: "right" });
  expect(found?.leader.intent).toHaveLength(2);
});

test("what is edited is kept within bounds", () => {
  const map = openEditor(createEditor());
  edit(map, (now) => ({ ...now, pursuer: { ...now.pursuer, x_m: 5e6, heading_deg: 400 } }));
  expect(map.situation.value.pursuer.x_m).toBe(1_000_000);
  expect(map.situation.value.pursuer.heading_deg).toBe(40);
});

test("a region is named where it is widest", () => {
  const ring = (points: readonly (readonly [number, number])[]) =>
    points.map(([x_m, y_m]) => ({ x_m, y_m }));
  const triangle = ring([
    [0, 0],
    [10, 0],
    [5, 8],
    [0, 0],
  ]);
  expect(labelPlace([[triangle]])).toMatchObject({ x_m: 5, y_m: 1 });
  expect(labelPlace([])).toBeNull();
});

test("the name of a region keeps clear of the rings' numbers and of the flight's labels", () => {
  const map = answered();
  const side = 20_000;
  const view = mapView(map);
  const { x, y } = ringLabelPoints(
    view.layout.value,
    view.layout.value.rings[1]?.radius ?? 0,
  )[0] ?? {
    x: 0,
    y: 0,
  };
  const { scale, centre } = view.layout.value;
  const [east, north] = [
    map.centre.value.x_m + (x - centre.x) / scale,
    map.centre.value.y_m - (y - centre.y) / scale,
  ];
  const square = [-1, 1, 1, -1, -1].map((part, k) => [
    east + side * part,
    // it is named an eighth up
    north + side * ([-0.25, -0.25, 1.75, 1.75, -0.25][k] ?? 0),
  ]);
  map.area.value = {
    asked: "",
    answer: { regions: [{ word: "LSL", limited: true, polygons: [[square]] }], contours: [] },
  } as unknown as NonNullable<typeof map.area.value>;
  const screen = { shown: map.shown, view };
  const [named] = areaLabels(map, view).labels;
  expect(named?.at.x).toBeCloseTo(x, 0);
  expect(named?.at.y).toBeCloseTo(y, 0);
  const chosen = chooseLabels(screen, areaLabels(map, view));
  const name = chosen.find(({ label }) => label.id === "region 0");
  if (name === undefined) throw new Error("It is not named.");
  const box = { ...name.placement.box, x: x + name.placement.box.x, y: y + name.placement.box.y };
  expect(overlap(box, { x: x - 14, y: y - 14, width: 28, height: 28 })).toBeLessThan(1);
});

test("what a path is stands apart from the names of its turns", () => {
  const { pursuer } = FIRST;
  const lead = straight(point(0, pursuer.x_m, pursuer.y_m, 90), 300, 240);
  const turn = { ...rightTurn(20), start: lead.end };
  const rolled = { ...turn, end: { ...lead.end, t_s: lead.end.t_s + turn.duration_s } };
  const segments = [lead, rolled, straight(rolled.end, 550, 240)];
  const map = answered({ ...plan, segments, time_to_converge_s: 300 / 0.35 });
  const labels = chooseLabels({ shown: map.shown, view: mapView(map) }).map(({ label }) => label);
  const [name, first] = ["proposal", "T1"].map((id) => labels.find((each) => each.id === id)?.at);
  if (name === undefined || first === undefined) throw new Error("It is not named.");
  expect(Math.hypot(first.x - name.x, first.y - name.y)).toBeGreaterThan(90);
});

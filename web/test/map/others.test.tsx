import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, describe, expect, test } from "vitest";
import { edit, openEditor, putSituation } from "../../src/map/editing";
import { createEditor, type Editor, step } from "../../src/map/editor";
import { FIRST } from "../../src/map/first";
import { handlesOf } from "../../src/map/handles";
import { readAddress, writeAddress } from "../../src/map/link";
import { mapView, PlanMap } from "../../src/map/map";
import { dragOther, keyOther, otherPart, removeOther, sayOther } from "../../src/map/other-handles";
import { addCell, addTraffic, otherAt } from "../../src/map/others";
import { OthersForm } from "../../src/map/others-form";
import { nearestLabels } from "../../src/map/others-layer";
import { pythonOf } from "../../src/map/python";
import { Remedies } from "../../src/map/remedies";
import { bodyOf, type Situation, settle } from "../../src/map/situation";
import { alternativeSentence } from "../../src/store/reading";
import { NM } from "../../src/units";
import type { NoPlanCard, PlanCard } from "../../src/wire";
import { planCard } from "../samples";

const AMID: Situation = settle({
  ...FIRST,
  pursuer: { ...FIRST.pursuer, altitude_m: 9449 },
  leader: { ...FIRST.leader, altitude_m: 9449 },
  traffic: [
    {
      ident: "BAW 12",
      x_m: 20_000,
      y_m: 45_000,
      heading_deg: 180,
      tas_mps: 230,
      altitude_m: 9144,
      min_separation_m: 5556,
      intent: [
        { level_change: { to_altitude_m: 8534, rate_mps: 6, hold: "cas" } },
        { straight_s: 100 },
        { turn_to_heading_deg: 270, direction: "right", bank_deg: 20 },
      ],
    },
  ],
  cells: [
    {
      ident: "CB1",
      x_m: 0,
      y_m: 20_000,
      radius_m: 9000,
      east_mps: 10,
      north_mps: 0,
      growth_mps: 2,
    },
  ],
});

const place = document.body.appendChild(document.createElement("div"));
afterEach(() => render(null, place));

function editorOf(situation: Situation, answer?: NoPlanCard | PlanCard): Editor {
  const map = createEditor();
  putSituation(map, situation);
  if (answer !== undefined) map.answered.value = { situation: map.situation.value, answer };
  return map;
}

test("a request has traffic and cells as outsiders send them; without any it is as before", () => {
  const body = bodyOf(AMID);
  expect(body.traffic).toEqual([
    {
      ident: "BAW 12",
      x_m: 20_000,
      y_m: 45_000,
      heading_deg: 180,
      tas_mps: 230,
      altitude_m: 9144,
      min_separation_m: 5556,
      intent: AMID.traffic[0]?.intent,
    },
  ]);
  expect(body.cells).toEqual([
    {
      ident: "CB1",
      disc: { x_m: 0, y_m: 20_000, radius_m: 9000 },
      velocity_mps: [10, 0],
      growth_mps: 2,
    },
  ]);
  expect(Object.keys(bodyOf(settle(FIRST)))).not.toContain("traffic");
  expect(Object.keys(bodyOf(settle(FIRST)))).not.toContain("cells");
  expect(bodyOf(settle(FIRST)).pursuer).toEqual(FIRST.pursuer);
});

test("a link keeps others, levels and changes of level; what is wrong is said of whom", () => {
  const address = new URL("http://127.0.0.1/");
  writeAddress(address, AMID);
  expect(readAddress(address.searchParams)).toEqual(AMID);
  address.searchParams.set("traffic", "BAW12 20000 45000 180 2 - -");
  expect(readAddress(address.searchParams)).toMatch(/^Traffic BAW12: airspeed 3.9 kt is refused/);
  address.searchParams.set("traffic", "BAW12 20000 45000 180 230 - -");
  address.searchParams.set("cell", "CB1 0 0 9000");
  expect(readAddress(address.searchParams)).toMatch(/^Cell CB1: a number is missing/);
});

test("a program has the same others", () => {
  const program = pythonOf(AMID);
  expect(program).toContain("from relguide import RIGHT, Cell, ChangeLevel, Disc, FlyStraight");
  expect(program).toContain('Traffic(ident="BAW 12", x=20000, y=45000');
  expect(program).toContain('Cell(ident="CB1", shape=Disc(x=0, y=20000, radius=9000)');
  expect(program).toContain("altitude=9144, min_separation=5556");
});

describe("by hand", () => {
  test("what is added stands clear of the rest, under a name of its own, and is taken back as one step", () => {
    const map = editorOf(settle(FIRST));
    edit(map, (now) => addTraffic(now, { x_m: 0, y_m: 0 }));
    edit(map, (now) => addTraffic(now, { x_m: 0, y_m: 0 }));
    edit(map, (now) => addCell(now, { x_m: 0, y_m: 0 }));
    const { traffic, cells } = map.situation.value;
    expect([...traffic, ...cells].map(({ ident }) => ident)).toEqual(["TFC1", "TFC2", "CB1"]);
    const places = [...traffic, ...cells, FIRST.leader];
    for (const [k, a] of places.entries())
      for (const b of places.slice(k + 1))
        expect(Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m)).toBeGreaterThanOrEqual(8000);
    step(map, -1);
    expect(map.situation.value.cells).toHaveLength(0);
    expect(map.situation.value.traffic).toHaveLength(2);
  });

  test("each can be dragged, turned, resized and removed, by finger and by key", () => {
    expect(handlesOf(AMID)).toEqual(
      expect.arrayContaining(["traffic/0", "traffic-heading/0", "cell/0", "cell-edge/0"]),
    );
    const part = (name: string) => otherPart(name) ?? { part: "cell" as const, number: -1 };
    const at = (x_m: number, y_m: number) => ({ x_m, y_m });
    expect(dragOther(part("traffic/0"), AMID, at(1000, 2000)).traffic[0]).toMatchObject(
      at(1000, 2000),
    );
    const turned = dragOther(part("traffic-heading/0"), AMID, at(60_000, 45_000));
    expect(turned.traffic[0]?.heading_deg).toBe(90);
    const wide = dragOther(part("cell-edge/0"), AMID, at(5 * NM, 20_000));
    expect(wide.cells[0]?.radius_m).toBeCloseTo(5 * NM, 6);
    expect(keyOther(part("cell/0"), AMID, [1, 0], false).cells[0]?.x_m).toBeCloseTo(NM, 6);
    expect(removeOther(part("traffic-heading/0"), AMID).traffic).toHaveLength(0);
    expect(removeOther(part("cell-edge/0"), AMID).cells).toHaveLength(0);
    expect(sayOther(part("traffic/0"), AMID).label).toBe("BAW 12: place; Delete removes it");
    expect(sayOther(part("cell-edge/0"), AMID).text).toBe("4.9 nautical miles");
  });
});

test("the map draws them, and those that are near the plan are marked with when and how near", () => {
  const plan = planCard({
    separation: {
      least_m: 10_000,
      at_s: 250,
      proved_above_m: 9999,
      others: [
        { ident: "BAW 12", least_m: 6000, at_s: 60, proved_above_m: 5990, min_separation_m: 5556 },
        { ident: "CB1", least_m: 60_000, at_s: 60, proved_above_m: 59_000, min_separation_m: 0 },
      ],
    },
  });
  const map = editorOf(AMID, plan);
  act(() => render(<PlanMap map={map} />, place));
  expect(place.querySelectorAll('.nd-traffic[data-ident="BAW 12"]')).toHaveLength(1);
  expect(place.querySelectorAll(".nd-weather")).toHaveLength(1);
  expect(place.querySelectorAll(".nd-nearest .nd-hollow")).toHaveLength(1);
  const [label, ...more] = nearestLabels(map, mapView(map));
  expect(more).toHaveLength(0);
  expect(label?.lines.map(({ text }) => text)).toEqual(["BAW 12", "3.2 NM 01:00"]);
});

test("where a level is not known, none is shown", () => {
  const { altitude_m: _, ...pursuer } = AMID.pursuer;
  const map = editorOf({ ...AMID, pursuer });
  act(() => render(<PlanMap map={map} />, place));
  expect(place.querySelector(".nd-traffic text")).toBeNull();
});

const STUCK: NoPlanCard = {
  status: "no_plan",
  reason: "traffic",
  message: "Unable: BAW 12 at 100 s, 3.0 of 3.0 NM.",
  lower_bound_s: 0,
  conflict: { ident: "BAW 12", at_s: 100, least_m: 5000, min_separation_m: 5556 },
  remedies: [
    {
      kind: "slot_distance",
      slot_distance_m: 14_000,
      time_to_converge_s: 600,
      message: "D of 7.6 NM: joins in 600 s.",
    },
    {
      kind: "level",
      altitude_m: 9754,
      time_to_converge_s: 600,
      message: "At 32,000 ft until it joins there is a plan of 600 s.",
    },
  ],
};

test("no plan marks who is in the way where that is then, and a button applies what helps", async () => {
  const map = editorOf(AMID, STUCK);
  act(() => render(<PlanMap map={map} />, place));
  const there = otherAt(AMID, "BAW 12", 100);
  expect(there?.y_m).toBeCloseTo(45_000 - 23_000, 6);
  const marks = place.querySelectorAll(".nd-nearest [stroke='var(--caution)']");
  expect(marks).toHaveLength(2);
  await new Promise((resolve) => setTimeout(resolve, 250)); // panels follow at the pace of reading
  act(() => render(<Remedies map={map} />, place));
  const buttons = [...place.querySelectorAll("button")];
  expect(buttons.map(({ textContent }) => textContent)).toHaveLength(2);
  act(() => buttons[0]?.click());
  expect(map.situation.value.slot_distance_m).toBe(14_000);
  act(() => buttons[1]?.click());
  expect(map.situation.value.pursuer.altitude_m).toBe(9754);
});

test("the form adds, names and removes", () => {
  const map = openEditor(createEditor());
  act(() => render(<OthersForm map={map} />, place));
  const press = (name: string) =>
    act(() => {
      const found = [...place.querySelectorAll("button")].find(
        ({ textContent }) => textContent === name,
      );
      if (found === undefined) throw new Error(`No button ${name}.`);
      found.click();
    });
  press("Add aircraft");
  expect(map.situation.value.traffic.map(({ ident }) => ident)).toEqual(["TFC1"]);
});

test("a rejected path names whom it comes too close to", () => {
  const rejected = {
    word: "LSL",
    time_to_converge_s: 540,
    turning_deg: 90,
    passes: "behind",
    side: "left",
    least_separation_m: 7811,
    at_s: 208,
    why: "",
    rejected: "separation",
  } as const;
  expect(alternativeSentence({ ...rejected, ident: "BAW12" }, planCard())).toBe(
    "only 4.2 NM to BAW12 at 03:28",
  );
  expect(
    alternativeSentence({ ...rejected, ident: "CB1", least_separation_m: -3704 }, planCard()),
  ).toBe("2.0 NM inside CB1 at 03:28");
  expect(alternativeSentence(rejected, planCard())).toBe("only 4.2 NM at 03:28");
});

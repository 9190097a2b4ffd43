import { expect, test } from "vitest";
import { announcementsOf } from "../../src/store/announcements";
import { createHistory, momentAt } from "../../src/store/history";
import { movedBy } from "../../src/store/motion";
import { noticesOf } from "../../src/store/notices";
import { pictureOf } from "../../src/store/picture";
import { approachOf } from "../../src/store/traffic";
import type { Alert, CellCard, Document, FlightStarted } from "../../src/wire";
import { aircraft, alert, modeChanged, planChanged, STARTED, sample } from "../samples";

const FT = 0.3048;
const CARDS = ["BAW12", "DLH7K"].map((ident) => ({
  ident,
  aircraft_type: "A320",
  max_bank_deg: 25,
}));
const CELL: CellCard = {
  ident: "CB1",
  x_m: [50_000],
  y_m: [20_000],
  radius_m: 9000,
  east_mps: 10,
  north_mps: 0,
  growth_mps: 2,
};
const SKY: FlightStarted = {
  ...STARTED,
  aircraft: [...STARTED.aircraft, ...CARDS],
  links: [
    ...STARTED.links,
    { ...(STARTED.links[0] as (typeof STARTED.links)[0]), pursuer: "DLH7K", leader: "RG001" },
  ],
  cells: [CELL],
};

/** BAW12 comes head on, 2 NM to the left, and descends by 1,000 ft a minute; DLH7K is far away. */
function skyAt(t: number) {
  const others = [
    aircraft({
      ident: "BAW12",
      x_m: 60_000 - 250 * t,
      y_m: 3704,
      heading_deg: 270,
      track_deg: 270,
      ground_speed_mps: 250,
      altitude_m: 10_668 + 2000 * FT - ((1000 * FT) / 60) * t,
    }),
    aircraft({ ident: "DLH7K", y_m: -90_000 }),
  ];
  return sample(t, { others });
}

function flown(until: number, ...said: Document[]) {
  const history = createHistory();
  const samples = Array.from({ length: until + 1 }, (_, t) => skyAt(t));
  const all: Document[] = [...samples, ...said].sort((a, b) => a.t_s - b.t_s);
  history.merge([SKY, planChanged(0), modeChanged(0), ...all]);
  return history;
}

test("what flies beside the two is traffic, with its level, its climb and whom it joins", () => {
  const { traffic } = pictureOf(momentAt(flown(60), 60));
  expect(traffic.map(({ ident }) => ident)).toEqual(["DLH7K", "BAW12"]);
  const [far, near] = traffic;
  expect(far).toMatchObject({ follows: "RG001", climb: 0, urgency: "other" });
  expect(near?.height).toBeCloseTo(1000 * FT, 6);
  expect(near?.climb).toBeCloseTo((-1000 * FT) / 60, 6);
});

test("at the edge of a flight in the air the newest seconds say how fast each climbs", () => {
  const { climbs } = flown(60).seenAt(Number.POSITIVE_INFINITY, 1);
  expect(climbs.get("BAW12")).toBeCloseTo((-1000 * FT) / 60, 6);
});

test("between two samples and with each frame traffic moves on", () => {
  const history = flown(60);
  const at = history.knots.sampleAt(30.5);
  expect(at?.others[0]?.x_m).toBeCloseTo(60_000 - 250 * 30.5, 3);
  if (at === null) throw new Error("No sample.");
  expect(movedBy(at, 0.2).others.get("BAW12")?.x).toBeCloseTo(-50, 6);
});

test("straight on, the closest approach is where the miss distance is perpendicular", () => {
  const [own, other] = [sample(0).aircraft[0], skyAt(0).aircraft[2]];
  if (own === undefined || other === undefined) throw new Error("No aircraft.");
  const { in: until, least } = approachOf(own, other);
  expect(until).toBeCloseTo(60_000 / 490, 6);
  expect(least).toBeCloseTo(3704, 6);
  const step = 1;
  const apart = (t: number) => Math.hypot(60_000 - 490 * t, 3704);
  expect(apart(until)).toBeLessThanOrEqual(Math.min(apart(until - step), apart(until + step)));
  expect(approachOf(other, other)).toEqual({ in: 0, least: 0 });
});

test("an alert on other traffic is its own: the circle round the leader stays as it is", () => {
  const about = (changes: Partial<Alert>) =>
    alert(10, { other: "BAW12", message: "Closer than 5.0 NM.", ...changes });
  const moment = momentAt(flown(60, about({ level: "warning" })), 30);
  const picture = pictureOf(moment);
  expect(picture.separation.state).toBe("kept");
  expect(picture.traffic.at(-1)).toMatchObject({ ident: "BAW12", urgency: "warning" });
  expect(noticesOf(moment)[0]).toEqual({ level: "warning", text: "SEP BAW12 IN 25 S" });
  expect(announcementsOf(moment).assertive).toBe("BAW12: Closer than 5.0 NM.");
  const advised = pictureOf(momentAt(flown(60, about({ level: "advisory" })), 30));
  expect(advised.traffic.at(-1)).toMatchObject({ ident: "BAW12", urgency: "proximate" });
});

test("a cell moves and grows with the flight's time", () => {
  const moment = momentAt(flown(60, alert(10, { other: "CB1" })), 50);
  const [cell] = pictureOf(moment).cells;
  expect(cell).toMatchObject({ corners: [{ x: 50_500, y: 20_000 }], radius: 9100 });
  expect(cell?.later).toMatchObject({ corners: [{ x: 53_500, y: 20_000 }], radius: 9700 });
  expect(cell?.urgency).toBe("caution");
});

test("with data that are too old, traffic and cells go with the map", () => {
  const moment = { ...momentAt(flown(60), 60), dataAge: 25 };
  const picture = pictureOf(moment);
  expect(picture.flag).toBe("MAP NOT AVAIL");
  expect([picture.traffic, picture.cells]).toEqual([[], []]);
});

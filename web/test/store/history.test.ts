import { describe, expect, test } from "vitest";
import { createFlightStore } from "../../src/store/flight";
import { createHistory, momentAt } from "../../src/store/history";
import type { PairSample } from "../../src/store/pair";
import { pictureOf } from "../../src/store/picture";
import type { Document } from "../../src/wire";
import {
  aircraft,
  modeChanged,
  pairAt,
  planChanged,
  STARTED,
  sample,
  separationLost,
  tick,
  unable,
} from "../samples";

/** Both where they are at `t`: own ship rolls into a turn and out of it, the leader flies straight. */
function weaving(t: number): Partial<PairSample> {
  const rate = (s: number) => 1.5 * Math.sin(s / 20); // deg/s
  const heading = (s: number) => 90 + 30 * (1 - Math.cos(s / 20));
  let [x, y] = [0, 0];
  const steps = Math.max(1, Math.round(t * 50));
  for (let k = 0; k < steps; k += 1) {
    const psi = (heading(((k + 0.5) * t) / steps) * Math.PI) / 180;
    x += (240 * Math.sin(psi) * t) / steps;
    y += (240 * Math.cos(psi) * t) / steps;
  }
  const turned = { heading_deg: heading(t), track_deg: heading(t), turn_rate_degps: rate(t) };
  return { pursuer: aircraft({ x_m: x, y_m: y, ...turned }) };
}

function flown(seconds: number, changes: (t: number) => Partial<PairSample> = weaving): Document[] {
  const samples = Array.from({ length: seconds + 1 }, (_, t) => sample(t, changes(t)));
  return [STARTED, modeChanged(0), planChanged(0), ...samples];
}

describe("any instant of a flight", () => {
  test("between two seconds own ship is where it was, to two millimetres", () => {
    const history = createHistory();
    history.merge(flown(60));
    for (let t = 0.5; t < 60; t += 0.97) {
      const found = momentAt(history, t).now?.pursuer;
      const truth = weaving(t).pursuer;
      const off = Math.hypot(
        (found?.x_m ?? 0) - (truth?.x_m ?? 0),
        (found?.y_m ?? 0) - (truth?.y_m ?? 0),
      );
      expect(off, `at ${t}`).toBeLessThan(0.002);
      expect(found?.heading_deg).toBeCloseTo(truth?.heading_deg ?? 0, 3);
    }
  });

  test("on a whole second it is the sample itself", () => {
    const history = createHistory();
    history.merge(flown(20));
    expect(momentAt(history, 7).now).toEqual(pairAt(7, weaving(7)));
  });

  test("a seek back folds what was known then, and nothing that came later", () => {
    const history = createHistory();
    history.merge([...flown(20), unable(5), planChanged(9), separationLost(12)]);
    expect(history.knownAt(20).lost?.t_s).toBe(12);
    expect(history.knownAt(6)).toMatchObject({ unable: { t_s: 5 }, lost: null, plan: { t_s: 0 } });
    expect(history.knownAt(4).unable).toBeNull();
    expect(history.knownAt(20).messages).toHaveLength(5);
  });

  test("it is the same from a checkpoint as from the beginning", () => {
    const many = Array.from({ length: 1500 }, (_, k) => planChanged(k));
    const [far, straight] = [createHistory(), createHistory()];
    for (const history of [far, straight]) history.merge([STARTED, sample(0), ...many]);
    far.knownAt(1499);
    for (const t of [1400, 700, 256, 255, 3]) expect(far.knownAt(t)).toEqual(straight.knownAt(t));
  });

  test("a flight that was watched is the same as its recording", () => {
    const store = createFlightStore();
    store.link("open");
    const documents = flown(40);
    for (let k = 0; k <= 800; k += 1) {
      const t = k / 20;
      const due = documents.filter((each) => each.kind !== "sample" && each.t_s === t);
      store.receive(tick(t, [...due, sample(t, weaving(t))]), 1000 * t);
    }
    const recorded = createHistory();
    recorded.merge(documents);
    for (const t of [0, 11, 20, 39]) {
      store.seek(t, 0, 50_000);
      expect(pictureOf(store.flight.moment.value)).toEqual(pictureOf(momentAt(recorded, t)));
    }
  });

  test("a leader that is not heard of is where it was expected, then as now", () => {
    const history = createHistory();
    const turned = { ...pairAt(1).leader, y_m: 9e4, heading_deg: 0 };
    const lost = (t: number) => (t > 5 ? { leader_age_s: t - 5, leader: turned } : {});
    history.merge(flown(20, lost));
    const { sample: known } = momentAt(history, 15.5);
    expect(known?.leader.x_m).toBeCloseTo(20_000 + 200 * 15.5, 3);
    expect(known?.leader.y_m).toBeCloseTo(0, 3);
  });

  test("what is not on record is said to be old, not made up", () => {
    const history = createHistory();
    history.merge([STARTED, ...[0, 1, 2, 40, 41].map((t) => sample(t))]);
    expect(momentAt(history, 2).dataAge).toBe(0);
    expect(momentAt(history, 12).dataAge).toBe(10);
    expect(pictureOf(momentAt(history, 30)).flag).toBe("MAP NOT AVAIL");
    expect(momentAt(history, 40.5).dataAge).toBe(0);
  });
});

describe("the page's own clock", () => {
  function watched(seconds = 60) {
    const store = createFlightStore();
    store.link("open");
    for (let t = 0; t <= seconds; t += 1) {
      const documents = t === 0 ? [STARTED, planChanged(0)] : [];
      store.receive(tick(t, [...documents, sample(t)]), 1000 * t);
    }
    return store;
  }

  test("stands where it is put, while the flight goes on, and is back with it when told", () => {
    const store = watched();
    store.seek(20, 0, 60_000);
    store.receive(tick(61, [sample(61)]), 61_000);
    expect(store.flight.moment.value.t).toBe(20);
    expect(store.flight.span.value).toEqual({ first: 0, last: 61 });
    store.follow(61_000);
    expect(store.flight.source.value).toEqual({ kind: "live" });
    expect(store.flight.moment.value.t).toBeCloseTo(61, 6);
  });

  test("runs at its own rate, and joins the flight when it has caught up", () => {
    const store = watched();
    store.seek(20, 10, 60_000);
    store.advance(62_000);
    expect(store.flight.moment.value.t).toBeCloseTo(40, 6);
    store.advance(64_100);
    expect(store.flight.source.value).toEqual({ kind: "live" });
  });

  test("a recording begins at its beginning and stands at its end", () => {
    const store = createFlightStore();
    store.load("recorded", flown(30), 0);
    expect(store.flight.moment.value.t).toBe(0);
    store.seek(0, 60, 0);
    store.advance(1000);
    expect(store.flight.source.value).toEqual({ kind: "replay", rate: 0 });
    expect(store.flight.moment.value.t).toBe(30);
  });

  test("a loop is gone through again and again", () => {
    const store = watched();
    store.flight.loop.value = { from: 10, to: 20 };
    store.seek(18, 1, 0);
    store.advance(1500);
    expect(store.flight.moment.value.t).toBeCloseTo(19.5, 6);
    store.advance(2100);
    expect(store.flight.moment.value.t).toBe(10);
    store.advance(3100);
    expect(store.flight.moment.value.t).toBeCloseTo(11, 6);
  });

  test("what was flown before the page came is put before what it saw", () => {
    const store = createFlightStore();
    store.receive(tick(30, [STARTED, planChanged(2), sample(30)]), 30_000);
    store.receive(tick(31, [sample(31)]), 31_000);
    store.merge(
      [STARTED, planChanged(2), ...flown(30).filter((each) => each.kind === "sample")],
      31_000,
    );
    expect(store.flight.span.value).toEqual({ first: 0, last: 31 });
    store.seek(1, 0, 31_000);
    expect(store.flight.moment.value.plan).toBeNull();
    store.seek(3, 0, 31_000);
    expect(store.flight.moment.value.plan?.t_s).toBe(2);
  });
});

import { describe, expect, test } from "vitest";
import { beside, countByHand } from "../../src/debrief/by-hand";
import { intentFlown } from "../../src/debrief/leader-flown";
import { lossesOf } from "../../src/debrief/losses";
import { flownOf, plansOf, type Second } from "../../src/debrief/seconds";
import { createHistory } from "../../src/store/history";
import type { PairSample } from "../../src/store/pair";
import type { Bars } from "../../src/wire";
import { historyOf } from "../flights/recorded";
import { aircraft, pairAt, planChanged, STARTED, sample } from "../samples";

/** Seconds of a flight by hand whose forecast of the join is given. */
function seconds(joins: readonly number[], of: (t: number) => Partial<PairSample> = () => ({})) {
  return joins.map(
    (join, t): Second => ({ t, joins: join, byHand: true, sample: pairAt(t, of(t)) }),
  );
}

const RIGHT_TURN = { kind: "turn_rate", turn_rate_degps: 1 } as const;

describe("where time was lost", () => {
  test("what the forecast of the join rises by is lost, and no more", () => {
    const joins = [250, 250, 252, 252, 255, 255];
    const { flown, leader, points } = lossesOf({ seconds: seconds(joins), byHand: true });
    expect(flown).toBe(5);
    expect(leader).toBe(0);
    expect(points.map(({ lost }) => lost)).toEqual([0, 0, 2, 2, 5, 5]);
  });

  test("the worst three stretches are short, apart, and together no more than all", () => {
    const joins = Array.from({ length: 200 }, (_, t) => 250 + Math.floor(t / 9));
    const { worst, flown } = lossesOf({ seconds: seconds(joins), byHand: true });
    expect(worst).toHaveLength(3);
    for (const { from, to, lost } of worst) {
      expect(to - from).toBeLessThanOrEqual(30);
      expect(lost).toBeGreaterThanOrEqual(1);
    }
    for (const [k, each] of worst.slice(1).entries())
      expect(each.from).toBeGreaterThanOrEqual(worst[k]?.to ?? 0);
    expect(worst.reduce((sum, { lost }) => sum + lost, 0)).toBeLessThanOrEqual(flown);
  });

  test("what is lost at once is one stretch", () => {
    const { worst } = lossesOf({ seconds: seconds([250, 250, 300, 300, 300]), byHand: true });
    expect(worst.map(({ from, to, lost }) => [from, to, lost])).toEqual([[1, 2, 50]]);
  });

  test("a turn that is flown too little is named; one flown too much, too", () => {
    const joins = [250, 251, 252, 253];
    const turning = (rate: number) => () => ({
      reference: RIGHT_TURN,
      pursuer: aircraft({ turn_rate_degps: rate }),
    });
    const how = (rate: number) =>
      lossesOf({ seconds: seconds(joins, turning(rate)), byHand: true }).worst[0]?.how;
    expect(how(0)).toBe("wide of the right turn");
    expect(how(1.5)).toBe("inside the right turn");
  });

  test("what the leader's turn changes is the leader's doing, if a hand flies", () => {
    const joins = [250, 250, 240, 230, 230];
    const turning = (t: number) => ({ leader: aircraft({ turn_rate_degps: t === 2 ? -1 : 0 }) });
    const by = (byHand: boolean) => lossesOf({ seconds: seconds(joins, turning), byHand });
    expect([by(true).flown, by(true).leader]).toEqual([0, -20]);
    expect([by(false).flown, by(false).leader]).toEqual([-20, 0]);
    expect(by(true).points.at(-1)).toEqual({ t: 4, lost: 0, inAll: -20 });
  });
});

describe("a flight that was recorded", () => {
  test("the autopilot loses nothing where it knows the intent, and was not flown by hand", () => {
    const flown = flownOf(historyOf("fig_6b"));
    expect(flown?.byHand).toBe(false);
    expect(flown?.joined).toBe(historyOf("fig_6b").knownAt(1e9).result?.join_time_s);
    expect(Math.abs(lossesOf(flown ?? { seconds: [], byHand: false }).flown)).toBeLessThan(5);
  });

  test("a leader that turns untold costs what the join is later than was forecast", () => {
    const flown = flownOf(historyOf("fig_6a"));
    const first = flown?.seconds[0]?.joins ?? Number.NaN;
    const { flown: lost } = lossesOf(flown ?? { seconds: [], byHand: false });
    expect(lost).toBeCloseTo((flown?.joined ?? Number.NaN) - first, 6);
    expect(lost).toBeGreaterThan(60);
  });

  test("its leader's turn is found from where it was", () => {
    const flown = flownOf(historyOf("fig_6a"));
    const leader = flown?.seconds.map(({ t, sample: { leader } }) => ({ t, leader })) ?? [];
    const [straight, turn] = intentFlown(leader) ?? [];
    expect(straight).toHaveProperty("straight_s");
    expect(Math.abs((straight as { straight_s: number }).straight_s - 820)).toBeLessThan(5);
    expect(turn).toMatchObject({ direction: "right" });
    expect((turn as { turn_to_heading_deg: number }).turn_to_heading_deg).toBeCloseTo(135, 0);
    expect(Math.abs((turn as { bank_deg: number }).bank_deg - 25)).toBeLessThan(2);
  });

  test("a leader that changes its speed flew no chain of turns", () => {
    const leader = (tas_mps: number) => aircraft({ tas_mps });
    expect(
      intentFlown([
        { t: 0, leader: leader(200) },
        { t: 1, leader: leader(190) },
      ]),
    ).toBeNull();
  });
});

test("plans are own ship's: what others plan who join somebody as well is not counted", () => {
  const history = createHistory();
  const others = { ...planChanged(1), ident: "THIRD" };
  history.merge([STARTED, planChanged(0), others, sample(0), sample(2)]);
  expect(plansOf(history)).toEqual([planChanged(0)]);
});

describe("flown by hand", () => {
  const bars = (commanded_bank_deg: number): Bars[] => [
    { roll_deg: 0, pitch_deg: 0, commanded_bank_deg, commanded_climb_mps: 0 },
  ];

  test("counts as a flight does: bars in view, and the bank within 2° of them", () => {
    const history = createHistory();
    const hand = { autopilot: false, director: true };
    history.merge([
      STARTED,
      planChanged(0),
      sample(0, { engagement: "engaged" }),
      sample(1, { ...hand, bars: bars(1.9) }),
      sample(2, { ...hand, bars: bars(2.1) }),
      sample(3, { autopilot: false }),
      sample(4, { joined: true, mode: "follow" }),
    ]);
    const flown = flownOf(history);
    expect([flown?.from, flown?.joined, flown?.byHand]).toEqual([1, 4, true]);
    const counted = flown === null ? null : countByHand(history, flown);
    expect(counted).toMatchObject({ time_s: 3, with_bars_s: 2, within_bar_s: 1 });
  });

  test("is as far beside a path as the nearest of its lines", () => {
    const line = [
      { x_m: 0, y_m: 0 },
      { x_m: 100, y_m: 0 },
      { x_m: 100, y_m: 100 },
    ];
    expect(beside(line, { x_m: 50, y_m: -30 })).toBe(30);
    expect(beside(line, { x_m: 103, y_m: 140 })).toBe(Math.hypot(3, 40));
    expect(beside([], { x_m: 1, y_m: 1 })).toBe(0);
  });
});

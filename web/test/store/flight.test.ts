import { describe, expect, test } from "vitest";
import { createFlightStore } from "../../src/store/flight";
import { moveSample } from "../../src/store/motion";
import { noticesOf } from "../../src/store/notices";
import { numbersOf } from "../../src/store/numbers";
import { pictureOf } from "../../src/store/picture";
import { createShown } from "../../src/store/shown";
import type { Engagement, EngagementChanged, PlanProposed } from "../../src/wire";
import {
  aircraft,
  alert,
  amend,
  LEADER,
  modeChanged,
  noPlan,
  OWN,
  pairAt,
  planChanged,
  STARTED,
  sample,
  tick,
  unable,
} from "../samples";

/** A store that has joined a flight at time `t`, at wall time 1000 ms. */
function joined(t = 0, rate = 1) {
  const store = createFlightStore();
  store.link("open");
  store.receive(tick(t, [STARTED, modeChanged(0), planChanged(0), sample(t)], { rate }), 1000);
  return store;
}

describe("between two pictures", () => {
  test("only what has flown since is told, and the next picture goes on from there", () => {
    const { flight, receive, advance, glide } = joined();
    advance(1100);
    const [now, numbers] = [flight.moment.value.now, flight.read.value.now];
    glide(1250);
    expect(flight.since.value).toBeCloseTo(0.15, 9);
    expect([flight.moment.value.now, flight.read.value.now]).toEqual([now, numbers]);
    advance(1260);
    expect(flight.since.value).toBe(0);
    expect(flight.moment.value.t).toBeCloseTo(0.26, 9);
    glide(1400);
    // a tick that says less than is shown: the picture waits, and never runs backward
    receive(tick(0.2, [sample(0.2)]), 1405);
    expect(flight.moment.value.t).toBeGreaterThanOrEqual(0.4);
  });

  test("it is carried no further ahead of the data than a picture is", () => {
    const { flight, glide } = joined();
    glide(9000);
    expect(flight.since.value).toBe(2);
  });
});

describe("what the ticks say", () => {
  test("a late joiner gets flight, plan, mode, trail and the newest sample, and no old news as new", () => {
    const store = createFlightStore();
    const past = [0, 10, 20, 30].map((t) => sample(t));
    store.receive(
      tick(34, [STARTED, planChanged(3), modeChanged(3), ...past, sample(34)], { rate: 2 }),
      50_000,
    );
    const { flight } = store;
    expect(flight.moment.value.started?.title).toBe("Fig. 6b");
    expect(flight.moment.value.plan?.t_s).toBe(3);
    expect(flight.moment.value.superseded).toBeNull();
    expect(flight.moment.value.trail.pursuer.map((p) => p.t)).toEqual([0, 10, 20, 30]);
    expect(flight.moment.value.sample?.t_s).toBe(34);
    expect(flight.moment.value.mode?.t_s).toBe(3);
    expect(pictureOf(flight.moment.value).boxed).toBe(false); // 31 s ago
  });

  test("a new plan replaces the old one, which stays visible for three seconds", () => {
    const store = joined();
    const faded = () => pictureOf(store.flight.moment.value).superseded;
    store.receive(tick(1, [planChanged(1), sample(1)]), 2000);
    expect(store.flight.moment.value.plan?.t_s).toBe(1);
    expect(faded()?.t_s).toBe(0);
    store.receive(tick(3.9, [sample(3.9)]), 4900);
    expect(faded()?.t_s).toBe(0);
    store.receive(tick(4.1, [sample(4.1)]), 5100);
    expect(faded()).toBeNull();
  });

  test("what is shown for a while is seen for two seconds, however fast the flight goes", () => {
    const store = joined(0, 60);
    const faded = () => pictureOf(store.flight.moment.value).superseded;
    store.receive(tick(60, [planChanged(60), sample(60)], { rate: 60 }), 2000);
    store.receive(tick(174, [sample(174)], { rate: 60 }), 3900);
    expect(faded()?.t_s).toBe(0);
    store.receive(tick(192, [sample(192)], { rate: 60 }), 4200);
    expect(faded()).toBeNull();
  });

  test("no plan is told until there is one again", () => {
    const store = joined();
    store.receive(tick(1, [noPlan(1), sample(1)]), 2000);
    expect(store.flight.moment.value.unavailable?.answer.reason).toBe("slot_unreachable");
    store.receive(tick(2, [sample(2)]), 3000);
    const trouble = () => numbersOf(store.flight.moment.value).trouble;
    expect(trouble()).toEqual({ label: "No plan", sentence: "The leader is faster." });
    // its numbers are those of its second: from then on it is dated
    store.receive(tick(12, [sample(12)]), 13_000);
    expect(trouble()?.sentence).toBe("As of 00:01: the leader is faster.");
    store.receive(tick(13, [planChanged(13), sample(13)]), 14_000);
    expect(store.flight.moment.value.unavailable).toBeNull();
  });

  test("several documents of one tick are taken in order; the log is newest first", () => {
    const store = joined();
    store.receive(tick(3, [planChanged(1), noPlan(2), planChanged(3), sample(3)]), 2000);
    expect(store.flight.moment.value.plan?.t_s).toBe(3);
    expect(store.flight.moment.value.messages.map((m) => m.t)).toEqual([3, 2, 1, 0, 0]);
  });

  test("being told the same again, after a broken link, adds nothing to the log", () => {
    const store = joined();
    const before = store.flight.moment.value.messages;
    store.receive(tick(9, [STARTED, modeChanged(0), planChanged(0), sample(0), sample(9)]), 9000);
    expect(store.flight.moment.value.messages).toEqual(before);
    expect(store.flight.moment.value.superseded).toBeNull();
  });

  test("a plan that is no news is flown and not logged, and the old one is not shown", () => {
    const store = joined();
    const before = store.flight.moment.value.messages;
    store.receive(tick(1, [{ ...planChanged(1), announced: false }, sample(1)]), 2000);
    expect(store.flight.moment.value.plan?.t_s).toBe(1);
    expect(store.flight.moment.value.superseded).toBeNull();
    expect(store.flight.moment.value.messages).toEqual(before);
  });

  test("an alert stands until it is cleared, and a newer one on the subject takes its place", () => {
    const store = joined();
    const alerts = () => store.flight.moment.value.alerts;
    const [first, second] = [alert(1), alert(2, { level: "warning" })];
    store.receive(tick(2, [first, alert(1, { subject: "speed" }), second, sample(2)]), 2000);
    expect(alerts().map((each) => [each.subject, each.level])).toEqual([
      ["speed", "caution"],
      ["separation", "warning"],
    ]);
    store.receive(tick(3, [{ ...second, t_s: 3, cleared: true }, sample(3)]), 3000);
    expect(alerts().map((each) => each.subject)).toEqual(["speed"]);
    expect(store.flight.moment.value.messages[0]?.kind).toBe("clear");
  });

  test("unable holds until the next plan", () => {
    const store = joined();
    store.receive(tick(1, [unable(1), sample(1)]), 2000);
    expect(store.flight.moment.value.unable?.reason).toBe("geometry");
    store.receive(tick(2, [planChanged(2), sample(2)]), 3000);
    expect(store.flight.moment.value.unable).toBeNull();
  });

  test("of several links the first is shown, and nothing of the others", () => {
    const store = createFlightStore();
    const [own, leader] = STARTED.aircraft;
    const [link] = STARTED.links;
    if (own === undefined || leader === undefined || link === undefined) throw new Error("No link");
    const third = { ...own, ident: "THIRD" };
    const started = {
      ...STARTED,
      aircraft: [third, own, leader],
      links: [link, { ...link, pursuer: "THIRD", slot_distance_m: 1 }],
    };
    const both = sample(1);
    const [guidance] = both.guidance;
    if (guidance === undefined) throw new Error("No guidance");
    both.aircraft.unshift({ ...aircraft({ x_m: 9 }), ident: "THIRD" });
    both.guidance.unshift({ ...guidance, ident: "THIRD", mode: "heading" });
    const route = { kind: "leader_route", t_s: 1, ident: LEADER, segments: [] } as const;
    const foreign = [
      { ...route, segments: [], expected_by: "THIRD", intent_known: true },
      { ...planChanged(1), ident: "THIRD" },
      { ...modeChanged(1), ident: "THIRD" },
      { ...noPlan(1), ident: "THIRD" },
      alert(1, { ident: "THIRD" }),
      { ...unable(1), ident: "THIRD" },
    ];
    store.receive(tick(1, [started, ...foreign, both]), 1000);
    const { flight } = store;
    expect(flight.moment.value.started?.slot_distance_m).toBe(10000);
    expect(flight.moment.value.sample?.pursuer.ident).toBe(OWN);
    expect(flight.moment.value.sample?.leader.ident).toBe(LEADER);
    expect(flight.moment.value.sample?.mode).toBe("converge");
    const { route: shown, plan, mode, unavailable } = flight.moment.value;
    expect([shown, plan, mode, unavailable]).toEqual([null, null, null, null]);
    expect(flight.moment.value.messages).toEqual([]);
  });

  test("another flight begins with nothing of the first", () => {
    const store = joined(500);
    store.receive(tick(0, [STARTED, sample(0)], { flight_id: "two" }), 2000);
    expect(store.flight.moment.value.t).toBe(0);
    expect(store.flight.moment.value.plan).toBeNull();
    expect(store.flight.moment.value.messages).toEqual([]);
    expect(store.flight.moment.value.trail.leader).toHaveLength(1);
  });

  test("the trail keeps ten minutes at 10 s and thins what is older", () => {
    const store = joined();
    for (let t = 1; t <= 1800; t += 1) store.receive(tick(t, [sample(t)]), 1000 + 1000 * t);
    const times = store.flight.moment.value.trail.pursuer.map((p) => p.t);
    expect(times.filter((t) => t > 1200)).toHaveLength(60);
    expect(times.filter((t) => t <= 1180)).toHaveLength(20);
    expect(times[0]).toBe(0);
  });
});

describe("the picture between ticks", () => {
  test("moves on along the turn", () => {
    const store = createFlightStore();
    const turning = sample(0, { pursuer: aircraft({ turn_rate_degps: 3 }) });
    store.receive(tick(0, [STARTED, turning]), 0);
    store.advance(1000);
    expect(store.flight.moment.value.now?.pursuer.heading_deg).toBeCloseTo(93, 6);
    expect(store.flight.moment.value.now?.pursuer.y_m).toBeLessThan(0);
    expect(store.flight.moment.value.t).toBeCloseTo(1, 9);
  });

  test("stops two seconds of wall time ahead of the newest sample", () => {
    const store = joined(0, 10);
    store.advance(61_000);
    expect(store.flight.moment.value.now?.t_s).toBeCloseTo(20, 9);
  });

  test("never runs backward, whatever the jitter", () => {
    const store = joined(0, 10);
    let last = 0;
    for (let i = 1; i <= 400; i += 1) {
      const jitter = ((i * 7919) % 97) - 20; // deterministic, −20 to 76 ms
      store.receive(tick(i / 2, [sample(i / 2)], { rate: 10 }), 1000 + i * 50 + jitter);
      for (const ms of [1000 + i * 50 + jitter + 5, 1000 + i * 50 + jitter + 16]) {
        store.advance(ms);
        const now = store.flight.moment.value.now?.t_s ?? 0;
        expect(now).toBeGreaterThanOrEqual(last);
        last = now;
      }
    }
    expect(last).toBeGreaterThan(199);
    expect(last).toBeLessThan(201.5);
  });

  test("never runs backward, not even when the flight stopped short of where it was shown", () => {
    const store = joined(0, 10);
    store.advance(2000);
    store.receive(tick(8, [sample(8)], { rate: 10, paused: true }), 2010);
    expect(store.flight.moment.value.t).toBeCloseTo(10, 9);
    expect(store.flight.moment.value.now?.t_s).toBeCloseTo(10, 9);
  });

  test("stands still while paused, and the data do not age while ticks come", () => {
    const store = joined(100);
    store.receive(tick(100.05, [], { paused: true }), 1050);
    store.advance(4000);
    const still = store.flight.moment.value.now?.t_s;
    store.receive(tick(100.05, [], { paused: true }), 9000);
    store.advance(9010);
    expect(store.flight.moment.value.now?.t_s).toBe(still);
    expect(store.flight.moment.value.dataAge).toBeCloseTo(0.01, 6);
    expect(store.flight.connection.value).toBe("live");
  });

  test("does not leap when a new sample contradicts the old one a little", () => {
    const store = joined(0);
    store.advance(1050);
    const before = store.flight.moment.value.now?.pursuer.x_m ?? 0;
    store.receive(tick(0.05, [sample(0.05, { pursuer: aircraft({ x_m: 200 }) })]), 1050);
    expect(store.flight.moment.value.now?.pursuer.x_m).toBeCloseTo(before, 3);
    for (let ms = 1060; ms <= 2000; ms += 10) store.advance(ms);
    expect(store.flight.moment.value.now?.pursuer.x_m).toBeGreaterThan(400);
  });
});

describe("the age of the data", () => {
  test("flags old data after 2 s and calls them lost after 5 s", () => {
    const store = joined();
    store.advance(2900);
    expect(store.flight.connection.value).toBe("live");
    store.advance(3100);
    expect(store.flight.connection.value).toBe("stale");
    store.advance(6100);
    expect(store.flight.connection.value).toBe("lost");
    expect(store.flight.moment.value.dataAge).toBeCloseTo(5.1, 9);
  });

  test("ticks without samples are no fresh data while the flight runs", () => {
    const store = joined();
    store.receive(tick(3, []), 4000);
    expect(store.flight.connection.value).toBe("stale");
  });

  test("a closed link is lost at once, a new one connecting", () => {
    const store = joined();
    store.link("closed");
    expect(store.flight.connection.value).toBe("lost");
    store.link("connecting");
    expect(store.flight.connection.value).toBe("connecting");
  });
});

describe("engagement", () => {
  const changed = (t: number, previous: Engagement, engagement: Engagement): EngagementChanged => ({
    kind: "engagement_changed",
    t_s: t,
    ident: OWN,
    engagement,
    previous,
    message: `From ${previous} to ${engagement}.`,
  });

  function proposing() {
    const store = createFlightStore();
    const {
      kind: _kind,
      reason: _reason,
      announced: _announced,
      tube_m: _tube,
      ...plan
    } = planChanged(1);
    const proposed: PlanProposed = { ...plan, kind: "plan_proposed", others: [] };
    const engagement = "designated";
    store.receive(
      tick(1, [
        STARTED,
        changed(1, "off", "designated"),
        proposed,
        sample(1, { mode: "heading", engagement }),
      ]),
      1000,
    );
    return store;
  }

  test("a proposal stands until it is engaged or given up, not when it is accepted", () => {
    const store = proposing();
    expect(store.flight.moment.value.proposal?.t_s).toBe(1);
    store.receive(tick(2, [changed(2, "designated", "armed")]), 2000);
    expect(store.flight.moment.value.proposal?.t_s).toBe(1);
    store.receive(tick(3, [changed(3, "armed", "engaged")]), 3000);
    expect(store.flight.moment.value.proposal).toBeNull();
  });

  test("a time to converge of hours has room in its line", () => {
    const left = (time_to_go_s: number) => {
      const store = joined();
      store.receive(tick(1, [sample(1, { time_to_go_s })]), 2000);
      return numbersOf(store.flight.moment.value).toJoin;
    };
    expect(left(3599)).toBe("59:59");
    expect(left(6660)).toBe("1:51:00");
  });

  test("a cross-track of hundreds of miles has room in its line", () => {
    const aside = (miles: number) => {
      const store = joined();
      store.receive(tick(1, [sample(1, { cross_track_m: miles * 1852 })]), 2000);
      return numbersOf(store.flight.moment.value).crossTrack;
    };
    expect(["99.9R", "142L"]).toEqual([aside(99.94), aside(-142.4)]);
  });

  test("the least separation so far is never more than the separation that is shown", () => {
    const store = joined();
    const { flight } = store;
    const shown = () => {
      const { separation, leastSoFar } = numbersOf(flight.moment.value);
      return { separation, leastSoFar };
    };
    store.receive(tick(1, [sample(1)]), 2000);
    const falling = pairAt(1);
    for (const later of [-8, 0, 8]) {
      amend(flight, { now: moveSample(falling, later) });
      const { separation, leastSoFar } = shown();
      expect(leastSoFar).toBe(separation);
    }
    const passed = pairAt(1, { least_separation_m: 9300 });
    store.receive(tick(2, [sample(2, { least_separation_m: 9300 })]), 3000);
    amend(flight, { now: moveSample(passed, -8) });
    expect(shown()).toEqual({ separation: "11.0", leastSoFar: "5.0" });
    // what is only expected of a leader that is not heard is no least separation
    store.receive(tick(3, [sample(3, { least_separation_m: 19_960, leader_age_s: 2 })]), 4000);
    amend(flight, { now: pairAt(3, { separation_m: 9000, leader_age_s: 2 }) });
    expect(shown().leastSoFar).toBe("10.8");
  });

  test("an acceptance that has lapsed is said until it is given anew, or all is called off", () => {
    const store = proposing();
    const prompts = () =>
      noticesOf(store.flight.moment.value).flatMap(({ level, text }) =>
        level === "prompt" ? [text] : [],
      );
    expect(prompts()).toEqual(["CONV PROPOSED – CONFIRM"]);
    const state = { mode: "heading" } as const;
    store.receive(
      tick(2, [changed(2, "designated", "armed"), sample(2, { ...state, engagement: "armed" })]),
      2000,
    );
    expect(prompts()).toEqual(["CONV ACCEPTED – ENGAGE"]);
    const lapsed = sample(9, { ...state, engagement: "designated" });
    store.receive(tick(9, [changed(9, "armed", "designated"), lapsed]), 9000);
    expect(prompts()).toEqual(["PATH CHANGED – ACCEPT AGAIN"]);
    expect(numbersOf(store.flight.moment.value).lapsed).toBe("From armed to designated.");
    store.receive(tick(12, [changed(12, "designated", "armed")]), 12_000);
    expect(numbersOf(store.flight.moment.value).lapsed).toBe("");
  });

  test("what was accepted is sent, then accepted; what is refused is said so for ten seconds", () => {
    const store = proposing();
    const { picture } = createShown(store.flight);
    const order = () => picture.value.order;
    expect(order()).toBe("");
    store.flight.isSent.value = true;
    expect(order()).toBe("SENT");
    const armed = sample(2, { mode: "heading", engagement: "armed" });
    store.receive(tick(2, [changed(2, "designated", "armed"), armed]), 2000);
    expect(order()).toBe("ACCEPTED");
    store.receive(tick(3, [changed(3, "armed", "armed"), { ...armed, t_s: 3 }]), 3000);
    expect(order()).toBe("REJECTED");
    store.receive(tick(14, [{ ...armed, t_s: 14 }]), 14_000);
    expect(order()).toBe("ACCEPTED");
  });

  test("without a path there is no proposal, and with one no reason against it", () => {
    const store = proposing();
    store.receive(tick(2, [noPlan(2)]), 2000);
    expect(store.flight.moment.value.proposal).toBeNull();
    expect(store.flight.moment.value.unavailable).not.toBeNull();
  });

  test("what was flown is gone when it is disconnected", () => {
    const store = createFlightStore();
    store.receive(tick(0, [STARTED, modeChanged(0), planChanged(0), sample(0)]), 0);
    store.receive(tick(1, [changed(1, "engaged", "off"), modeChanged(1, "heading")]), 1000);
    expect(store.flight.moment.value.plan).toBeNull();
  });

  test("an order that was refused is logged as that and changes nothing", () => {
    const store = proposing();
    store.receive(tick(2, [changed(2, "designated", "designated")]), 2000);
    expect(store.flight.moment.value.messages[0]?.kind).toBe("refused");
    expect(store.flight.moment.value.proposal).not.toBeNull();
  });

  test("a leader that is not heard of flies straight on from where it was, and leaves no trail", () => {
    const store = proposing();
    const turned = { ...pairAt(1).leader, x_m: 0, y_m: 9e4, heading_deg: 0 };
    store.receive(tick(21, [sample(21, { leader: turned, leader_age_s: 20 })]), 21_000);
    const known = store.flight.moment.value.sample;
    expect(known?.leader.x_m).toBeCloseTo(20_000 + 200 * 21, 3);
    expect(known?.leader.y_m).toBeCloseTo(0, 3);
    expect(known?.separation_m).toBeCloseTo((known?.leader.x_m ?? 0) - 240 * 21, 3);
    expect(store.flight.moment.value.trail.leader.filter((point) => point.t > 1)).toEqual([]);
  });
});

describe("a flight that is no more", () => {
  test("stands at what was flown: no time passes after it, and its data do not grow old", () => {
    const { flight, end, receive, advance } = joined(10, 60);
    advance(1400);
    expect(flight.moment.value.t).toBeGreaterThan(30);
    end(1500);
    advance(9000);
    expect(flight.moment.value).toMatchObject({ t: 10, dataAge: 0, ended: true });
    // what was on its way to the picture when the connection closed
    receive(tick(12, [sample(12)], { rate: 60 }), 9100);
    advance(20_000);
    expect(flight.clock.value.ended).toBe(true);
    expect(flight.moment.value).toMatchObject({ t: 12, dataAge: 0, ended: true });
  });

  test("is looked at again from where the viewer was", () => {
    const { flight, end, seek, receive, follow } = joined(10, 60);
    receive(tick(20, [sample(20)], { rate: 60 }), 1100);
    seek(15, 0, 1200);
    end(1300);
    expect(flight.moment.value.t).toBe(15);
    follow(9000);
    expect(flight.moment.value).toMatchObject({ t: 20, dataAge: 0 });
  });
});

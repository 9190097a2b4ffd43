import { signal } from "@preact/signals";
import { act } from "preact/test-utils";
import { expect, test } from "vitest";
import { emptyFlight } from "../../src/store/flight";
import type { PairSample } from "../../src/store/pair";
import { createShown } from "../../src/store/shown";
import type { Flight } from "../../src/store/types";
import { alert, amend, separationLost, unable } from "../samples";
import { mountDisplay } from "./draw";
import { documentsOf, flightAt, setTime } from "./fixture";

function show(flight: Flight, mode: "ROSE" | "ARC" = "ROSE", range = 80): Element {
  return mountDisplay({
    shown: createShown(flight),
    mode: signal(mode),
    range: signal(range),
  });
}

/** Signals write to the page at once; what appears or goes is drawn in the next task. */
async function drawn(): Promise<void> {
  await new Promise((done) => setTimeout(done, 0));
}

function has(root: Element, name: string): boolean {
  return root.querySelector(`.nd-${name}`) !== null;
}

function words(root: Element): string {
  return [...root.querySelectorAll("text")].map((each) => each.textContent).join(" ");
}

function change(flight: Flight, sample: Partial<PairSample>): void {
  if (flight.moment.value.sample === null) throw new Error("An empty flight.");
  const changed = { ...flight.moment.value.sample, ...sample };
  amend(flight, { sample: changed, now: changed });
}

test("before any data: a flag and no map, no numbers, no own ship symbol", () => {
  const root = show(emptyFlight());
  expect(words(root)).toContain("MAP NOT AVAIL");
  for (const gone of ["map", "leader", "slot", "spacing", "track", "label"])
    expect(has(root, gone), gone).toBe(false);
  expect(root.querySelector(".nd-ownship circle")).not.toBeNull();
  expect(root.querySelector(".nd-tape text")).toBeNull();
  expect(root.querySelector("[role=img]")?.getAttribute("aria-label")).toContain(
    "Map not available",
  );
});

test("the first sample brings the map without a new display", async () => {
  const flight = emptyFlight();
  const root = show(flight);
  const { started, route, plan } = documentsOf("fig_6b");
  amend(flight, { started: started });
  amend(flight, { route: route });
  amend(flight, { plan: plan });
  setTime(flight, 10, "converge");
  await drawn();
  for (const there of ["map", "leader", "slot", "spacing", "track", "label"])
    expect(has(root, there), there).toBe(true);
  expect(words(root)).not.toContain("MAP NOT AVAIL");
});

test("a frame moves attributes and builds nothing", async () => {
  const flight = flightAt("fig_6b", 200);
  const root = show(flight);
  const before = [...root.querySelectorAll("*")];
  const transform = root.querySelector(".nd-world")?.getAttribute("transform");
  setTime(flight, 200.05, "converge");
  await drawn();
  expect(root.querySelector(".nd-world")?.getAttribute("transform")).not.toBe(transform);
  const after = [...root.querySelectorAll("*")];
  expect(after.length).toBe(before.length);
  expect(after.every((element, i) => element === before[i])).toBe(true);
});

test("between two pictures the glass is carried on, and nothing in it changes", () => {
  const flight = flightAt("crossing", 60);
  const now = flight.moment.value.now;
  if (now === null) throw new Error("An empty flight.");
  change(flight, { pursuer: { ...now.pursuer, turn_rate_degps: 1.2 } });
  let root = document.createElement("div") as Element;
  act(() => {
    root = show(flight);
  });
  const bare = () => root.innerHTML.replace(/ style="[^"]*"/g, "");
  const carried = () =>
    [...root.querySelectorAll<SVGElement>(".nd-plane")].map(({ style }) => style.transform);
  const [before, from] = [bare(), carried()];
  act(() => {
    flight.since.value = 0.18;
  });
  expect(bare()).toBe(before);
  const to = carried();
  const moves = to.map((each, i) => each !== from[i]);
  // ground, the world's six, own ship, tape, nose, labels of map, tape and leader, readouts
  const world = [true, true, true, true, true, true];
  expect(moves).toEqual([false, ...world, false, true, false, true, true, true, false]);
});

test.each([
  [1, { ring: "", flag: "", slot: true, leader: true }],
  [3, { ring: "10 7", flag: "", slot: true, leader: true }],
  [7, { ring: "10 7", flag: "LDR DATA", slot: true, leader: true }],
  [15, { ring: "10 7", flag: "LDR DATA LOST", slot: false, leader: true }],
  [30, { ring: null, flag: "MAP NOT AVAIL", slot: false, leader: false }],
])("data %i s old", (age, expected) => {
  const flight = flightAt("fig_6b", 600);
  amend(flight, { dataAge: age });
  const root = show(flight, "ARC", 40);
  const ring =
    root.querySelector(".nd-leader circle.nd-stroke")?.getAttribute("stroke-dasharray") ?? null;
  expect(ring).toBe(expected.ring);
  expect(root.querySelector(".nd-flag")?.textContent ?? "").toBe(expected.flag);
  expect(has(root, "slot")).toBe(expected.slot);
  expect(has(root, "leader")).toBe(expected.leader);
  if (age > 2 && expected.leader) expect(words(root)).toContain(`${age} S`);
});

test("a flight that has ended does not grow old", () => {
  const flight = flightAt("fig_6b", 900, "follow");
  amend(flight, { ended: true });
  amend(flight, { dataAge: 100 });
  expect(has(show(flight, "ARC", 20), "leader")).toBe(true);
});

test("a new mode is boxed for ten seconds", async () => {
  const flight = flightAt("fig_6b", 10);
  const { mode } = flight.moment.value;
  amend(flight, { mode: mode === null ? null : { ...mode, t_s: 10 } });
  const root = show(flight);
  expect(has(root, "box")).toBe(true);
  setTime(flight, 19.9, "converge");
  await drawn();
  expect(has(root, "box")).toBe(true);
  setTime(flight, 20.1, "converge");
  await drawn();
  expect(has(root, "box")).toBe(false);
});

test("a leader off the map is half a symbol on the edge, with what to select", async () => {
  const flight = flightAt("crossing", 30);
  const range = signal(20);
  const mode = signal<"ROSE" | "ARC">("ARC");
  const root = mountDisplay({ shown: createShown(flight), mode, range });
  expect(has(root, "leader")).toBe(false);
  expect(has(root, "offscale")).toBe(true);
  expect(words(root)).toMatch(/AF123 \d{3}° \d+\.\d → (ROSE|RANGE \d+)/);
  mode.value = "ROSE";
  range.value = 160;
  await drawn();
  expect(has(root, "leader")).toBe(true);
  expect(has(root, "offscale")).toBe(false);
});

test("the leader is never lost, whatever is selected", () => {
  for (const mode of ["ROSE", "ARC"] as const) {
    for (const range of [10, 20, 40, 80, 160, 320]) {
      for (const t of [0, 200, 450]) {
        const root = show(flightAt("crossing", t), mode, range);
        expect(has(root, "leader") !== has(root, "offscale")).toBe(true);
        expect(words(root)).toContain("AF123");
      }
    }
  }
});

test("unknown intent is dotted and said in words, declared intent is dash-dot", () => {
  const unknown = show(flightAt("fig_6a", 300), "ARC", 40);
  expect(words(unknown)).toContain("NO INTENT");
  expect(has(unknown, "intent")).toBe(false);
  expect(has(unknown, "guess")).toBe(true);
  const known = show(flightAt("fig_6b", 100), "ARC", 80);
  expect(words(known)).toContain("135°");
  expect(has(known, "intent")).toBe(true);
});

test("a lost separation is a red solid circle and a warning", () => {
  const flight = flightAt("fig_6b", 300);
  change(flight, { separation_m: 8_000 });
  const root = show(flight, "ARC", 40);
  const circle = root.querySelector(".nd-circle .nd-stroke");
  expect(circle?.getAttribute("stroke")).toBe("var(--alert)");
  expect(circle?.getAttribute("stroke-dasharray")).toBe("");
  expect(words(root)).toContain("SEPARATION");
});

test("a loss that is coming is amber and says when", () => {
  const flight = flightAt("fig_6b", 300, "heading");
  amend(flight, { alerts: [alert(299, { subject: "separation", predicted_at_s: 342 })] });
  const root = show(flight, "ROSE", 80);
  expect(root.querySelector(".nd-circle .nd-stroke")?.getAttribute("stroke")).toBe(
    "var(--caution)",
  );
  expect(words(root)).toContain("SEP IN 42 S");
});

test("an alert is in the message line with its level's colour, before lesser news", () => {
  const flight = flightAt("fig_6b", 300);
  amend(flight, {
    alerts: [
      alert(290, { level: "advisory", subject: "speed" }),
      alert(295, { predicted_at_s: 340 }),
    ],
  });
  const line = show(flight, "ARC", 40).querySelector(".nd-message");
  expect(line?.querySelector("text")?.textContent).toBe("SEP IN 40 S");
  expect(line?.querySelector("text")?.getAttribute("fill")).toBe("var(--caution)");
  amend(flight, { alerts: flight.moment.value.alerts.slice(0, 1) });
  const lesser = show(flight, "ARC", 40).querySelector(".nd-message text");
  expect(lesser?.textContent).toBe("LDR SPEED");
  expect(lesser?.getAttribute("fill")).toBe("var(--label)");
});

test("a loss of separation that was just given is a warning", () => {
  const flight = flightAt("fig_6b", 300);
  amend(flight, { lost: separationLost(300) });
  const text = show(flight, "ARC", 40).querySelector(".nd-message text");
  expect(text?.textContent).toBe("SEPARATION");
  expect(text?.getAttribute("fill")).toBe("var(--alert)");
  amend(flight, { t: 303.1 });
  const later = show(flight, "ARC", 40).querySelector(".nd-message text");
  expect(later?.textContent ?? "").not.toBe("SEPARATION");
});

test("unable says why; escape is a mode of its own", () => {
  const flight = flightAt("fig_6b", 300, "escape");
  amend(flight, { unable: unable(299) });
  const root = show(flight, "ARC", 80);
  expect(words(root)).toContain("RG UNABLE: PATH");
  expect(words(root)).toContain("RG ESC");
  expect(root.querySelector(".nd-slot .nd-stroke")?.getAttribute("stroke")).toBe("var(--caution)");
  expect(root.querySelector("[role=img]")?.getAttribute("aria-label")).toContain("turning away");
});

test("a plan that is no news is drawn and not announced", () => {
  const flight = flightAt("fig_6b", 0.5);
  const plan = flight.moment.value.plan;
  if (plan === null) throw new Error("A flight without a plan.");
  expect(words(show(flight, "ARC", 80))).toContain("CONV ACTIVE");
  amend(flight, { plan: { ...plan, reason: "deviation", announced: false } });
  const root = show(flight, "ARC", 80);
  expect(words(root)).not.toContain("REPLAN");
  expect(has(root, "capture")).toBe(true);
});

test("no plan: the slot is crossed, the reason is in the message line", () => {
  const flight = flightAt("fig_6b", 300, "heading");
  amend(flight, {
    unavailable: {
      kind: "plan_unavailable",
      t_s: 300,
      ident: "RG456",
      answer: { status: "no_plan", reason: "slot_unreachable", message: "", lower_bound_s: 0 },
    },
  });
  const root = show(flight, "ARC", 80);
  expect(words(root)).toContain("RG UNABLE: SPEED");
  expect(root.querySelector(".nd-slot .nd-stroke")?.getAttribute("stroke")).toBe("var(--caution)");
  expect(has(root, "capture")).toBe(false);
});

test("the gate is filled once joined", () => {
  const open = show(flightAt("fig_6b", 700), "ARC", 40);
  const joined = show(flightAt("fig_6b", 900, "follow"), "ARC", 40);
  expect(open.querySelector(".nd-slot > path")?.getAttribute("fill")).toBe("none");
  expect(joined.querySelector(".nd-slot > path")?.getAttribute("fill")).toBe("var(--plan)");
  expect(words(joined)).toContain("RG TRK");
});

test("the next turn is named, and announced before the roll-in", () => {
  const early = show(flightAt("crossing", 5), "ROSE", 40);
  expect(words(early)).toContain("T1 L72");
  expect(has(early, "rollin")).toBe(false);
  expect(has(show(flightAt("crossing", 30), "ROSE", 40), "rollin")).toBe(true);
});

test("the old path is dotted while the new one is taken in", async () => {
  const flight = flightAt("crossing", 5);
  amend(flight, { superseded: { plan: documentsOf("fig_6b").plan, at: 3 } });
  const root = show(flight);
  const old = root.querySelector(".nd-fading .nd-stroke[d^='M']");
  expect(old?.getAttribute("stroke-dasharray")).toBe("2 11");
  amend(flight, { superseded: null });
  await drawn();
  expect(has(root, "fading")).toBe(false);
});

test.each([
  ["fig_6b", "right", 1],
  ["left", "left", 0],
] as const)("the turn of %s to the %s is commanded that way", (name, _side, sweep) => {
  const root = show(flightAt(name, 5), "ROSE", 80);
  const data = root.querySelector(".nd-commanded .nd-stroke")?.getAttribute("d") ?? "";
  // From the nose along the tape: SVG's sweep flag 1 is clockwise, to the right.
  const [, flag, x] = data.match(/A\S+ \S+ 0 0 (\d) (\S+)/) ?? [];
  expect(Number(flag)).toBe(sweep);
  expect(Math.sign(Number(x) - 384)).toBe(sweep === 1 ? 1 : -1);
});

test("the picture in words says mode, leader, time and separation", () => {
  const root = show(flightAt("fig_6b", 0.5), "ROSE", 80);
  const label = root.querySelector("[role=img]")?.getAttribute("aria-label") ?? "";
  expect(label).toMatch(/ROSE, range 80 nautical miles.*converging.*AF123 bearing 135, 30\.5/);
  expect(label).toContain("Slot in 14:45");
});

test("the picture of an instant that stands is the same whatever was shown before", async () => {
  const standing = (t: number): Flight => {
    const flight = flightAt("fig_6b", t);
    flight.source.value = { kind: "replay", rate: 0 };
    return flight;
  };
  const flight = standing(0);
  const root = show(flight, "ARC", 80);
  for (let t = 20; t < 800; t += 20) {
    const next = standing(t);
    await act(() => {
      flight.moment.value = next.moment.value;
      flight.read.value = next.read.value;
    });
    await drawn();
    const places = (all: Element) =>
      [...all.querySelectorAll(".nd-label")].map((each) => each.getAttribute("transform"));
    expect(places(root)).toEqual(places(show(next, "ARC", 80)));
  }
});

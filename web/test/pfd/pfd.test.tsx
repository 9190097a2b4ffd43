/** The instrument as it is drawn: what is on its face in each state, and that it is only moved. */

import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, describe, expect, test, vi } from "vitest";
import { PrimaryFlightDisplay } from "../../src/pfd/pfd";
import { createSession, type Session } from "../../src/session";
import type { PairSample } from "../../src/store/pair";
import type { Flight } from "../../src/store/types";
import { KT } from "../../src/units";
import type { AssignmentChanged } from "../../src/wire";
import { flightIn } from "../nd/in-state";
import { amend, modeChanged, OWN } from "../samples";

const place = document.body.appendChild(document.createElement("div"));
afterEach(() => render(null, place));

const BARS = { roll_deg: -20, pitch_deg: 0.5, commanded_bank_deg: -25, commanded_climb_mps: 0 };
const BY_HAND: Partial<PairSample> = { autopilot: false, director: true, bars: [BARS] };

function change(flight: Flight, changes: Partial<PairSample>): void {
  const { sample } = flight.moment.value;
  if (sample === null) throw new Error("An empty flight.");
  const changed = { ...sample, ...changes };
  amend(flight, { sample: changed, now: changed });
}

async function show(
  changes: Partial<PairSample>,
  state: "converge" | "data_lost" | "off" = "converge",
) {
  const flight = flightIn(state);
  flight.clock.value = { rate: 1, paused: true, ended: false };
  change(flight, changes);
  const session = createSession(flight);
  await act(() => render(<PrimaryFlightDisplay session={session} />, place));
  await act(async () => {
    await new Promise((done) => setTimeout(done, 40));
  });
  return { flight, session };
}

function sheet(name: string): HTMLElement | null {
  return place.querySelector<HTMLElement>(`.pfd-${name}`);
}

function words(): string {
  return [...place.querySelectorAll("text")].map((each) => each.textContent).join("|");
}

test("the least speed and the most bank of the autopilot are marked where they are known", async () => {
  const marks = (name: string) => sheet(name)?.querySelectorAll("path").length ?? 0;
  const { flight } = await show(BY_HAND);
  const [bank, speed] = [marks("bank"), marks("speed")];
  const { started } = flight.moment.value;
  if (started === null) throw new Error("An empty flight.");
  const pursuer = { ...started.pursuer, autopilot_bank_deg: 30 };
  await act(() => {
    amend(flight, { started: { ...started, pursuer } });
    change(flight, { least_tas_mps: 180 * KT });
  });
  expect(marks("bank")).toBeGreaterThan(bank);
  expect(marks("speed")).toBeGreaterThan(speed);
  await expect(`${sheet("bank")?.outerHTML}\n`).toMatchFileSnapshot("snapshots/bank.html");
  await expect(`${sheet("speed")?.outerHTML}\n`).toMatchFileSnapshot("snapshots/speed.html");
});

test("on a small screen it comes into sight as this page begins to fly, and on others stays", async () => {
  const seen: Element[] = [];
  vi.spyOn(Element.prototype, "scrollIntoView").mockImplementation(function (this: Element) {
    seen.push(this);
  });
  for (const [matches, most] of [
    [false, 0],
    [true, 1],
  ] as const) {
    vi.stubGlobal("matchMedia", () => ({ matches }));
    const { session } = await show(BY_HAND);
    expect(seen).toEqual([]);
    await act(() => {
      session.hands.value = {} as NonNullable<Session["hands"]["value"]>;
    });
    expect(seen).toHaveLength(most);
    render(null, place);
  }
  vi.restoreAllMocks();
  vi.unstubAllGlobals();
});

describe("a left turn by hand, the bars off the middle", () => {
  test("the sphere turns against the bank, the bars stand where they ask own ship to go", async () => {
    const { flight } = await show(BY_HAND);
    const now = flight.moment.value.now;
    if (now === null) throw new Error("An empty flight.");
    change(flight, { pursuer: { ...now.pursuer, bank_deg: -25 } });
    await new Promise((done) => setTimeout(done, 40));
    expect(sheet("ball")?.style.transform).toMatch(/^rotate\(25deg\) translateY\(/);
    expect(sheet("index")?.style.transform).toBe("rotate(25deg)");
    expect(sheet("roll")?.style.transform).toMatch(/^translateX\(-/);
    expect(sheet("pull")?.style.transform).toMatch(/^translateY\(-/);
  });

  test("looks as it did", async () => {
    await show(BY_HAND);
    const drawn = (place.querySelector(".pfd")?.innerHTML ?? "").replaceAll("><", ">\n<");
    const short = drawn.replace(/-?\d+\.\d{3,}/g, (number) =>
      String(Number(Number(number).toFixed(2))),
    );
    await expect(`${short}\n`).toMatchFileSnapshot("snapshots/turning.html");
  });

  test("is only moved: a frame writes transforms, and nothing in it is drawn anew", async () => {
    const { flight } = await show(BY_HAND);
    const parts = [...place.querySelectorAll(".pfd *")];
    const now = flight.moment.value.now;
    if (now === null) throw new Error("An empty flight.");
    change(flight, { pursuer: { ...now.pursuer, bank_deg: 7 }, bars: [{ ...BARS, roll_deg: 3 }] });
    await new Promise((done) => setTimeout(done, 40));
    expect([...place.querySelectorAll(".pfd *")]).toEqual(parts);
    expect(sheet("index")?.style.transform).toBe("rotate(-7deg)");
  });
});

describe("the flight director", () => {
  test.each([
    ["off", { director: false, bars: [] }, [false, false]],
    ["with bars", { director: true, bars: [BARS] }, [true, false]],
    ["without data for bars", { director: true, bars: [] }, [false, true]],
    ["of a recording of before", {}, [false, false]],
  ] as const)("%s", async (_, changes, expected) => {
    await show(changes as Partial<PairSample>);
    expect([sheet("roll") !== null, sheet("flag") !== null]).toEqual(expected);
  });

  test("calls for nine seconds after guidance has given up, and not for longer", async () => {
    const { flight } = await show({ ...BY_HAND, mode: "heading" }, "data_lost");
    const { t } = flight.moment.value;
    const flashes = async (since: number) => {
      amend(flight, { mode: { ...modeChanged(t - since, "heading"), previous: "converge" } });
      await new Promise((done) => setTimeout(done, 10));
      return place.querySelector(".pfd-flash") !== null;
    };
    expect(await flashes(1)).toBe(true);
    expect(await flashes(8.9)).toBe(true);
    expect(await flashes(9.1)).toBe(false);
    expect(words()).toContain("HDG");
  });
});

test("without data there is a flag and no attitude", async () => {
  const { flight } = await show(BY_HAND);
  await act(() => amend(flight, { sample: null, now: null }));
  expect(sheet("ball")).toBeNull();
  expect(words()).toBe("ATT");
});

test("where the leader is not known, no separation is", async () => {
  await show({ ...BY_HAND, leader_age_s: 15 }, "data_lost");
  expect(sheet("now")).toBeNull();
  expect(words()).toContain("---");
});

test("D, d_min and the selected speed are those that the crew has changed to", async () => {
  const { flight } = await show(BY_HAND);
  const assignment: AssignmentChanged = {
    kind: "assignment_changed",
    t_s: 1,
    ident: OWN,
    slot_distance_m: 18_520,
    min_separation_m: 5556,
    max_bank_deg: 20,
    selected_tas_mps: [220],
    message: "D is 10.0 NM.",
  };
  const { started } = flight.moment.value;
  if (started === null) throw new Error("An empty flight.");
  const { slot_distance_m, min_separation_m } = assignment;
  await act(() =>
    amend(flight, { assignment, started: { ...started, slot_distance_m, min_separation_m } }),
  );
  await new Promise((done) => setTimeout(done, 40));
  expect(words()).toContain("SPD 428");
  expect(words()).toContain("MIN 3.0  D 10.0");
});

test("what to do is said while the crew flies along the bars, and only then", async () => {
  const said = (session: Session) => {
    expect(session.flight.read.value.now).not.toBeNull();
    return place.querySelector("[role=status]")?.textContent;
  };
  const { session } = await show(BY_HAND);
  expect(said(session)).toBe("Fly left, 25° of bank.");
  await act(() => change(session.flight, { autopilot: true }));
  expect(said(session)).toBe("");
});

import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { type Crew, createCrew } from "../../src/hands/crew";
import { StickPad } from "../../src/hands/pad";
import { createSession, type Session } from "../../src/session";
import { createFlightStore } from "../../src/store/flight";
import { pairCard } from "../../src/store/pair";
import type { Stream } from "../../src/stream";
import type { ControlAnswer, StickMove, Upstream } from "../../src/wire";
import { amend, OWN, pairAt, STARTED, sample, tick } from "../samples";
import { silentActions } from "../silence";

/** A frame of the page [ms]. */
const FRAME = 16;

interface Page {
  readonly session: Session;
  readonly crew: Crew;
  readonly stream: Stream;
  readonly sent: Upstream[];
  readonly commands: unknown[];
  /** The service answers. */
  answer(yours: boolean, message?: string): void;
  /** The rolls that were sent since this was asked before. */
  rolls(): number[];
}

let end = () => {};

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("requestAnimationFrame", (draw: FrameRequestCallback) =>
    setTimeout(() => draw(performance.now()), FRAME),
  );
});

afterEach(() => {
  end();
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

function opened(rate = 1): Page {
  const store = createFlightStore();
  const session = createSession(store.flight);
  const { flight } = session;
  const now = pairAt(0);
  amend(flight, { started: pairCard(STARTED), sample: now, now });
  flight.heard.value = { tick: tick(0, [sample(0)]), wall: 0 };
  flight.id.value = "one";
  flight.span.value = { first: 0, last: 1 };
  flight.connection.value = "live";
  flight.clock.value = { rate, paused: false, ended: false };
  session.status.value = { id: "one" } as NonNullable<Session["status"]["value"]>;
  const sent: Upstream[] = [];
  const commands: unknown[] = [];
  const stream: Stream = {
    answered: null,
    send: (frame) => sent.push(frame) > 0,
    retry: () => {},
    close: () => {},
  };
  const crew = createCrew({
    session,
    async command(body, _, done) {
      commands.push([body, done]);
    },
    say: (kind, text) => {
      session.feedback.value = { kind, text };
    },
    refusal: () => null,
    stream: () => stream,
  });
  end = () => session.hands.value?.end();
  return {
    session,
    crew,
    stream,
    sent,
    commands,
    answer: (yours, message = "") =>
      stream.answered?.({ kind: "control", yours, message } satisfies ControlAnswer),
    rolls: () =>
      sent.splice(0).flatMap((each) => (each.kind === "stick" ? [(each as StickMove).roll] : [])),
  };
}

async function flying(rate = 1): Promise<Page> {
  const page = opened(rate);
  page.crew.setAutopilot(false);
  await vi.advanceTimersByTimeAsync(0);
  page.answer(true, "You have control.");
  page.sent.length = 0;
  return page;
}

function press(key: string, how: KeyboardEventInit = {}, type = "keydown"): KeyboardEvent {
  const event = new KeyboardEvent(type, { key, bubbles: true, cancelable: true, ...how });
  document.body.dispatchEvent(event);
  return event;
}

describe("control", () => {
  test("is taken with the bars unless they were switched off, and the answer is said", async () => {
    const page = opened();
    page.crew.setAutopilot(false);
    await vi.advanceTimersByTimeAsync(0);
    expect(page.sent).toEqual([{ kind: "take_control", director: true }]);
    expect(page.session.hands.value).toBeNull();
    page.session.debriefOpen.value = true;
    page.answer(true, "You have control.");
    expect(page.session.debriefOpen.value).toBe(false);
    expect(page.session.hands.value).not.toBeNull();
    expect(page.session.feedback.value).toEqual({ kind: "done", text: "You have control." });
    page.crew.setAutopilot(true);
    expect(page.sent.at(-1)).toEqual({ kind: "give_back" });
    page.answer(false, "The autopilot flies.");
    expect(page.session.hands.value).toBeNull();
    expect(page.session.feedback.value.kind).toBe("done");
    page.crew.setDirector(false);
    page.crew.setAutopilot(false);
    await vi.advanceTimersByTimeAsync(0);
    expect(page.sent.at(-1)).toEqual({ kind: "take_control", director: false });
  });

  test("is taken as a lesson says, with no word of its own, until the next flight", async () => {
    const page = opened();
    page.crew.setAutopilot(false, false);
    page.crew.setAutopilot(false);
    await vi.advanceTimersByTimeAsync(0);
    const raw = { kind: "take_control", director: false };
    expect(page.sent).toEqual([raw, raw]);
    expect(page.commands).toEqual([]);
    page.session.flight.id.value = "two";
    page.crew.setAutopilot(false);
    await vi.advanceTimersByTimeAsync(0);
    expect(page.sent.at(-1)).toEqual({ kind: "take_control", director: true });
  });

  test("that is refused or lost is said, and nothing is flown by hand", async () => {
    const page = opened();
    page.crew.setAutopilot(false);
    await vi.advanceTimersByTimeAsync(0);
    page.answer(false, "Another page flies it by hand.");
    expect(page.session.feedback.value).toMatchObject({ kind: "refused" });
    expect(page.session.hands.value).toBeNull();
    const other = await flying();
    other.session.flight.connection.value = "lost";
    expect(other.session.hands.value).toBeNull();
    expect(other.session.feedback.value).toMatchObject({
      kind: "refused",
      text: "The connection to the server is lost. The autopilot flies.",
    });
  });

  test("of a fast flight is taken at ×1, with a word", async () => {
    const page = opened(20);
    page.crew.setAutopilot(false);
    await vi.advanceTimersByTimeAsync(0);
    expect(page.commands).toEqual([
      [{ command: "set_rate", rate: 1 }, "Rate ×1 from ×20: by hand ×5 is the most."],
    ]);
    expect(page.sent).toEqual([{ kind: "take_control", director: true }]);
  });

  test("ends with its flight, and with another one in its place", async () => {
    const page = await flying();
    page.session.flight.clock.value = { rate: 1, paused: false, ended: true };
    expect(page.session.hands.value).toBeNull();
    const other = await flying();
    other.session.status.value = { id: "two" } as NonNullable<Session["status"]["value"]>;
    expect(other.session.hands.value).toBeNull();
  });
});

describe("what the crew selects", () => {
  const ASSIGNED = {
    kind: "assignment_changed",
    t_s: 2,
    ident: OWN,
    slot_distance_m: 10_000,
    min_separation_m: 9260,
    max_bank_deg: 25,
    selected_tas_mps: [] as number[],
    message: "",
  } as const;

  test.each([
    ["speed", (crew: Crew) => crew.selectSpeed(130), {}, "250 kt is refused, it stays as it is."],
    ["bank", (crew: Crew) => crew.selectBank(50), {}, "50° of bank is refused."],
    ["D", (crew: Crew) => crew.setSpacing({ slot_distance_m: 50 }), {}, "Refused: D stays 5.4 NM."],
  ])("and the flight refuses is said to be refused: %s", async (_, select, change, message) => {
    const page = opened();
    select(page.crew);
    await vi.advanceTimersByTimeAsync(0);
    expect(page.session.feedback.value.kind).toBe("none");
    amend(page.session.flight, { assignment: { ...ASSIGNED, ...change, message } });
    expect(page.session.feedback.value).toEqual({ kind: "refused", text: message });
  });

  test.each([
    ["speed", (crew: Crew) => crew.selectSpeed(130), { selected_tas_mps: [130] }],
    ["no speed", (crew: Crew) => crew.selectSpeed(null), {}],
    ["bank", (crew: Crew) => crew.selectBank(20), { max_bank_deg: 20 }],
    [
      "D",
      (crew: Crew) => crew.setSpacing({ slot_distance_m: 12_000 }),
      { slot_distance_m: 12_000 },
    ],
  ])("and the flight obeys is said in its words: %s", async (_, select, change) => {
    const page = opened();
    select(page.crew);
    await vi.advanceTimersByTimeAsync(0);
    amend(page.session.flight, { assignment: { ...ASSIGNED, ...change, message: "Now so." } });
    expect(page.session.feedback.value).toEqual({ kind: "done", text: "Now so." });
    amend(page.session.flight, { assignment: { ...ASSIGNED, message: "Another page's." } });
    expect(page.session.feedback.value).toEqual({ kind: "done", text: "Now so." });
  });
});

describe("keys", () => {
  test("move a stick that springs back, and are not the clock's", async () => {
    const page = await flying();
    const clock = vi.fn();
    addEventListener("keydown", clock);
    expect(press("ArrowRight").defaultPrevented).toBe(true);
    expect(clock).not.toHaveBeenCalled();
    removeEventListener("keydown", clock);
    expect(page.rolls()).toEqual([0.2]); // at once, in the very event
    vi.advanceTimersByTime(1000);
    const rolls = page.rolls();
    expect(rolls.at(-1)).toBe(1);
    expect(rolls).toEqual(rolls.toSorted((a, b) => a - b));
    press("ArrowRight", {}, "keyup");
    vi.advanceTimersByTime(500);
    const back = page.rolls();
    expect(back.at(-1)).toBe(0);
    vi.advanceTimersByTime(3000);
    expect(page.rolls()).toEqual([]);
  });

  test("one press banks five degrees, and nothing has to be held", async () => {
    const page = await flying();
    const { flight, hands } = page.session;
    press("6");
    expect(hands.value?.wanted.value).toBe(5);
    press("ArrowRight", { shiftKey: true });
    expect(hands.value?.wanted.value).toBe(10);
    expect(page.rolls()).toEqual([0.83]);
    const { pursuer } = pairAt(0);
    const banked = sample(1, { pursuer: { ...pursuer, bank_deg: 9.9 } });
    flight.heard.value = { tick: tick(1, [banked]), wall: 0 };
    vi.advanceTimersByTime(100);
    expect(page.rolls().at(-1)).toBe(0);
    press("5");
    expect(hands.value?.wanted.value).toBe(0);
    press("ArrowLeft"); // a hand on the stick takes over
    expect(hands.value?.wanted.value).toBeNull();
    vi.advanceTimersByTime(500);
    press("ArrowLeft", {}, "keyup");
    press("5"); // while it springs back
    vi.advanceTimersByTime(100);
    expect(hands.value?.wanted.value).toBe(0);
  });

  test("belong to a field, to a dialog, and to a clock that stands", async () => {
    const page = await flying();
    const field = document.createElement("input");
    document.body.append(field);
    const typed = new KeyboardEvent("keydown", { key: "5", bubbles: true, cancelable: true });
    field.dispatchEvent(typed);
    expect(typed.defaultPrevented).toBe(false);
    field.remove();
    page.session.flight.clock.value = { rate: 1, paused: true, ended: false };
    expect(press("ArrowRight").defaultPrevented).toBe(false);
    expect(page.rolls()).toEqual([]);
  });
});

test("the delay of the picture is measured from the key to the frame after the flight has the stick", async () => {
  const page = await flying();
  press("ArrowRight");
  press("ArrowRight", {}, "keyup");
  vi.advanceTimersByTime(40);
  const command = { kind: "stick", roll: 0.2, pitch: 0, ident: "" } as const;
  const given = { kind: "command_given", t_s: 1, command } as const;
  page.session.flight.heard.value = { tick: tick(1, [given]), wall: 0 };
  vi.advanceTimersByTime(1100);
  const { half, framesPerSecond } = page.session.hands.value?.measure.value ?? {};
  expect(half).toBeGreaterThanOrEqual(40 + FRAME);
  expect(half).toBeLessThan(40 + 2 * FRAME);
  expect(framesPerSecond).toBeGreaterThan(55);
});

test("a page that is drawn too seldom says so, and one that is not does not", async () => {
  const page = await flying();
  vi.advanceTimersByTime(5000);
  expect(page.session.hands.value?.isSlow.value).toBe(false);
  vi.stubGlobal("requestAnimationFrame", (draw: FrameRequestCallback) =>
    setTimeout(() => draw(performance.now()), 3 * FRAME),
  );
  vi.advanceTimersByTime(5000);
  expect(page.session.hands.value?.isSlow.value).toBe(true);
});

describe("neutral", () => {
  test.each([
    ["the window loses the focus", () => dispatchEvent(new Event("blur"))],
    [
      "the tab is hidden",
      () => {
        vi.spyOn(document, "hidden", "get").mockReturnValue(true);
        document.dispatchEvent(new Event("visibilitychange"));
      },
    ],
  ])("is sent when %s, whatever is held", async (_, leave) => {
    const page = await flying();
    press("ArrowLeft");
    page.session.hands.value?.drag({ roll: 0, pitch: 1 });
    vi.advanceTimersByTime(300);
    page.rolls();
    leave();
    vi.advanceTimersByTime(60);
    expect(page.rolls()).toEqual([0]);
    vi.advanceTimersByTime(1000);
    expect(page.rolls()).toEqual([]);
    vi.restoreAllMocks();
  });

  test("is sent when a controller goes", async () => {
    const page = await flying();
    const axes = [1, 0];
    const there = { id: "Pad", axes, connected: true };
    vi.stubGlobal("navigator", { getGamepads: () => [there] });
    vi.spyOn(document, "hasFocus").mockReturnValue(true);
    vi.advanceTimersByTime(100);
    expect(page.rolls().at(-1)).toBe(1);
    expect(page.session.hands.value?.controller.value).toBe("Pad");
    vi.stubGlobal("navigator", { getGamepads: () => [null] });
    vi.advanceTimersByTime(100);
    expect(page.rolls().at(-1)).toBe(0);
    expect(page.session.hands.value?.controller.value).toContain("press a button");
    vi.restoreAllMocks();
  });

  test("is the stick of a flight that is looked back on", async () => {
    const page = await flying();
    page.session.hands.value?.drag({ roll: 1, pitch: 0 });
    expect(page.rolls()).toEqual([1]);
    page.session.flight.source.value = { kind: "replay", rate: 1 };
    vi.advanceTimersByTime(100);
    expect(page.rolls().at(-1)).toBe(0);
  });
});

describe("the page tells a pilot why the stick is neutral, and how to go on", () => {
  interface Pad {
    id: string;
    axes: number[];
    connected: boolean;
  }

  /** A controller that can be unplugged, and a page that can be left. */
  function outside() {
    const pads: (Pad | null)[] = [{ id: "Pad (Vendor: 0)", axes: [0, 0], connected: true }];
    vi.stubGlobal("navigator", { getGamepads: () => pads });
    const hasFocus = vi.spyOn(document, "hasFocus").mockReturnValue(true);
    const hidden = vi.spyOn(document, "hidden", "get").mockReturnValue(false);
    const look = (away: boolean) => {
      hidden.mockReturnValue(away);
      hasFocus.mockReturnValue(!away);
      document.dispatchEvent(new Event("visibilitychange"));
      dispatchEvent(new Event(away ? "blur" : "focus"));
    };
    return { pads, look, hasFocus };
  }

  afterEach(() => vi.restoreAllMocks());

  test("an unplugged controller: neutral within a frame; back, it flies once it was let go", async () => {
    const page = await flying();
    const { pads } = outside();
    const place = document.body.appendChild(document.createElement("div"));
    await act(() => render(<StickPad session={page.session} actions={silentActions()} />, place));
    const told = () => place.querySelector("[role=alert]")?.textContent;
    const wait = (ms: number) => act(() => void vi.advanceTimersByTime(ms));
    await wait(100);
    expect(told()).toBe("");
    pads[0] = { id: "Pad (Vendor: 0)", axes: [0.9, 0], connected: true };
    await wait(100);
    expect(page.rolls().at(-1)).toBeGreaterThan(0.8);
    pads[0] = null;
    await wait(50);
    expect(page.rolls()).toEqual([0]);
    expect(told()).toBe("Pad is gone: stick neutral. You have control, by keys and by this panel.");
    expect(page.session.hands.value).not.toBeNull();
    pads[0] = { id: "Pad (Vendor: 0)", axes: [0.9, 0], connected: true };
    await wait(500);
    expect(page.rolls()).toEqual([]);
    expect(told()).toBe("Pad is back: let go of its stick once, then it flies.");
    pads[0] = { id: "Pad (Vendor: 0)", axes: [0.02, 0], connected: true };
    await wait(100);
    expect(told()).toBe("Pad flies again.");
    pads[0] = { id: "Pad (Vendor: 0)", axes: [-1, 0], connected: true };
    await wait(100);
    expect(page.rolls().at(-1)).toBe(-1);
    expect(told()).toBe("");
    await act(() => render(null, place));
    place.remove();
  });

  test("a page out of sight: neutral at once; in sight again, what is still held waits", async () => {
    const page = await flying();
    const { pads, look } = outside();
    pads[0] = { id: "Pad", axes: [0.9, 0], connected: true };
    vi.advanceTimersByTime(100);
    expect(page.rolls().at(-1)).toBeGreaterThan(0.8);
    const { hands } = page.session;
    look(true);
    vi.advanceTimersByTime(60);
    expect(page.rolls()).toEqual([0]);
    expect(hands.value?.notice.value).toBe(
      "Stick neutral: this page does not have the keys. Click here to fly on.",
    );
    vi.advanceTimersByTime(3000);
    expect(page.rolls()).toEqual([]);
    expect(hands.value?.controller.value).toBe("Pad");
    look(false);
    vi.advanceTimersByTime(100);
    expect(page.rolls()).toEqual([]);
    expect(hands.value?.notice.value).toBe("Pad is back: let go of its stick once, then it flies.");
    pads[0] = { id: "Pad", axes: [0, 0], connected: true };
    vi.advanceTimersByTime(100);
    pads[0] = { id: "Pad", axes: [0.9, 0], connected: true };
    vi.advanceTimersByTime(100);
    expect(page.rolls().at(-1)).toBeGreaterThan(0.8);
    look(true); // a page out of sight is given no frames
    look(false);
    vi.advanceTimersByTime(100);
    expect(page.rolls()).toEqual([0]);
    expect(hands.value?.notice.value).toContain("let go of its stick once");
  });

  test("without a controller: the stick was neutral meanwhile, and the next key clears the words", async () => {
    const page = await flying();
    const { pads, look } = outside();
    pads[0] = null;
    press("ArrowLeft");
    vi.advanceTimersByTime(300);
    look(true);
    vi.advanceTimersByTime(5000);
    look(false);
    const { hands } = page.session;
    vi.advanceTimersByTime(100);
    expect(hands.value?.notice.value).toBe(
      "The stick was neutral while you were away. You have control.",
    );
    page.rolls();
    press("ArrowRight");
    expect(page.rolls()).toEqual([0.2]);
    expect(hands.value?.notice.value).toBe("");
  });

  test("data too old to fly by: control is given back, so that what is said is so", async () => {
    const page = await flying();
    page.session.flight.connection.value = "lost";
    expect(page.sent.at(-1)).toEqual({ kind: "give_back" });
    expect(page.session.hands.value).toBeNull();
    page.answer(false, "The autopilot flies.");
    expect(page.session.feedback.value).toEqual({ kind: "done", text: "The autopilot flies." });
  });
});

describe("the pad", () => {
  test("follows one finger, and lets go when it is lifted or taken away", async () => {
    const page = await flying();
    const actions = silentActions();
    const place = document.createElement("div");
    document.body.append(place);
    await act(() => render(<StickPad session={page.session} actions={actions} />, place));
    const pad = place.querySelector("svg.stick-pad") as SVGElement;
    pad.setPointerCapture = vi.fn();
    pad.getBoundingClientRect = () => ({ left: 0, top: 0, width: 100, height: 100 }) as DOMRect;
    const touch = (type: string, pointerId: number, clientX: number, clientY: number) =>
      pad.dispatchEvent(new PointerEvent(type, { pointerId, clientX, clientY, bubbles: true }));
    const stick = () => page.session.hands.value?.stick.value;
    touch("pointerdown", 1, 90, 50);
    expect(stick()).toEqual({ roll: 1, pitch: 0 });
    touch("pointerdown", 2, 10, 50); // another finger is no stick
    touch("pointermove", 2, 10, 10);
    expect(stick()).toEqual({ roll: 1, pitch: 0 });
    touch("pointermove", 1, 50, 70);
    expect(stick()).toEqual({ roll: 0, pitch: 0.5 });
    touch("pointercancel", 1, 50, 70);
    expect(stick()).toEqual({ roll: 0, pitch: 0 });
    const [left, level, right, back] = place.querySelectorAll("button");
    right?.click();
    expect(page.session.hands.value?.wanted.value).toBe(5);
    left?.click();
    level?.click();
    expect(page.session.hands.value?.wanted.value).toBe(0);
    back?.click();
    expect(actions.setAutopilot).toHaveBeenCalledWith(true);
    await act(() => render(null, place));
    place.remove();
  });
});

import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { type Actions, createActions } from "../../src/atc/actions";
import { loudOf, SILENCE } from "../../src/atc/alerts";
import { Announcer, followChanges } from "../../src/atc/announcer";
import { ANSWERS } from "../../src/atc/answering";
import { isTaken, keyAct } from "../../src/atc/keys";
import { Page } from "../../src/atc/page";
import { sentenceOf } from "../../src/atc/pair-tool";
import { writeRecording } from "../../src/atc/recording";
import { choose, createStation, openTab, pick, type Station } from "../../src/atc/station";
import { requestsOf } from "../../src/atc/urgency";
import { behindText, flightText, timeText } from "../../src/atc/words";
import type { AtcDocument, ClearanceCard, ClearanceState } from "../../src/wire";
import { changed, clearance, NOW, pair, seen, traffic, validation } from "./fixture";

class FakeSocket {
  static opened: FakeSocket[] = [];
  onopen: (() => void) | null = null;
  onmessage: ((message: { data: string }) => void) | null = null;
  onclose: ((event: { code: number; reason: string }) => void) | null = null;
  close = vi.fn();
  constructor(readonly url: string) {
    FakeSocket.opened.push(this);
  }
}

let place: HTMLElement;
let station: Station;
let actions: Actions;
let number = 0;
/** What was asked of the service: method, path, body. */
let asked: [string, string, unknown][] = [];
/** What the service answers next. */
let answers: { status: number; body: unknown }[] = [];

beforeEach(() => {
  FakeSocket.opened = [];
  asked = [];
  answers = [];
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.stubGlobal(
    "ResizeObserver",
    class {
      observe() {}
      disconnect() {}
    },
  );
  vi.stubGlobal("fetch", async (path: string, init: RequestInit) => {
    asked.push([init.method ?? "", path, JSON.parse(String(init.body))]);
    const { status, body } = answers.shift() ?? { status: 200, body: {} };
    return new Response(JSON.stringify(body), { status });
  });
  station = createStation();
  const said = followChanges(station.store);
  actions = createActions(station, "ws://here/api/v1/atc/stream", "relguide-atc-1");
  place = document.createElement("div");
  document.body.append(place);
  act(() => {
    render(
      <>
        <Page station={station} actions={actions} />
        <Announcer said={said} />
      </>,
      place,
    );
    actions.follow();
    socket().onopen?.();
  });
});

afterEach(() => {
  render(null, place);
  place.remove();
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

function socket(): FakeSocket {
  const found = FakeSocket.opened.at(-1);
  if (found === undefined) throw new Error("no socket was opened");
  return found;
}

function tell(documents: AtcDocument[], snapshot = false): void {
  number += documents.length;
  const frame = { kind: "atc", number, snapshot, documents };
  act(() => socket().onmessage?.({ data: JSON.stringify(frame) }));
}

async function press(...keys: string[]): Promise<void> {
  for (const key of keys)
    await act(async () => {
      const event = new KeyboardEvent("keydown", { key, bubbles: true });
      (document.activeElement ?? document.body).dispatchEvent(event);
      if (!isTaken(event)) keyAct(event, station)?.(station);
      await new Promise((done) => setTimeout(done, 0));
    });
}

function rows(): string[] {
  return [...place.querySelectorAll("[role=option]")].map((each) => each.textContent ?? "");
}

function text(selector: string): string {
  return place.querySelector(selector)?.textContent ?? "";
}

const FIVE = ["1", "2", "3", "4", "5"].map((id, k) => clearance(id, { due_s: NOW + 20 + 10 * k }));

describe("a controller with a keyboard", () => {
  it("works a stream of five requests", async () => {
    tell([seen([traffic("DLH1"), traffic("AFR1", { x_m: 9000 })]), ...FIVE.map((c) => changed(c))]);
    expect(rows().map((row) => /DLH\d/.exec(row)?.[0])).toEqual(FIVE.map((c) => c.aircraft));
    const confirm = (state: ClearanceState) => {
      const [, path] = asked.at(-1) ?? ["", ""];
      const card = FIVE.find(({ id }) => path.includes(`/${id}/`));
      const due_s = state === "standby" ? NOW + 120 : card?.due_s;
      if (card !== undefined) tell([changed({ ...card, state, due_s: due_s ?? 0 })]);
    };
    await press("n", "a");
    confirm("accepted");
    await press("n", "u", "2");
    confirm("unable");
    await press("n", "s");
    confirm("standby");
    await press("n", "a");
    confirm("accepted");
    await press("n", "u", "1");
    confirm("unable");
    expect(asked).toEqual([
      ["POST", "api/v1/clearances/1/answers", { answer: "accepted" }],
      ["POST", "api/v1/clearances/2/answers", { answer: "unable", reason: "airspace" }],
      ["POST", "api/v1/clearances/3/answers", { answer: "standby" }],
      ["POST", "api/v1/clearances/4/answers", { answer: "accepted" }],
      ["POST", "api/v1/clearances/5/answers", { answer: "unable", reason: "separation" }],
    ]);
    expect(station.sent.value).toBeNull();
  });

  it("goes to the sky in which a request waits, where none does here", async () => {
    tell([
      seen([traffic("DLH1")]),
      seen([traffic("AFR9")], NOW, "far"),
      changed(clearance("9", { sky: "far" })),
    ]);
    expect(text("[role=tab][aria-selected=true]")).not.toContain("far");
    await press("n", "s");
    expect(text("[role=tab][aria-selected=true]")).toContain("Flight far");
    expect(asked).toEqual([["POST", "api/v1/clearances/9/answers", { answer: "standby" }]]);
  });

  it("chooses by arrows, and leaves with Escape", async () => {
    tell(FIVE.map((c) => changed(c)));
    await press("ArrowDown", "ArrowDown", "ArrowUp", "ArrowDown");
    expect(text("[role=option][aria-selected=true]")).toContain("DLH2");
    expect(text(".atc-strip .text")).toContain("BEHIND AFR2");
    await press("u");
    expect(place.querySelector(".atc-reasons")?.contains(document.activeElement)).toBe(true);
    await press("Escape");
    expect(place.querySelector(".atc-reasons")).toBeNull();
    await press("Escape");
    expect(place.querySelector("[role=option][aria-selected=true]")).toBeNull();
  });

  it("is told why the service refuses, and why a state does not allow it", async () => {
    tell([changed(clearance("1"))]);
    answers = [{ status: 409, body: { detail: "This clearance is over: it is expired." } }];
    await press("ArrowDown", "a");
    expect(text(".refused")).toBe("This clearance is over: it is expired.");
    tell([changed(clearance("1", { state: "flying" }))]);
    await press("s");
    expect(text(".refused")).toContain("A clearance that is flying cannot be told to stand by");
    expect(asked).toHaveLength(1);
  });

  it("who has no right to answer reads why at the buttons", async () => {
    tell([changed(clearance("1"))]);
    const detail = "This needs a token of atc or control, not one of view.";
    answers = [{ status: 403, body: { detail } }];
    await press("ArrowDown", "a");
    const accept = [...place.querySelectorAll("button")].find((b) => b.textContent === "AAccept");
    expect(accept?.disabled).toBe(true);
    expect(text(".atc-strip .hint")).toBe(detail);
    expect(text(".refused")).toBe("");
    // another clearance may be one's own
    tell([changed(clearance("2"))]);
    await press("ArrowDown", "a");
    expect(asked).toHaveLength(2);
  });

  it("tries a flight's clearance again, and nothing is kept", async () => {
    tell([changed(clearance("1", { flight_id: "f1" }))]);
    const found = validation({ verdict: "unable", pairs: [pair("RYR1", { least_m: 5556 })] });
    answers = [{ status: 200, body: { text: "", joins_s: 1, validation: found } }];
    await press("ArrowDown", "p");
    const body = { flight_id: "f1", aircraft: "DLH1" };
    expect(asked).toEqual([["POST", "api/v1/clearances?dry_run=true", body]]);
    expect(text(".tried")).toContain("3.0 NM of RYR1");
  });

  it("cannot answer in the past, and Live leads back", async () => {
    tell([changed(clearance("1")), seen([], NOW + 60)]);
    act(() => {
      station.store.instant.value = NOW + 10;
    });
    await press("ArrowDown", "a");
    expect(text(".refused")).toContain("The page shows the past");
    // the slider keeps its arrows, and leaves letters to the page
    place.querySelector<HTMLElement>("input[type=range]")?.focus();
    await press("ArrowUp");
    expect(station.selected.value).toBe("1");
    await press("l");
    expect(station.store.instant.value).toBeNull();
    expect(asked).toEqual([]);
  });

  it("offers an alternative in words", async () => {
    const other = {
      change: "later" as const,
      message: "Beginning 60 s later keeps 6.0 NM.",
      begins_s: 60,
      word: "LSR",
      spacing_m: 9260,
      joins_s: NOW + 700,
      least_m: 11_112,
      route: clearance("1").route,
    };
    const found = validation({ verdict: "unable", alternatives: [other] });
    tell([changed(clearance("1", { validation: [found] }))]);
    await press("ArrowDown");
    const [show, offer] = place.querySelectorAll<HTMLButtonElement>(".alternatives button");
    act(() => show?.click());
    expect(place.querySelector(".atc-routes .alternative")).not.toBeNull();
    await act(async () => offer?.click());
    const [[, , body] = []] = asked;
    expect(body).toEqual({
      answer: "unable",
      reason: "controller",
      message: "EXPECT IN 60 S BEHIND AFR1 5.0 NM VIA LSR JOIN 14:25:00",
    });
  });
});

describe("the demonstration", () => {
  async function begun(): Promise<void> {
    const demo = [...place.querySelectorAll("button")].find((b) => b.textContent?.includes("Demo"));
    await act(async () => demo?.click());
    await vi.waitFor(() => expect(station.busy.value).toBe(""));
  }
  const openTabs = () => text("[role=tab][aria-selected=true]");
  const TWO = [seen([traffic("DLH1")]), seen([traffic("AFR9")], NOW, "far")];

  it("opens all traffic, where its five flights ask, from whichever tab it was begun", async () => {
    tell(TWO);
    act(() => openTab(station, "far"));
    await begun();
    expect(asked.map(([, path]) => path)).toEqual(
      Array(5).fill(["api/v1/flights", "api/v1/clearances"]).flat(),
    );
    expect(openTabs()).toBe("Earth");
    expect(text(".atc-notice")).toBe("");
  });

  it("leaves a recording open, and says where its flights are", async () => {
    const written = writeRecording([...TWO, changed(clearance("9", { sky: "far" }))]);
    await act(() => actions.openFile(new File([written], "morning.jsonl")));
    act(() => openTab(station, "far"));
    await begun();
    expect(station.file.value).toBe("morning.jsonl");
    expect(openTabs()).toContain("Flight far");
    expect(text(".atc-notice")).toBe(
      "Five flights ask. Load this page again to leave the recording and see them.",
    );
  });

  it("that cannot begin says why, and changes no tab", async () => {
    tell(TWO);
    act(() => openTab(station, "far"));
    answers = [{ status: 503, body: { detail: "No more flights fit." } }];
    await begun();
    expect(openTabs()).toContain("Flight far");
    expect(text(".atc-notice")).toContain("No more flights fit.");
    expect(asked).toHaveLength(1);
  });
});

describe("the stream", () => {
  it("goes on after the last document it had", () => {
    vi.useFakeTimers();
    tell([seen([])]);
    const last = number;
    act(() => {
      socket().onclose?.({ code: 1006, reason: "" });
      vi.advanceTimersByTime(600);
    });
    expect(socket().url).toBe(`ws://here/api/v1/atc/stream?from=${last + 1}`);
  });

  it("takes a snapshot for all that stands, and keeps the past", () => {
    tell([seen([]), changed(clearance("1"))]);
    tell([seen([], NOW + 5), changed(clearance("2"), NOW + 5)], true);
    expect(rows()).toHaveLength(2);
    expect(rows()[0]).toContain("DLH2");
    expect(rows()[1]).toContain("EXPIRED");
    expect(station.store.span.value).toEqual([NOW, NOW + 5]);
  });

  it("says why it was closed for good", () => {
    act(() => socket().onclose?.({ code: 4400, reason: "This server speaks another language." }));
    expect(text(".atc-notice")).toBe("This server speaks another language.");
  });
});

describe("alerts", () => {
  const deviating = (level: "caution" | "alert") =>
    changed(
      clearance("1", {
        state: "flying",
        deviations: [
          {
            subject: "across",
            level,
            amount: 2222.4,
            unit: "m",
            since_s: NOW,
            message: "DLH1 is 1.2 NM beside its path.",
          },
        ],
      }),
    );

  it("stand in the banner until they are silenced, for a minute", async () => {
    tell([deviating("alert")]);
    expect(text(".atc-banner")).toContain("1.2 NM beside its path");
    await press("x");
    expect(place.querySelector(".atc-banner")).toBeNull();
    expect(text(".atc-alerts")).toContain("across 1.20 NM");
    const { alerts, silenced, wall } = station;
    expect(loudOf(alerts.value, silenced.value, wall.value + SILENCE - 1)).toHaveLength(0);
    expect(loudOf(alerts.value, silenced.value, wall.value + SILENCE)).toHaveLength(1);
  });

  it("are no banner while they are cautions", () => {
    tell([deviating("caution")]);
    expect(place.querySelector(".atc-banner")).toBeNull();
    expect(text(".atc-alerts")).toContain("CAUTION");
  });
});

describe("what is said to those who listen", () => {
  it("is each new request and each change once", () => {
    const said = () => text(".visually-hidden[aria-live=polite]");
    tell([changed(clearance("1"))], true);
    expect(said()).toBe("");
    tell([changed(clearance("2"))]);
    expect(said()).toBe("Request: DLH2 behind afr2 5.0 nm, acceptable.");
    tell([changed(clearance("2", { state: "accepted" }))]);
    expect(said()).toBe("DLH2: accepted.");
    tell([changed(clearance("2", { state: "accepted" }), NOW + 9)]);
    expect(said()).toBe("DLH2: accepted.");
  });
});

describe("words", () => {
  it("have units", () => {
    expect(behindText(clearance("1"))).toBe("BEHIND AFR1 5.0 NM");
    const timed: Partial<ClearanceCard> = { spacing_type: "time", spacing_time_s: 90 };
    expect(behindText(clearance("1", timed))).toBe("BEHIND AFR1 90 s");
    expect(flightText(traffic("A", { climb_mps: 8 }))).toBe("FL310↑ 447 kt");
    expect(timeText("", NOW)).toBe("14:13:20");
    expect(timeText("abc", 75)).toBe("01:15");
  });

  it("of the pair tool say range, bearing, height and closest approach", () => {
    const above = traffic("B", { x_m: 18_520, track_deg: 270, altitude_m: 9449 + 304.8 });
    tell([seen([traffic("A"), above])]);
    pick(station, "A");
    pick(station, "B");
    expect(sentenceOf(station)).toBe(
      "10.0 NM, bearing 090°, 1000 ft between them. Straight on: 0.0 NM in 00:40.",
    );
  });
});

describe("the request list", () => {
  it("has what deviates first, then what waits, then what others act on, then what is over", () => {
    const states: ClearanceState[] = ["flown", "flying", "accepted", "standby", "deviated"];
    tell(states.map((state, k) => changed(clearance(String(k), { state }))));
    const order = requestsOf(station.store.sky.value, true).map(({ state }) => state);
    expect(order).toEqual(["deviated", "standby", "accepted", "flying", "flown"]);
  });

  it("keeps what is over for a minute, and with a tick for good", () => {
    const [left] = [clearance("1", { history: [] })];
    tell([seen([]), changed(left)]);
    tell([{ kind: "expired", t_s: NOW + 300, id: "1", message: "Nobody answered in time." }]);
    expect(rows()[0]).toContain("EXPIRED");
    tell([seen([], NOW + 359)]);
    expect(rows()).toHaveLength(1);
    tell([seen([], NOW + 361)]);
    expect(rows()).toHaveLength(0);
    expect(text(".atc-requests .hint")).toBe(
      "Nothing is asked for now. 1 ended: tick “show ended” to see it.",
    );
    act(() => place.querySelector<HTMLInputElement>(".atc-requests input")?.click());
    expect(rows()[0]).toContain("EXPIRED");
    act(() => choose(station, "1"));
    expect(text(".atc-strip .history")).toContain("Nobody answered in time.");
  });

  it("offers nothing for what is over", () => {
    const over: ClearanceState[] = ["unable", "flown", "cancelled", "expired", "terminated"];
    for (const state of over) expect(ANSWERS[state]).toEqual([]);
  });
});

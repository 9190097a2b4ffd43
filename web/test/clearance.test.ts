/** The pilot's side of a clearance: what is sent to the controller, and what is shown and said of the answer. */

import { afterEach, describe, expect, test, vi } from "vitest";
import { tellControl } from "../src/clearance";
import { createSession } from "../src/session";
import { announcementsOf } from "../src/store/announcements";
import { noticesOf } from "../src/store/notices";
import { pictureOf } from "../src/store/picture";
import { messageOf } from "../src/store/reduce";
import type { ClearanceNews } from "../src/wire";
import { flightIn } from "./nd/in-state";
import { amend, OWN } from "./samples";

afterEach(() => vi.unstubAllGlobals());

function news(changes: Partial<ClearanceNews> = {}): ClearanceNews {
  return {
    kind: "clearance_news",
    t_s: 0,
    ident: OWN,
    clearance_id: "c1",
    clearance: "validated",
    level: "none",
    message: "CLEARED CAPTURE 5.0 NM BEHIND LDR.",
    automated: false,
    ...changes,
  };
}

function armed(clearance: ClearanceNews | null) {
  const flight = flightIn("armed");
  amend(flight, { clearance });
  const session = createSession(flight);
  session.status.value = { id: "f 1" } as typeof session.status.value;
  const asked = vi.fn<typeof fetch>(async () => new Response("{}", { status: 201 }));
  vi.stubGlobal("fetch", asked);
  return { session, asked, moment: () => flight.moment.value };
}

describe("what the crew does is told to the controller", () => {
  test.each([
    ["armed", null, "api/v1/clearances", { flight_id: "f 1" }],
    ["engaged", news(), "api/v1/clearances/c1/replies", { reply: "WILCO" }],
    ["off", news(), "api/v1/clearances/c1/replies", { reply: "CANCEL" }],
    ["off", news({ clearance: "flying" }), "api/v1/clearances/c1/replies", { reply: "CANCEL" }],
  ] as const)("%s", async (engagement, clearance, path, body) => {
    const { session, asked } = armed(clearance);
    await tellControl(session, engagement, vi.fn());
    expect(asked.mock.calls.map(([url]) => url)).toEqual([path]);
    expect(JSON.parse(asked.mock.calls[0]?.[1]?.body as string)).toEqual(body);
  });

  test.each([
    ["engaged", null],
    ["engaged", news({ clearance: "standby" })],
    ["off", news({ clearance: "over" })],
    ["off", null],
    ["designated", news()],
  ] as const)("%s, and nothing is to be told", async (engagement, clearance) => {
    const { session, asked } = armed(clearance);
    await tellControl(session, engagement, vi.fn());
    expect(asked).not.toHaveBeenCalled();
  });

  test("a refusal is said", async () => {
    const { session, asked } = armed(null);
    asked.mockResolvedValue(new Response(JSON.stringify({ detail: "No." }), { status: 409 }));
    const say = vi.fn();
    await tellControl(session, "armed", say);
    expect(say).toHaveBeenCalledWith("refused", "ATC: No.");
  });
});

describe("what the controller answers", () => {
  test.each([
    [news({ clearance: "sent" }), "SENT"],
    [news({ clearance: "standby" }), "STANDBY"],
    [news(), "VALIDATED"],
    [news({ automated: true }), "VALIDATED AUTO"],
    [news({ clearance: "unable", reason: "separation" }), "UNABLE TRAFFIC"],
    [news({ clearance: "unable", reason: "stale_picture", automated: true }), "UNABLE DATA"],
    [news({ clearance: "unable", reason: "controller" }), "UNABLE"],
    [null, "ACCEPTED"],
  ] as const)("is under the modes: %#", (clearance, text) => {
    expect(pictureOf(armed(clearance).moment()).order).toBe(text);
  });

  test("is a line of the log, and spoken; what is wrong at once", () => {
    expect(messageOf(news())).toEqual({ t: 0, kind: "clearance", text: news().message });
    const { moment } = armed(news());
    expect(announcementsOf(moment()).polite).toContain(news().message);
    const off = armed(news({ clearance: "deviating", level: "caution", message: "Off the path." }));
    expect(announcementsOf(off.moment()).assertive).toContain("Off the path.");
    expect(announcementsOf(off.moment()).polite).not.toContain("Off the path.");
    expect(noticesOf(off.moment())).toContainEqual({ level: "caution", text: "ATC DEVIATING" });
  });
});

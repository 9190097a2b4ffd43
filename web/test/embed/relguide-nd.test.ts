import "../../src/embed/relguide-nd";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { modeChanged, planChanged, STARTED, sample, tick } from "../samples";

const DOCUMENTS = [
  STARTED,
  modeChanged(0),
  planChanged(0),
  ...Array.from({ length: 60 }, (_, t) => sample(t)),
];

let nd: HTMLElementTagNameMap["relguide-nd"];
beforeEach(() => {
  nd = document.createElement("relguide-nd");
  act(() => document.body.append(nd));
});
afterEach(() => nd.remove());

function find(selector: string): Element | null | undefined {
  return nd.shadowRoot?.querySelector(selector);
}

function show(change: () => void): void {
  act(change);
}

function details(name: string): unknown[] {
  const seen: unknown[] = [];
  nd.addEventListener(name, (event) => seen.push((event as CustomEvent).detail));
  return seen;
}

test("is drawn in a shadow tree of its own", () => {
  show(() => {
    nd.documents = DOCUMENTS;
  });
  expect(find('[role="img"]')?.getAttribute("aria-label")).toMatch(/^Navigation display, ARC/);
  expect(document.querySelector(".nd-ownship")).toBeNull();
  expect(find("style")?.textContent).toContain("--plan:#00ff00;");
});

test("shows the instant that is set, before or after the documents, and says so", () => {
  const seen = details("timechange");
  nd.t = 20;
  show(() => {
    nd.documents = DOCUMENTS.map((each) => JSON.stringify(each)).join("\n");
  });
  expect(nd.t).toBe(20);
  show(() => {
    nd.t = 1e6;
  });
  expect(nd.t).toBe(59);
  expect(seen.at(-1)).toEqual({ t: 59 });
  expect(nd.documents).toHaveLength(DOCUMENTS.length);
});

test("mode and range are properties and attributes", () => {
  show(() => {
    nd.documents = DOCUMENTS;
    nd.setAttribute("mode", "ROSE");
    nd.setAttribute("range", "80");
    nd.setAttribute("t", "30");
  });
  expect([nd.mode, nd.range, nd.t]).toEqual(["ROSE", 80, 30]);
  expect(find('[role="img"]')?.getAttribute("aria-label")).toContain("ROSE, range 80 ");
  show(() => {
    nd.removeAttribute("range");
  });
  expect(nd.range).toBe("auto");
  expect(find('[role="img"]')?.getAttribute("aria-label")).not.toContain("range 80 ");
});

test("a live flight is shown as it flies, until documents are given", () => {
  const sockets: FakeSocket[] = [];
  class FakeSocket {
    onmessage: ((message: { data: string }) => void) | null = null;
    onopen: (() => void) | null = null;
    isClosed = false;
    constructor(
      readonly url: string,
      readonly protocol: string,
    ) {
      sockets.push(this);
    }
    close() {
      this.isClosed = true;
    }
  }
  vi.stubGlobal("WebSocket", FakeSocket);
  const seen = details("timechange");
  nd.live("/api/v1/flights/one/stream");
  const [socket] = sockets;
  expect(socket?.url).toMatch(/^ws:.*\/api\/v1\/flights\/one\/stream$/);
  expect(socket?.protocol).toBe("relguide-stream-2");
  show(() => {
    socket?.onopen?.();
    socket?.onmessage?.({ data: JSON.stringify(tick(0, DOCUMENTS.slice(0, 4))) });
    socket?.onmessage?.({ data: JSON.stringify(tick(40, [sample(40)])) });
  });
  expect(nd.t).toBeGreaterThanOrEqual(40);
  expect(seen.length).toBeGreaterThan(0);
  expect(find(".nd-ownship")).not.toBeNull();
  show(() => {
    nd.documents = DOCUMENTS;
  });
  expect(socket?.isClosed).toBe(true);
  expect(nd.t).toBe(0);
  vi.unstubAllGlobals();
});

test("what is no view is refused in a sentence", () => {
  expect(() => {
    nd.mode = "PLAN" as "ARC";
  }).toThrow("mode must be ARC or ROSE, not PLAN.");
  expect(() => {
    nd.range = 50 as 40;
  }).toThrow("range must be auto or one of 10, 20, 40, 80, 160, 320 NM, not 50.");
  expect(() => {
    nd.t = Number.NaN;
  }).toThrow("t must be a flight time in seconds, not NaN.");
});

test("a click on the leader selects it", () => {
  const seen = details("select");
  show(() => {
    nd.documents = DOCUMENTS;
    nd.range = 40;
  });
  find(".nd-leader")?.dispatchEvent(new MouseEvent("click", { bubbles: true, composed: true }));
  expect(seen).toEqual([{ ident: "AF123" }]);
});

test("its groups are parts", () => {
  show(() => {
    nd.documents = DOCUMENTS;
  });
  for (const part of ["display", "leader", "ownship", "tape"])
    expect(find(`[part~="${part}"]`), part).not.toBeNull();
});

test("knows its version, and can be taken away and put back", () => {
  expect((nd.constructor as unknown as { version: string }).version).toMatch(/^\d+\.\d+\.\d+$/);
  show(() => {
    nd.documents = DOCUMENTS;
    nd.t = 10;
  });
  show(() => nd.remove());
  show(() => document.body.append(nd));
  expect(nd.t).toBe(10);
  expect(find(".nd-ownship")).not.toBeNull();
});

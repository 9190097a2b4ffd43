import { afterEach, expect, test, vi } from "vitest";
import { createFlight, type Readiness, readReadiness } from "../src/api";
import { firstStartText, followFirstStart } from "../src/first-start";

const preparing: Readiness = {
  status: "preparing",
  warm: { flying: true, limited: false },
  preparing: { name: "the limited search", share: 0.4 },
};
const ready: Readiness = { status: "ready", warm: { flying: true }, preparing: null };

afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

function answers(...given: readonly [number, unknown, HeadersInit?][]): void {
  const queue = [...given];
  const fetch = vi.fn(async () => {
    const [status, body, headers] = queue.shift() ?? [500, null];
    return new Response(JSON.stringify(body), headers ? { status, headers } : { status });
  });
  vi.stubGlobal("fetch", fetch);
}

test("a first start says what it prepares and how far it is", () => {
  expect(firstStartText(preparing)).toBe("First start: preparing the limited search, 40 %");
  expect(firstStartText(ready)).toBe("");
  expect(firstStartText(null)).toBe("");
});

test("the server is asked until all is prepared, and no more", async () => {
  vi.useFakeTimers();
  answers([503, preparing], [200, { ...ready, preparing: preparing.preparing }], [200, ready]);
  const readiness = followFirstStart();
  await vi.advanceTimersByTimeAsync(500);
  expect(readiness.value).toEqual(preparing);
  await vi.advanceTimersByTimeAsync(1_000);
  expect(readiness.value?.status).toBe("ready");
  await vi.advanceTimersByTimeAsync(10_000);
  expect(readiness.value).toBeNull();
  expect(fetch).toHaveBeenCalledTimes(3);
});

test("a server that is not there prepares nothing", async () => {
  vi.stubGlobal(
    "fetch",
    vi.fn(async () => Promise.reject(new TypeError("refused"))),
  );
  expect(await readReadiness()).toBeNull();
});

test("a flight that must wait says for how long", async () => {
  answers([503, { detail: "First start." }, { "retry-after": "7" }]);
  expect(await createFlight({ scenario: "fig_6b", rate: 10 })).toEqual({
    kind: "refused",
    status: 503,
    sentence: "First start.",
    retryAfter: 7,
  });
});

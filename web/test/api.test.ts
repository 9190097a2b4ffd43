import { afterEach, describe, expect, test, vi } from "vitest";
import { commandFlight, createFlight, listScenarios, sentenceOf } from "../src/api";

function answer(status: number, body: string): void {
  vi.stubGlobal(
    "fetch",
    vi.fn(async () => new Response(body, { status })),
  );
}

afterEach(() => vi.unstubAllGlobals());

describe("the service's answers", () => {
  test("what was asked for comes back as a value", async () => {
    answer(201, JSON.stringify({ id: "one" }));
    expect(await createFlight({ scenario: "fig_6b", rate: 10 })).toEqual({
      kind: "done",
      value: { id: "one" },
    });
    expect(fetch).toHaveBeenCalledWith(
      "api/v1/flights",
      expect.objectContaining({ method: "POST", body: '{"scenario":"fig_6b","rate":10}' }),
    );
  });

  test("a problem document becomes its sentence", async () => {
    const detail = "tas_mps: a true airspeed is between 30 and 400 m/s.";
    answer(422, JSON.stringify({ title: "Unprocessable Content", status: 422, detail }));
    const refused = await commandFlight("a b", { command: "leader_speed", tas_mps: 1000 });
    expect(refused).toEqual({ kind: "refused", status: 422, sentence: detail });
    expect(fetch).toHaveBeenCalledWith("api/v1/flights/a%20b/commands", expect.anything());
  });

  test("no answer, and an answer that is no JSON, are refusals too", async () => {
    vi.stubGlobal(
      "fetch",
      vi.fn(async () => Promise.reject(new TypeError("refused"))),
    );
    expect(await listScenarios()).toMatchObject({ kind: "refused", status: 0 });
    answer(502, "<html>");
    expect(await listScenarios()).toMatchObject({ kind: "refused", status: 502 });
  });

  test("a problem without detail says its title, one without both its status", () => {
    expect(sentenceOf({ title: "Not Found" }, 404)).toBe("Not Found");
    expect(sentenceOf(null, 500)).toContain("500");
  });
});

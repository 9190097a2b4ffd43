import { afterEach, expect, test, vi } from "vitest";
import { createActions } from "../src/actions";
import { createSession } from "../src/session";
import { createFlightStore } from "../src/store/flight";
import { pairCard } from "../src/store/pair";
import { pairAt, STARTED } from "./samples";

afterEach(() => vi.unstubAllGlobals());

function flying(answer: Response) {
  const asked = vi.fn<typeof fetch>(async () => answer);
  vi.stubGlobal("fetch", asked);
  const store = createFlightStore();
  const session = createSession(store.flight);
  session.status.value = {
    id: "one",
    scenario: "fig_6b",
    title: "Fig. 6b",
    t_s: 0,
    rate: 1,
    paused: false,
    ended: false,
    mode: "converge",
    engagement: "engaged",
    joined: false,
    separation_m: 20000,
    stream_url: "",
    scene_url: "",
    seed: 0,
    version: "1.0.0",
  };
  return { asked, session, actions: createActions(session, store) };
}

function problem(status: number, detail: string): Response {
  return new Response(JSON.stringify({ detail }), { status });
}

test("a heading beyond a full turn is flown as what it means, and the page says so", async () => {
  const { asked, session, actions } = flying(new Response("", { status: 204 }));
  actions.leaderHeading(400, "right");
  await vi.waitFor(() => expect(session.feedback.value.kind).toBe("done"));
  expect(session.feedback.value).toMatchObject({
    text: "Leader to heading 040 (400° is 040°) by the right.",
  });
  expect(JSON.parse(asked.mock.calls[0]?.[1]?.body as string)).toMatchObject({ heading_deg: 40 });
});

test("a click on a leader that is designated already takes nothing back", () => {
  const { asked, session, actions } = flying(problem(500, ""));
  const store = session.flight;
  store.started.value = pairCard(STARTED);
  store.sample.value = pairAt(0);
  actions.engage("designated");
  expect(asked).not.toHaveBeenCalled();
  store.sample.value = pairAt(0, { engagement: "off" });
  actions.engage("designated");
  expect(asked).toHaveBeenCalledOnce();
});

test("a refused speed is refused in knots", async () => {
  const sentence = "tas_mps: must lie in 30 … 400 m/s, not 513.936 m/s.";
  const { session, actions } = flying(problem(422, sentence));
  actions.leaderSpeed(513.936);
  await vi.waitFor(() => expect(session.feedback.value.kind).toBe("refused"));
  expect(session.feedback.value).toMatchObject({
    text: "The true airspeed must lie in 58 … 778 kt, not 999 kt.",
  });
});

test("what an ended flight answers is shown as it is", async () => {
  const sentence = "This flight has ended and takes no commands: start another one.";
  const { session, actions } = flying(problem(409, sentence));
  actions.leaderHeading(200);
  await vi.waitFor(() => expect(session.feedback.value.kind).toBe("refused"));
  expect(session.feedback.value).toMatchObject({ text: sentence });
});

import { afterEach, expect, test, vi } from "vitest";
import { createActions } from "../src/actions";
import { createSession } from "../src/session";
import { createFlightStore } from "../src/store/flight";
import { pairCard } from "../src/store/pair";
import { amend, noPlan, pairAt, STARTED } from "./samples";

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
    outcome: "",
    started_at: "2026-11-23T06:30:00.000Z",
    mode: "converge",
    engagement: "engaged",
    joined: false,
    separation_m: 20000,
    stream_url: "",
    scene_url: "",
    seed: 0,
    version: "1.0.0",
    recorded: true,
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
  const sample = pairAt(0);
  amend(session.flight, { started: pairCard(STARTED), sample, now: sample });
  actions.engage("designated");
  expect(asked).not.toHaveBeenCalled();
  amend(session.flight, { sample: pairAt(0, { engagement: "off" }) });
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

test("what is refused when its second comes is refused, whatever was said when it was taken", async () => {
  const { session, actions } = flying(new Response("", { status: 204 }));
  actions.engage("armed");
  await vi.waitFor(() => expect(session.feedback.value.kind).toBe("done"));
  const message = "There is no proposal to accept.";
  amend(session.flight, {
    engagement: {
      kind: "engagement_changed",
      t_s: 1,
      ident: "RG456",
      engagement: "designated",
      previous: "designated",
      message,
    },
  });
  expect(session.feedback.value).toEqual({ kind: "refused", text: message });
});

test("without a path nothing is accepted, and the page says why", () => {
  const { asked, session, actions } = flying(new Response("", { status: 204 }));
  amend(session.flight, { started: pairCard(STARTED) });
  const now = pairAt(0, { engagement: "designated", mode: "heading" });
  amend(session.flight, { sample: now, now: now });
  amend(session.flight, { unavailable: noPlan(0) });
  for (const step of ["armed", "engaged"] as const) {
    actions.engage(step);
    expect(session.feedback.value).toMatchObject({
      kind: "refused",
      text: "There is no path to accept now: it is looked for again by itself.",
    });
  }
  expect(asked).not.toHaveBeenCalled();
});

test("who commands a flight that is no more reads what to do, and not what the service has for programs", async () => {
  const { session, actions } = flying(
    problem(404, "There is no flight 'one': GET /api/v1/flights"),
  );
  actions.leaderHeading(200);
  await vi.waitFor(() => expect(session.feedback.value.kind).toBe("refused"));
  expect(session.feedback.value).toMatchObject({ text: "This flight is over: start a new one." });
});

test("what stands at its beginning goes on for an acceptance, and stands again once it is taken", async () => {
  const { asked, session, actions } = flying(new Response(null, { status: 204 }));
  asked.mockImplementation(async () => new Response(null, { status: 204 }));
  const commands = () =>
    asked.mock.calls
      .filter(([url]) => String(url).endsWith("/commands"))
      .map(([, init]) => JSON.parse(init?.body as string).command);
  amend(session.flight, { t: 0 });
  session.flight.clock.value = { rate: 1, paused: true, ended: false };
  actions.engage("armed");
  await vi.waitFor(() => expect(commands()).toEqual(["set_engagement", "play"]));
  const taken = { kind: "engagement_changed", t_s: 1, ident: "RG456", message: "" } as const;
  amend(session.flight, {
    engagement: { ...taken, engagement: "armed", previous: "designated" },
  });
  await vi.waitFor(() => expect(commands()).toEqual(["set_engagement", "play", "pause"]));
  // what is accepted is sent to the controller
  await vi.waitFor(() =>
    expect(asked.mock.calls.map(([url]) => url)).toContain("api/v1/clearances"),
  );
  // the pause may not have been heard of yet
  session.flight.clock.value = { rate: 1, paused: false, ended: false };
  actions.engage("engaged");
  await vi.waitFor(() => expect(commands().slice(3)).toEqual(["set_engagement", "play"]));
  actions.engage("off");
  await vi.waitFor(() => expect(commands().slice(5)).toEqual(["set_engagement"]));
});

test("a comparison that is refused leaves a recording on show, and its address", async () => {
  const replaced = vi.fn();
  vi.stubGlobal("location", { href: "http://here/?flight=three&compare=nonsense,other" });
  vi.stubGlobal("history", { state: null, replaceState: replaced });
  const { asked, session, actions } = flying(new Response("", { status: 204 }));
  session.status.value = null;
  session.recording.value = { id: "three", title: "Fig. 6a", from: "record" };
  actions.compare("nonsense", "other");
  await vi.waitFor(() => expect(session.feedback.value.kind).toBe("refused"));
  expect(asked).not.toHaveBeenCalled();
  expect(String(replaced.mock.lastCall?.[2])).toBe("http://here/?flight=three");
});

test("an address with an empty flight begins one", async () => {
  const { asked, actions } = flying(problem(422, "There is no scenario 'x'."));
  await actions.open(new URLSearchParams("flight=&scenario=x"));
  expect(asked.mock.calls.map(([path, init]) => [path, init?.method])).toContainEqual([
    "api/v1/flights",
    "POST",
  ]);
});

test("an answer to an earlier address comes too late, and what was said of that is gone", async () => {
  const { session, actions } = flying(problem(404, "There is no flight 'one'."));
  session.status.value = null;
  session.feedback.value = { kind: "done", text: "Both are shown." };
  const first = actions.open(new URLSearchParams("flight=one"));
  void actions.open(new URLSearchParams("flight=two"));
  await first;
  expect(session.feedback.value.kind).toBe("none");
});

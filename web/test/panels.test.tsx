import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, describe, expect, test, vi } from "vitest";
import { Aircraft } from "../src/panels/aircraft";
import { Alternatives } from "../src/panels/alternatives";
import { Captions } from "../src/panels/captions";
import { Engage } from "../src/panels/engage";
import { Announcer, Events } from "../src/panels/events";
import { FlightControls } from "../src/panels/flight-controls";
import { Header } from "../src/panels/header";
import { Help } from "../src/panels/help";
import { LeaderControls } from "../src/panels/leader-controls";
import { OutageNotice } from "../src/panels/outage";
import { PlanNumbers } from "../src/panels/plan";
import { ScenarioPicker } from "../src/panels/scenario-picker";
import { Scene } from "../src/scene/scene";
import { createSession } from "../src/session";
import { createFlightStore } from "../src/store/flight";
import { Timeline } from "../src/timeline/timeline";
import { NM } from "../src/units";
import {
  alert,
  amend,
  modeChanged,
  noPlan,
  OWN,
  planChanged,
  STARTED,
  sample,
  separationLost,
  tick,
  unable,
} from "./samples";
import { silentActions } from "./silence";

const place = document.body.appendChild(document.createElement("div"));

afterEach(() => render(null, place));

function flying() {
  const store = createFlightStore();
  store.link("open");
  const way = { word: "LSR", turning_deg: 90, passes: "behind", side: "left" } as const;
  const slower = {
    ...way,
    time_to_converge_s: 260,
    why: "10 s slower",
    rejected: "slower",
  } as const;
  store.receive(
    tick(0, [STARTED, modeChanged(0), planChanged(0, { alternatives: [slower] }), sample(0)]),
    0,
  );
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
    stream_url: "/api/v1/flights/one/stream",
    scene_url: "/scene/one/",
    seed: 0,
    version: "1.0.0",
    recorded: true,
  };
  return { store, session, actions: silentActions() };
}

function button(name: string): HTMLButtonElement {
  const found = [...place.querySelectorAll("button")].find(
    (each) => (each.getAttribute("aria-label") ?? each.textContent) === name,
  );
  if (found === undefined) throw new Error(`no button ${name} in ${place.innerHTML}`);
  return found;
}

describe("panels", () => {
  test("nothing flies yet: no panel invents a number", () => {
    const session = createSession(createFlightStore().flight);
    render(
      <>
        <Header session={session} />
        <PlanNumbers session={session} />
        <Aircraft session={session} actions={silentActions()} />
        <Alternatives session={session} />
        <Events session={session} />
        <Scene session={session} actions={silentActions()} />
      </>,
      place,
    );
    expect(place.textContent).not.toMatch(/NaN|undefined|Infinity|FL\d/);
    expect(place.querySelector("iframe")).toBeNull();
  });

  test("the numbers of a plan", () => {
    const { session } = flying();
    render(<PlanNumbers session={session} />, place);
    const text = place.textContent ?? "";
    for (const part of ["04:10", "joins at 04:10", "RS", "closing 78 kt", "Optimal", "0.08 ms"]) {
      expect(text).toContain(part);
    }
  });

  test("a path that is kept was not planned in no time", () => {
    const { store, session } = flying();
    store.receive(tick(1, [planChanged(1, { compute_ms: 0 }), sample(1)]), 1000);
    render(<PlanNumbers session={session} />, place);
    expect(place.textContent).toContain("path kept");
    expect(place.textContent).not.toContain("0.00 ms");
  });

  test("of alternatives it is said that their times are ideal, of the headline that it is flown", () => {
    const { session } = flying();
    render(
      <>
        <PlanNumbers session={session} />
        <Alternatives session={session} />
      </>,
      place,
    );
    const said = place.querySelector(".alternatives header")?.textContent;
    expect(said).toContain("ideal times");
    expect(place.querySelector(".headline-label")?.textContent).toContain("as flown");
  });

  test.each(["heading", "escape"] as const)(
    "in mode %s nothing is said of the plan before",
    (mode) => {
      const { store, session } = flying();
      store.receive(tick(1, [modeChanged(1, mode), sample(1, { mode })]), 1000);
      render(
        <>
          <PlanNumbers session={session} />
          <Alternatives session={session} />
        </>,
        place,
      );
      expect(place.textContent).not.toMatch(/flown$|Least proved|Least forecast|Optimal|joins at/);
      expect(place.querySelector(".flown")).toBeNull();
      expect(place.textContent).toContain("No path is proposed or flown now.");
    },
  );

  test("lost separation is told in words, not only in red", () => {
    const { store, session } = flying();
    store.receive(tick(1, [sample(1, { least_separation_m: 4 * NM })]), 1000);
    render(<PlanNumbers session={session} />, place);
    expect(place.querySelector(".figure.alert")?.textContent).toBe("4.0");
    expect(place.textContent).toContain("LOST");
  });

  test.each([
    ["lost", { separation_m: 3 * NM, least_separation_m: 3 * NM }, [], "alert", "SEPARATION"],
    ["predicted", {}, [alert(1)], "caution", "SEP IN 45 S"],
  ] as const)("separation that is %s is said in both panels, in words and in colour", (...row) => {
    const [, changes, alerts, level, text] = row;
    const { store, session, actions } = flying();
    store.receive(tick(1, [...alerts, sample(1, changes)]), 1000);
    render(
      <>
        <PlanNumbers session={session} />
        <Aircraft session={session} actions={actions} />
        <Captions session={session} actions={actions} />
      </>,
      place,
    );
    for (const panel of ["plan", "aircraft"]) {
      expect(place.querySelector(`.${panel}.${level} .alarm b`)?.textContent).toBe(text);
    }
    const now = [...place.querySelectorAll(".reading")].find((each) =>
      each.textContent?.startsWith("d now"),
    );
    expect(now?.querySelector(".figure")?.classList.contains(level)).toBe(true);
    if (level === "alert")
      expect(place.querySelector(".headline.lost .headline-figure")?.textContent).toBe("3.0");
    // the first steps do not talk over it
    expect(place.querySelector(".first-minute")).toBeNull();
  });

  test("a leader that is not heard of has no numbers, and no intent, in any panel", () => {
    const { store, session, actions } = flying();
    const silent = { leader_age_s: 15, mode: "heading", engagement: "designated" } as const;
    store.receive(tick(15, [sample(15, silent)]), 1000);
    render(
      <>
        <PlanNumbers session={session} />
        <Aircraft session={session} actions={actions} />
        <LeaderControls session={session} actions={actions} />
        <Engage session={session} actions={actions} />
      </>,
      place,
    );
    const rows = [...place.querySelectorAll(".states tbody tr")];
    expect(rows.map((row) => row.querySelector("td:last-child")?.textContent)).toEqual(
      rows.map(() => "––"),
    );
    expect(rows[0]?.querySelector("td")?.textContent).toBe("090");
    const text = place.textContent ?? "";
    expect(text).toContain("Leader intentunknown");
    expect(place.querySelector(".panel.leader")?.textContent).not.toMatch(/now \d/);
    expect(text).toContain("The autopilot holds the heading");
    expect(text).not.toContain("You fly");
  });

  test("heard of again, the leader is proposed a path to, and the two steps to engage are said", () => {
    const { store, session, actions } = flying();
    const { kind: _, reason: __, announced: ___, tube_m: ____, ...plan } = planChanged(40);
    const dropped = { kind: "engagement_changed", t_s: 31, ident: OWN, message: "." } as const;
    store.receive(
      tick(40, [
        { ...dropped, previous: "engaged", engagement: "designated" },
        { ...plan, kind: "plan_proposed", others: [] },
        sample(40, { mode: "heading", engagement: "designated" }),
      ]),
      1000,
    );
    render(<Engage session={session} actions={actions} />, place);
    expect(place.textContent).toContain(
      "at 00:31. Two steps engage it again: Accept, then Engage.",
    );
    expect(session.shown.picture.value.notices[0]?.text).toBe("RG WAS ON – ACCEPT, ENGAGE");
  });

  test("the first steps end with the join: they say what to try, and close", () => {
    vi.useFakeTimers();
    const { store, session, actions } = flying();
    act(() => render(<Captions session={session} actions={actions} />, place));
    expect(place.textContent).toContain("Green will be flown");
    act(() => store.receive(tick(250, [sample(250, { mode: "follow", joined: true })]), 1000));
    expect(place.textContent).toContain("5 of 5Done");
    act(() => {
      vi.advanceTimersByTime(60_000);
    });
    expect(session.captions.value).toBe(false);
    expect(place.textContent).toBe("");
    vi.useRealTimers();
  });

  test("without a plan the reason is shown and announced", () => {
    const { store, session } = flying();
    store.receive(tick(1, [noPlan(1), sample(1)]), 1000);
    render(
      <>
        <PlanNumbers session={session} />
        <Announcer session={session} />
      </>,
      place,
    );
    expect(place.querySelector(".headline")?.textContent).toContain("The leader is faster.");
    const spoken = place.querySelector("[aria-live=assertive]")?.textContent;
    expect(spoken).toBe("Unable: the leader is faster.");
  });

  test("alerts, unable and a lost separation are listed by level, and spoken", () => {
    const { store, session } = flying();
    const caution = alert(1);
    store.receive(tick(1, [caution, sample(1)]), 1000);
    store.receive(tick(2, [unable(2), separationLost(2), sample(2)]), 2000);
    render(
      <>
        <Events session={session} />
        <Announcer session={session} />
      </>,
      place,
    );
    const spoken = () => place.querySelector("[aria-live=assertive]")?.textContent ?? "";
    for (const [kind, name, text] of [
      ["caution", "CAUTION", caution.message],
      ["unable", "UNABLE", "The leader turns back."],
      ["lost", "LOST", "Separation: the leader turned towards own ship."],
    ] as const) {
      expect(place.querySelector(`.log .${kind}`)?.textContent).toContain(`${name}${text}`);
      expect(spoken().toLowerCase()).toContain(text.replace("Separation: ", "").toLowerCase());
    }
    const over = { ...caution, t_s: 3, cleared: true, message: "The leader is fast enough." };
    act(() => store.receive(tick(3, [over, sample(3)]), 3000));
    expect(place.querySelector(".log .clear")?.textContent).toContain(over.message);
    expect(spoken()).not.toContain(caution.message);
  });

  test("a join at another time than was said is listed and spoken, until the next plan", () => {
    const { store, session } = flying();
    const message = "Joins in 12:30, 0:45 later than was said.";
    const promise = { kind: "promise_changed", t_s: 1, ident: OWN, promised_s: 750 } as const;
    store.receive(tick(1, [{ ...promise, message }, sample(1)]), 1000);
    render(
      <>
        <Events session={session} />
        <Announcer session={session} />
      </>,
      place,
    );
    const spoken = () => place.querySelector("[role=status]")?.textContent;
    expect(place.querySelector(".log .plan")?.textContent).toContain(message);
    expect(spoken()).toContain(message);
    act(() => store.receive(tick(2, [planChanged(2), sample(2)]), 2000));
    expect(spoken()).not.toContain(message);
  });

  test("what guidance is not certain of is a number, if there is one", () => {
    const { store, session } = flying();
    const text = () => place.textContent;
    render(<PlanNumbers session={session} />, place);
    expect(text()).not.toContain("Uncertain");
    act(() => store.receive(tick(1, [sample(1, { margin_m: 185.2 })]), 1000));
    expect(text()).toContain("Uncertain by± 0.10NM");
    expect(text()).toContain("kept beside MIN");
  });

  test("a report that is late is no loss of reports", () => {
    const { store, session, actions } = flying();
    render(<LeaderControls session={session} actions={actions} />, place);
    const isChosen = (name: string) => button(name).getAttribute("aria-pressed");
    act(() => store.receive(tick(1, [sample(1, { leader_age_s: 1 })]), 1000));
    expect(isChosen("received")).toBe("true");
    act(() => store.receive(tick(4, [sample(4, { leader_age_s: 4 })]), 4000));
    expect(isChosen("lost")).toBe("true");
  });

  test("numbers are blanked when the data are lost, not left standing", () => {
    const { store, session } = flying();
    store.advance(4000);
    expect(session.shown.numbers.value.sample).not.toBeNull();
    store.advance(5100);
    render(
      <>
        <Header session={session} />
        <PlanNumbers session={session} />
        <Aircraft session={session} actions={silentActions()} />
      </>,
      place,
    );
    expect(place.textContent).toContain("The data are lost.");
    expect(place.querySelector(".sim-time")?.textContent).toBe("––:––");
    expect(place.querySelector(".states tbody")?.textContent).not.toMatch(/\d/);
  });

  test("scenarios: a missing one says why and cannot be chosen", () => {
    const { session, actions } = flying();
    session.scenarios.value = [
      { name: "fig_6b", title: "Fig. 6b", description: "Known.", available: true, message: "" },
      { name: "rec", title: "Recorded", description: "", available: false, message: "Install it." },
    ];
    session.helpOpen.value = true;
    render(
      <>
        <ScenarioPicker session={session} actions={actions} />
        <Help session={session} actions={actions} />
      </>,
      place,
    );
    const options = [...place.querySelectorAll("option")];
    expect(options.map((each) => each.disabled)).toEqual([false, true]);
    expect(place.querySelector(".scenario")?.textContent).toContain("see Help");
    expect(place.querySelector(".help")?.textContent).toContain(
      "Recorded is not available. Install it.",
    );
    const picker = place.querySelector("select");
    act(() => {
      picker?.dispatchEvent(new Event("change", { bubbles: true }));
    });
    expect(actions.start).toHaveBeenCalledWith("fig_6b");
  });

  test("restart begins the scenario anew", () => {
    const { session, actions } = flying();
    render(<FlightControls session={session} actions={actions} />, place);
    act(() => button("Restart").click());
    expect(actions.start).toHaveBeenCalledWith("fig_6b");
  });

  test("feedback is a live region with the server's sentence", () => {
    const { session, actions } = flying();
    session.feedback.value = { kind: "refused", text: "Too fast." };
    render(<FlightControls session={session} actions={actions} />, place);
    expect(place.querySelector("[role=status]")?.textContent).toBe("REFUSED Too fast.");
  });

  test("the leader's heading is selected, then commanded with its side", () => {
    const { session, actions } = flying();
    render(<LeaderControls session={session} actions={actions} />, place);
    act(() => button("Leader's heading: plus 10").click());
    act(() => button("Leader's heading: minus 1").click());
    act(() => button("Left").click());
    expect(actions.leaderHeading).toHaveBeenLastCalledWith(99, "left");
    act(() => button("Shorter").click());
    expect(actions.leaderHeading).toHaveBeenLastCalledWith(99);
  });

  test("a typed heading is taken with Enter, and beyond north it wraps", () => {
    const { session, actions } = flying();
    render(<LeaderControls session={session} actions={actions} />, place);
    const input = place.querySelector<HTMLInputElement>('[aria-label="Leader\'s heading"]');
    if (input === null) throw new Error("no heading field");
    act(() => {
      input.value = "355";
      input.dispatchEvent(new Event("input", { bubbles: true }));
    });
    act(() => {
      input.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
    });
    expect(actions.leaderHeading).toHaveBeenLastCalledWith(355);
    act(() => button("Leader's heading: plus 10").click());
    expect(input.value).toBe("005");
  });

  test("a heading beyond 360 is passed on as typed, and then shown as what it means", () => {
    const { session, actions } = flying();
    render(<LeaderControls session={session} actions={actions} />, place);
    const input = place.querySelector<HTMLInputElement>('[aria-label="Leader\'s heading"]');
    if (input === null) throw new Error("no heading field");
    act(() => {
      input.value = "400";
      input.dispatchEvent(new Event("input", { bubbles: true }));
    });
    expect(input.value).toBe("400");
    act(() => button("Right").click());
    expect(actions.leaderHeading).toHaveBeenLastCalledWith(400, "right");
    act(() => {
      input.dispatchEvent(new FocusEvent("blur"));
    });
    expect(input.value).toBe("040");
  });

  test("a leader that is called Leader is not called so twice", () => {
    const { store, session, actions } = flying();
    render(<LeaderControls session={session} actions={actions} />, place);
    expect(place.querySelector(".leader header")?.textContent).toBe("LeaderAF123");
    const started = store.flight.moment.value.started;
    if (started === null) throw new Error("no flight");
    const leader = { ...started.leader, ident: "LEADER" };
    act(() => {
      amend(store.flight, { started: { ...started, leader } });
    });
    expect(place.querySelector(".leader header")?.textContent).toBe("Leader");
  });

  test("the speed is commanded in metres per second", () => {
    const { session, actions } = flying();
    render(<LeaderControls session={session} actions={actions} />, place);
    act(() => button("Set").click());
    expect(vi.mocked(actions.leaderSpeed).mock.calls[0]?.[0]).toBeCloseTo(200, 0);
  });

  test("an outage is an alert with the button that helps", () => {
    const { session, actions } = flying();
    session.outage.value = { kind: "flight_gone", text: "Gone.", scenario: "fig_6a" };
    render(<OutageNotice session={session} actions={actions} />, place);
    expect(place.querySelector("[role=alert]")?.textContent).toContain("Gone.");
    act(() => button("Start a new flight").click());
    expect(actions.start).toHaveBeenCalledWith("fig_6a");
  });

  test("the header tells old data by word and age", () => {
    const { store, session } = flying();
    render(<Header session={session} />, place);
    expect(place.textContent).toContain("Live");
    act(() => store.advance(3200));
    expect(place.textContent).toContain("Data old 3 s");
  });

  test("a maximised scene leaves the crew its steps and the key numbers", () => {
    const { session } = flying();
    const actions = silentActions();
    session.sceneMaximised.value = true;
    const aside = document.createElement("div");
    render(<Scene session={session} actions={actions} />, aside);
    const bar = aside.querySelector(".scene-bar");
    const numbers = session.shown.numbers.value;
    for (const each of [numbers.separation, numbers.slotDistance, numbers.minSeparation])
      expect(bar?.textContent).toContain(each);
    const back = [...(bar?.querySelectorAll("button") ?? [])].at(-1);
    back?.click();
    expect(actions.engage).toHaveBeenCalledWith("off");
  });

  test("the scene is asked for once there is a position", () => {
    const { session } = flying();
    const aside = document.createElement("div"); // outside the document, so that nothing is loaded
    render(<Scene session={session} actions={silentActions()} />, aside);
    expect(aside.querySelector("iframe")?.getAttribute("src")).toBe("/scene/one/");
    expect(aside.querySelector("iframe")?.title).not.toBe("");
  });

  test("every button has a name", () => {
    const { session, actions } = flying();
    render(
      <>
        <Timeline session={session} actions={actions} />
        <FlightControls session={session} actions={actions} />
        <LeaderControls session={session} actions={actions} />
      </>,
      place,
    );
    expect(place.querySelectorAll("button").length).toBeGreaterThan(20);
    for (const each of place.querySelectorAll("button")) {
      expect((each.getAttribute("aria-label") ?? each.textContent)?.trim()).toBeTruthy();
    }
  });
});

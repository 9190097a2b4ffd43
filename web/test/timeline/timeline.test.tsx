// @vitest-environment happy-dom
import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { createActions } from "../../src/actions";
import { keyAction } from "../../src/keyboard";
import { createSession } from "../../src/session";
import { createFlightStore } from "../../src/store/flight";
import { Timeline } from "../../src/timeline/timeline";
import { readClockText } from "../../src/units";
import { alert, modeChanged, planChanged, STARTED, sample, tick } from "../samples";

let place: HTMLDivElement;
let asked: ReturnType<typeof vi.fn>;

beforeEach(() => {
  place = document.body.appendChild(document.createElement("div"));
  asked = vi.fn(async () => new Response("{}", { status: 200 }));
  vi.stubGlobal("fetch", asked);
});

afterEach(() => {
  render(null, place);
  place.remove();
  vi.unstubAllGlobals();
});

/** A minute of a flight, with the timeline drawn. */
function watched() {
  const store = createFlightStore();
  const session = createSession(store.flight, undefined, store.history);
  const actions = createActions(session, store);
  store.link("open");
  for (let t = 0; t <= 60; t += 1) {
    const documents = t === 0 ? [STARTED, modeChanged(0), planChanged(0)] : [];
    store.receive(tick(t, [...documents, ...(t === 40 ? [alert(40)] : []), sample(t)]), 1000 * t);
  }
  act(() => render(<Timeline session={session} actions={actions} />, place));
  return { store, session, actions };
}

function button(label: string): HTMLButtonElement {
  const found = [...place.querySelectorAll("button")].find(
    (each) => each.getAttribute("aria-label") === label || each.textContent?.includes(label),
  );
  if (found === undefined) throw new Error(`There is no button ${label}.`);
  return found;
}

describe("the timeline", () => {
  test("marks what happened, and steps from one to the next", () => {
    const { session, actions } = watched();
    const titles = [...place.querySelectorAll(".mark title")].map((each) => each.textContent);
    expect(titles).toContain("00:40 The leader slows down.");
    act(() => actions.seek(10));
    act(() => button("To the event after").click());
    expect(session.flight.moment.value.t).toBe(40);
    act(() => button("To the event before").click());
    expect(session.flight.moment.value.t).toBe(0);
  });

  test("says how far behind the flight it is, and a press goes back to it", () => {
    const { session, actions } = watched();
    expect(place.textContent).toContain("LIVE");
    act(() => actions.seek(20));
    expect(button("LIVE").textContent).toBe("−00:40 LIVE ▸");
    act(() => button("LIVE").click());
    expect(session.flight.source.value.kind).toBe("live");
  });

  test("shows no later time than the end it names, though the picture runs ahead of the newest", () => {
    const { store } = watched();
    act(() => store.receive({ ...tick(60, [sample(60)]), rate: 60 }, 60_000));
    act(() => store.advance(60_900));
    const shown = readClockText(place.querySelector("input")?.value ?? "");
    expect(shown).toBe(60 + 54);
    expect(place.querySelector(".of")?.textContent).toBe("of 01:54");
    const slider = place.querySelector("[role=slider]");
    expect(slider?.getAttribute("aria-valuetext")).toBe("01:54 of 01:54");
    expect(slider?.getAttribute("aria-valuemax")).toBe("114");
  });

  test("behind the flight nothing is commanded, and play is the page's own", () => {
    const { session, actions } = watched();
    act(() => actions.seek(20));
    actions.engage("off");
    actions.leaderHeading(90);
    expect(session.feedback.value).toMatchObject({ kind: "refused" });
    expect(session.feedback.value.kind === "refused" && session.feedback.value.text).toContain(
      "00:40 behind the flight",
    );
    act(() => button("×10").click());
    act(() => button("Play").click());
    expect(session.flight.source.value).toEqual({ kind: "replay", rate: 10 });
    expect(asked).not.toHaveBeenCalled();
  });

  test("a typed time is shown, and one that is none, or not there, is refused beside the field", () => {
    const { session } = watched();
    const field = place.querySelector("input");
    const type = (text: string) =>
      act(() => {
        if (field === null) throw new Error("No field");
        field.value = text;
        field.dispatchEvent(new Event("change", { bubbles: true }));
      });
    type("0:30");
    expect(session.flight.moment.value.t).toBe(30);
    type("soon");
    expect(place.textContent).toContain("“soon” is no time");
    type("12:00");
    expect(place.textContent).toContain("known from 00:00 to 01:00");
    expect(session.flight.moment.value.t).toBe(30);
  });

  test("the keys move it", () => {
    const { session, actions } = watched();
    const press = (key: string, isShifted = false) =>
      act(() => keyAction(key, session, actions, isShifted)?.());
    act(() => actions.seek(30));
    press("ArrowRight");
    expect(session.flight.moment.value.t).toBe(31);
    press("ArrowLeft", true);
    expect(session.flight.moment.value.t).toBe(21);
    press("[");
    act(() => actions.seek(25));
    press("]");
    expect(session.flight.loop.value).toEqual({ from: 21, to: 25 });
    press("l");
    expect(session.flight.source.value.kind).toBe("live");
  });
});

test.each([
  ["13:39", 819],
  ["1:00:00", 3600],
  ["42.5", 42.5],
  ["", null],
  ["13:x", null],
  ["1:2:3:4", null],
])("%s as a time", (text, seconds) => {
  expect(readClockText(text)).toBe(seconds);
});

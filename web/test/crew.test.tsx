/** Who flies, and what the crew selects: switches with their state, fields with their unit, refusals. */

import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, describe, expect, test } from "vitest";
import { Selections, Switches } from "../src/panels/crew";
import { createSession } from "../src/session";
import type { PairSample } from "../src/store/pair";
import { KT, NM } from "../src/units";
import { flightIn } from "./nd/in-state";
import { amend, OWN } from "./samples";
import { silentActions } from "./silence";

const place = document.body.appendChild(document.createElement("div"));
afterEach(() => render(null, place));

function flying(changes: Partial<PairSample> = {}) {
  const flight = flightIn("converge");
  const { sample } = flight.moment.value;
  if (sample === null) throw new Error("An empty flight.");
  const now = { ...sample, ...changes };
  amend(flight, { sample: now, now });
  return { session: createSession(flight), actions: silentActions() };
}

function named(name: string): HTMLInputElement {
  const found = place.querySelector<HTMLInputElement>(`[aria-label^="${name}"]`);
  if (found === null) throw new Error(`nothing is called ${name} in ${place.innerHTML}`);
  return found;
}

describe("the switches", () => {
  const pressed = () =>
    [...place.querySelectorAll("button")].map((each) => each.getAttribute("aria-pressed"));

  test("say what is on, and do the other", () => {
    const { session, actions } = flying();
    render(<Switches session={session} actions={actions} />, place);
    expect(pressed()).toEqual(["true", "false", "false"]);
    named("Autopilot").click();
    named("Flight director").click();
    expect(actions.setAutopilot).toHaveBeenCalledWith(false);
    expect(actions.setDirector).toHaveBeenCalledWith(true);
  });

  test("by hand the instrument is there, and control is given back", () => {
    const { session, actions } = flying({ autopilot: false, director: true });
    render(<Switches session={session} actions={actions} />, place);
    expect(pressed()).toEqual(["false", "true", "true"]);
    const instrument = [...place.querySelectorAll("button")].find(
      (each) => each.textContent === "PFD",
    );
    expect(instrument?.disabled).toBe(true);
    named("Autopilot").click();
    expect(actions.setAutopilot).toHaveBeenCalledWith(true);
  });
});

describe("the selections", () => {
  async function type(name: string, text: string) {
    const input = named(name);
    await act(() => {
      input.value = text;
      input.dispatchEvent(new Event("input", { bubbles: true }));
    });
    await act(() => {
      input.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
    });
  }

  test("are commanded in the units of the wire", async () => {
    const { session, actions } = flying();
    render(<Selections session={session} actions={actions} />, place);
    await type("Bank", "20");
    await type("Own true airspeed", "430");
    await type("Distance", "8,5");
    await type("Minimum", "4");
    expect(actions.selectBank).toHaveBeenCalledWith(20);
    expect(actions.selectSpeed).toHaveBeenCalledWith(430 * KT);
    expect(actions.setSpacing).toHaveBeenCalledWith({ slot_distance_m: 8.5 * NM });
    expect(actions.setSpacing).toHaveBeenCalledWith({ min_separation_m: 4 * NM });
  });

  test.each(["", "much", "-3", "0"])("“%s” is refused with what would be right", async (text) => {
    const { session, actions } = flying();
    render(<Selections session={session} actions={actions} />, place);
    await type("Distance", text);
    expect(actions.setSpacing).not.toHaveBeenCalled();
    expect(place.querySelector("[role=alert]")?.textContent).toContain("type a number such as 5.4");
  });

  test("a selected speed can be left to guidance again", async () => {
    const { session, actions } = flying();
    const assignment = {
      kind: "assignment_changed",
      t_s: 1,
      ident: OWN,
      slot_distance_m: 10_000,
      min_separation_m: 9260,
      max_bank_deg: 22,
      selected_tas_mps: [220],
      message: "",
    } as const;
    amend(session.flight, { assignment: { ...assignment, selected_tas_mps: [220] } });
    render(<Selections session={session} actions={actions} />, place);
    expect(place.querySelector("summary")?.textContent).toContain("Bank 22° TAS 428 kt");
    place.querySelector("button")?.click();
    expect(actions.selectSpeed).toHaveBeenCalledWith(null);
  });
});

import { signal } from "@preact/signals";
import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, expect, test } from "vitest";
import { NavigationDisplay } from "../src/nd/nd";
import { Help } from "../src/panels/help";
import { createSession } from "../src/session";
import { createFlightStore } from "../src/store/flight";
import { createShown } from "../src/store/shown";
import { ELEMENTS, elementOf } from "../src/words";
import { flightAt } from "./nd/fixture";
import { silentActions } from "./silence";

const place = document.body.appendChild(document.createElement("div"));
afterEach(() => render(null, place));

test("everything that is drawn has words", () => {
  for (const [t, mode] of [
    [60, "converge"],
    [900, "follow"],
  ] as const) {
    const shown = createShown(flightAt("fig_6b", t, mode));
    render(<NavigationDisplay shown={shown} mode={signal("ROSE")} range={signal(80)} />, place);
    const marks = place.querySelectorAll(
      ".nd-map .nd-stroke, .nd-map .nd-solid, .nd-tape .nd-text",
    );
    expect(marks.length).toBeGreaterThan(20);
    for (const mark of marks)
      if ((mark.getAttribute("d") ?? "M") !== "")
        expect(elementOf(mark)?.title, mark.parentElement?.outerHTML.slice(0, 200)).toBeTruthy();
  }
});

test("Help has the same words, takes the focus and gives it back", () => {
  const session = createSession(createFlightStore().flight);
  const button = document.body.appendChild(document.createElement("button"));
  button.focus();
  session.helpOpen.value = true;
  act(() => render(<Help session={session} actions={silentActions()} />, place));
  const dialog = place.querySelector("[role=dialog]");
  expect(document.activeElement).toBe(dialog);
  for (const { title, what } of ELEMENTS) expect(dialog?.textContent).toContain(`${title} ${what}`);
  act(() => {
    session.helpOpen.value = false;
  });
  expect(document.activeElement).toBe(button);
  button.remove();
});

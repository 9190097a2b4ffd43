/** Every element of the display in every state of guidance, from one table. */

import { signal } from "@preact/signals";
import { expect, test } from "vitest";
import { NavigationDisplay } from "../../src/nd/nd";
import { createShown } from "../../src/store/picture";
import { GUIDANCES, type Guidance } from "../../src/store/states";
import { mount } from "./draw";
import { ELEMENT_ROWS } from "./elements";
import { flightIn } from "./in-state";

const ROOTS = new Map<Guidance, Element>(
  GUIDANCES.map((state) => [
    state,
    mount(NavigationDisplay, {
      shown: createShown(flightIn(state)),
      mode: signal<"ROSE" | "ARC">("ROSE"),
      range: signal(80),
    }),
  ]),
);

/** Whether something of it is drawn: a line that leads somewhere, a circle, or text. */
function isDrawn(root: Element, selector: string): boolean {
  return [...root.querySelectorAll(selector)].some((mark) => {
    if (mark.matches("path")) return (mark.getAttribute("d") ?? "") !== "";
    return mark.matches("text") ? (mark.textContent ?? "") !== "" : true;
  });
}

const CELLS = ELEMENT_ROWS.flatMap((row) =>
  row.selector === null ? [] : GUIDANCES.map((state) => ({ ...row, state })),
);

test.each(CELLS)("$number $name in state $state", ({ selector, states, state }) => {
  const root = ROOTS.get(state);
  if (root === undefined || selector === null) throw new Error("No such state.");
  expect(isDrawn(root, selector)).toBe(states.has(state));
});

test("the table has every element once, and says why where there is none", () => {
  expect(ELEMENT_ROWS.map(({ number }) => number)).toEqual(
    Array.from({ length: 47 }, (_, i) => i + 1),
  );
  for (const { selector, why } of ELEMENT_ROWS) expect(selector === null).toBe((why ?? "") !== "");
});

/** Those that come with an event, whatever the state: each of them has a test of its own. */
const EVENTS = [16, 18, 24, 39, 46];

test("each element that is drawn is drawn in some state, or comes with an event", () => {
  for (const { number, selector, states } of ELEMENT_ROWS)
    if (selector !== null) expect(states.size > 0, `${number}`).toBe(!EVENTS.includes(number));
});

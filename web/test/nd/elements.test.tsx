/** Every element of the display in every state of guidance, from one table. */

import { writeFileSync } from "node:fs";
import { expect, test } from "vitest";
import { GUIDANCES } from "../../src/store/states";
import { ELEMENTS, elementOf } from "../../src/words";
import { ELEMENT_ROWS } from "./elements";
import { isDrawn, pageOfStates, ROOTS } from "./pictures";

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
const EVENTS = [16, 18, 24, 38, 39, 46];

test("each element that is drawn is drawn in some state, or comes with an event", () => {
  for (const { number, selector, states } of ELEMENT_ROWS)
    if (selector !== null) expect(states.size > 0, `${number}`).toBe(!EVENTS.includes(number));
});

test("a page of full pictures has each state, and what is drawn in it", () => {
  const page = pageOfStates();
  for (const state of GUIDANCES) expect(page).toContain(`<h2>${state}</h2>`);
  expect(page.match(/role="img"/g)).toHaveLength(GUIDANCES.length);
  expect(page.match(/<tr>/g)).toHaveLength(ELEMENT_ROWS.length + 1);
  // `make picture` says where it is to be written, to be looked at
  const { PICTURES } = process.env;
  if (PICTURES !== undefined) writeFileSync(PICTURES, page);
});

test("whatever is drawn says what it is when it is pointed at, texts as well", () => {
  for (const { number, selector } of ELEMENT_ROWS) {
    if (selector === null) continue;
    const marks = [...ROOTS.values()].flatMap((root) => [...root.querySelectorAll(selector)]);
    for (const mark of marks)
      expect(elementOf(mark), `${number}: ${mark.outerHTML}`).not.toBeNull();
  }
  expect(ELEMENTS.some(({ name }) => name === "flag")).toBe(true);
});

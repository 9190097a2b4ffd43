/** The flights of the gallery are tested by the library: it has the same twelve situations. */

import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { GALLERY } from "../../src/map/gallery";
import { bodyOf, settle } from "../../src/map/situation";

test("the golden file holds the gallery's situations", () => {
  const written = readFileSync("../tests/golden/gallery.situations.jsonl", "utf8");
  const laid = GALLERY.map(({ name, situation }) =>
    JSON.stringify({ id: name, ...bodyOf(settle(situation)) }),
  );
  expect(written.trimEnd().split("\n")).toEqual(laid);
});

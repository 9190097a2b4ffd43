import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { COLOURS, PALETTES } from "../../src/picture/palettes";
import { type PictureOptions, pictureOf, pictureOfShown } from "../../src/picture/picture";
import { createShown } from "../../src/store/shown";
import { GUIDANCES } from "../../src/store/states";
import { flightIn } from "../nd/in-state";
import { modeChanged, planChanged, STARTED, sample } from "../samples";

const DOCUMENTS = [STARTED, modeChanged(0), planChanged(0), ...[0, 1, 2, 3].map((t) => sample(t))];
const LINES = DOCUMENTS.map((each) => JSON.stringify(each)).join("\n");
const AT_TWO: PictureOptions = {
  t: 2,
  mode: "ARC",
  range: 40,
  palette: "dark",
  caption: "relguide picture flight.jsonl --at 2",
};

/** What of a drawing is no XML: the parser of browsers says so in an element of its own. */
function faults(svg: string): string[] {
  const parsed = new DOMParser().parseFromString(svg, "image/svg+xml");
  return [...parsed.querySelectorAll("parsererror")].map((each) => each.textContent ?? "");
}

test("palettes differ in colours alone", () => {
  const [dark, light] = PALETTES.map((palette) => pictureOf(LINES, { ...AT_TWO, palette }));
  const uncoloured = (drawn = "") => drawn.replaceAll(/#[0-9a-f]{6}/g, "#");
  expect(light).not.toBe(dark);
  expect(uncoloured(light)).toBe(uncoloured(dark));
  for (const name of ["rings", "tape", "ownship", "leader", "slot", "circle", "fma", "labels"])
    expect(dark).toContain(`<g class="nd-${name}"`);
});

describe.each(GUIDANCES)("%s", (state) => {
  const shown = createShown(flightIn(state));
  const drawn = pictureOfShown(shown, { mode: "ROSE", range: 80, palette: "light" }, "");

  test("needs no style sheet", () => {
    expect(drawn).not.toMatch(/var\(|NaN|undefined|style=/);
    for (const colour of drawn.match(/#[0-9a-f]{3,8}/g) ?? [])
      expect(Object.values(COLOURS.light)).toContain(colour);
  });

  test("is one drawing, each attribute once and with its value", () => {
    expect(drawn.match(/<svg /g)).toHaveLength(1);
    expect(faults(drawn)).toEqual([]);
    expect(drawn).not.toMatch(/<(text|g)[^>]*(?:\/>|><\/\1>)/); // nothing that draws nothing
    for (const [tag] of drawn.matchAll(/<\w[^>]*>/g)) {
      const names = [...tag.matchAll(/ ([\w:-]+)="/g)].map(([, name]) => name);
      expect(new Set(names).size, tag).toBe(names.length);
      expect(tag.replace(/ [\w:-]+="[^"]*"/g, ""), tag).toMatch(/^<\w+\/?>$/);
    }
  });
});

test("a JSON array and lines below the head of a recording are the same flight", () => {
  const recording = `{"format":"relguide-flight","version":3}\n${LINES}\n`;
  expect(pictureOf(recording, AT_TWO)).toBe(pictureOf(JSON.stringify(DOCUMENTS), AT_TWO));
});

test("what comes after is not known", () => {
  const until = LINES.split("\n").slice(0, -1).join("\n");
  expect(pictureOf(LINES, AT_TWO)).toBe(pictureOf(until, AT_TWO));
});

test("the lines under the glass name flight, time, version and command", () => {
  const picture = pictureOf(LINES, { ...AT_TWO, range: "auto" });
  expect(picture).toMatch(/>Fig\. 6b · 00:02 · ARC \d+ NM · relguide \d+\.\d+\.\d+</);
  expect(picture).toContain(">relguide picture flight.jsonl --at 2<");
  expect(pictureOf(LINES, { ...AT_TWO, caption: 'a "b" <c> & d' })).toContain("&lt;c> &amp; d<");
});

test.each([-1, 4, Number.NaN])("t = %d is refused with the span", (t) => {
  expect(() => pictureOf(LINES, { ...AT_TWO, t })).toThrow(
    `t = ${t} s is outside the flight, which goes from 0 s to 3 s.`,
  );
});

test("nothing cannot be drawn", () => {
  expect(() => pictureOf("", AT_TWO)).toThrow("the flight has no documents");
});

test("dark is the cockpit's palette", () => {
  const tokens = readFileSync("src/styles/tokens.css", "utf8");
  for (const [name, colour] of Object.entries(COLOURS.dark))
    expect(tokens).toContain(`--${name}: ${colour};`);
});

test("what the style sheet says of a class is what a picture has", () => {
  const sheet = readFileSync("src/nd/nd.css", "utf8");
  const named = new Set(sheet.match(/\.nd-(?!display|plane|map|flash|touch)[a-z]+/g));
  const inlined = readFileSync("src/picture/inlined.ts", "utf8");
  for (const name of named) expect(inlined).toContain(`"${name.slice(1)}"`);
});

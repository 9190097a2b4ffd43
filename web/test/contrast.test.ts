import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";

const TOKENS = new Map(
  [...readFileSync("src/styles/tokens.css", "utf8").matchAll(/--([\w-]+): (#[0-9a-f]{6});/g)].map(
    ([, name, colour]) => [name ?? "", colour ?? ""],
  ),
);

function token(name: string): string {
  const colour = TOKENS.get(name);
  if (colour === undefined) throw new Error(`tokens.css has no colour --${name}`);
  return colour;
}

/** Relative luminance as WCAG 2.2 defines it. */
function luminance(colour: string): number {
  const [red, green, blue] = [1, 3, 5].map((at) => {
    const part = Number.parseInt(colour.slice(at, at + 2), 16) / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * (red ?? 0) + 0.7152 * (green ?? 0) + 0.0722 * (blue ?? 0);
}

function contrast(one: string, other: string): number {
  const [dark = 0, light = 0] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (light + 0.05) / (dark + 0.05);
}

const INSTRUMENT = [
  ...["scale", "ownship", "plan", "proposed", "armed", "selected", "leader", "leader-ring"],
  ...["managed", "value", "label", "unit", "caution", "alert", "superseded"],
];
const TEXT = ["text", "text-soft", "value", "selected", "caution", "alert-text", "managed", "good"];

describe("contrast", () => {
  test("the measure itself: white on black is 21", () => {
    expect(contrast("#ffffff", "#000000")).toBeCloseTo(21, 9);
  });

  test.each(INSTRUMENT)("--%s is legible on the glass", (name) => {
    expect(contrast(token(name), token("glass"))).toBeGreaterThan(4.5);
  });

  test.each(TEXT)("--%s is legible on the desk and its panels", (name) => {
    for (const ground of ["desk", "panel", "panel-raised"]) {
      expect(contrast(token(name), token(ground))).toBeGreaterThan(4.5);
    }
  });

  test.each(["edge-strong", "focus"])("--%s can be seen as an edge", (name) => {
    for (const ground of ["desk", "panel", "panel-raised"]) {
      expect(contrast(token(name), token(ground))).toBeGreaterThan(3);
    }
  });
});

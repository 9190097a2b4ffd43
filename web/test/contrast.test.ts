import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { COLOURS } from "../src/picture/palettes";

function tokensOf(file: string): [string, string][] {
  const text = readFileSync(`src/styles/${file}.css`, "utf8");
  return [...text.matchAll(/--([\w-]+): (#[0-9a-f]{6});/g)].map(([, name, colour]) => [
    name ?? "",
    colour ?? "",
  ]);
}

const TOKENS = new Map(tokensOf("tokens"));
const DISTINCT = new Map([...TOKENS, ...tokensOf("palette")]);

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

/** How colours are seen (Machado and others 2009, the whole of each deficiency), linear RGB to the same. */
const EYES = {
  usual: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protan: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deutan: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritan: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
} as const;
type Triple = readonly [number, number, number];

function times(matrix: readonly Triple[], [a, b, c]: Triple): Triple {
  const [x = 0, y = 0, z = 0] = matrix.map(([p, q, r]) => p * a + q * b + r * c);
  return [x, y, z];
}

/** CIE 1976 L*a*b* of a colour as an eye sees it. */
function seen(colour: string, eye: keyof typeof EYES): Triple {
  const part = (at: number) => {
    const value = Number.parseInt(colour.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  };
  const light = times(EYES[eye], [part(1), part(3), part(5)]).map((value) =>
    Math.min(1, Math.max(0, value)),
  );
  const [x, y, z] = times(
    [
      [0.4124564, 0.3575761, 0.1804375],
      [0.2126729, 0.7151522, 0.072175],
      [0.0193339, 0.119192, 0.9503041],
    ],
    [light[0] ?? 0, light[1] ?? 0, light[2] ?? 0],
  );
  const f = (value: number) => (value > 0.008856 ? Math.cbrt(value) : 7.787 * value + 16 / 116);
  const [fx, fy, fz] = [f(x / 0.95047), f(y), f(z / 1.08883)];
  return [116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)];
}

const MEANINGS = ["plan", "proposed", "armed", "caution", "alert", "leader", "managed"] as const;

test.each(Object.keys(EYES) as (keyof typeof EYES)[])(
  "the distinct palette is told apart by %s eyes",
  (eye) => {
    const colours = MEANINGS.map((name) => seen(DISTINCT.get(name) ?? "", eye));
    for (const [i, a] of colours.entries())
      for (const [j, b] of colours.slice(0, i).entries())
        expect(
          Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]),
          `${MEANINGS[i]} and ${MEANINGS[j]}`,
        ).toBeGreaterThan(30);
  },
);

describe("contrast", () => {
  test("the measure itself: white on black is 21", () => {
    expect(contrast("#ffffff", "#000000")).toBeCloseTo(21, 9);
  });

  test.each(INSTRUMENT)("--%s is legible on the glass", (name) => {
    expect(contrast(token(name), token("glass"))).toBeGreaterThan(4.5);
  });

  test.each(INSTRUMENT)("--%s of the distinct palette is legible on the glass", (name) => {
    expect(contrast(DISTINCT.get(name) ?? "", token("glass"))).toBeGreaterThan(4.5);
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

test.each(Object.entries(COLOURS.light))("%s reads on paper", (name, colour) => {
  if (name !== "glass" && name !== "halo")
    expect(contrast(colour, COLOURS.light.glass)).toBeGreaterThanOrEqual(4.5);
});

describe.each([0, 1])("the instrument to fly by, palette %s", (palette) => {
  const style = readFileSync("src/pfd/pfd.css", "utf8");
  const ground = (name: string) =>
    [...style.matchAll(new RegExp(`--pfd-${name}: (#[0-9a-f]{6});`, "g"))][palette]?.[1] ?? "";
  const marks = palette === 0 ? TOKENS : DISTINCT;

  test.each(["sky", "earth"])("what is drawn on the %s is seen on it", (name) => {
    expect(contrast(marks.get("scale") ?? "", ground(name))).toBeGreaterThan(4.5);
    for (const mark of ["ownship", "plan", "caution"])
      expect(contrast(marks.get(mark) ?? "", ground(name)), mark).toBeGreaterThan(3);
  });
});

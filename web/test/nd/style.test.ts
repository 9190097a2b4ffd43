import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { LINES, SEPARATION } from "../../src/nd/style";
import { AGE, GUIDANCE } from "../../src/store/state-styles";
import { AGES, GUIDANCES, SEPARATIONS } from "../../src/store/states";

const SOURCE = join(import.meta.dirname, "../../src");
const tokens = readFileSync(join(SOURCE, "styles/tokens.css"), "utf8");

test("every state has a look for every element", () => {
  for (const [states, table] of [
    [GUIDANCES, GUIDANCE],
    [AGES, AGE],
    [SEPARATIONS, SEPARATION],
  ] as const) {
    expect(Object.keys(table).sort()).toEqual([...states].sort());
    const columns = Object.values(table).map((style) => Object.keys(style).sort().join());
    expect(new Set(columns).size).toBe(1);
  }
});

test("without colour, what is flown, proposed, was flown, is declared and is guessed still differ", () => {
  const apart = [
    "active",
    "proposed",
    "ghost",
    "superseded",
    "final",
    "declared",
    "extrapolated",
    "circle",
  ] as const;
  const patterns = apart.map((name) => LINES[name].dash);
  expect(new Set(patterns).size).toBe(apart.length);
  expect(LINES.active.dash).toBe("");
  // accepted is the same path, which is not flown yet either: a word beside it says which
  expect(LINES.armed.dash).toBe(LINES.proposed.dash);
});

test("without colour, a lost separation differs from one that is kept", () => {
  expect(SEPARATION.lost.dash).not.toBe(SEPARATION.kept.dash);
});

test("amber and red mean caution and warning only", () => {
  for (const [name, line] of Object.entries(LINES))
    expect(["caution", "alert"], name).not.toContain(line.colour);
  expect(SEPARATION.kept.colour).toBe("label");
  expect(SEPARATION.predicted.colour).toBe("caution");
  expect(SEPARATION.lost.colour).toBe("alert");
});

test("every colour is one of the tokens", () => {
  const used = new Set<string>(Object.values(LINES).map(({ colour }) => colour));
  for (const style of Object.values(AGE)) used.add(style.colour);
  for (const style of Object.values(GUIDANCE)) used.add(style.slotColour);
  for (const style of Object.values(SEPARATION)) used.add(style.colour);
  for (const colour of used) expect(tokens).toContain(`--${colour}:`);
});

function importsOf(folder: string): { file: string; path: string }[] {
  return readdirSync(join(SOURCE, folder)).flatMap((file) => {
    const text = readFileSync(join(SOURCE, folder, file), "utf8");
    const imports = [...text.matchAll(/from "(\.\.\/[^"]+)"/g)];
    return imports.map(([, path = ""]) => ({ file, path }));
  });
}

/** What is shown, and words for it: no facts of a flight, and nothing that works one out. */
const STORE = [
  "picture",
  "mode-words",
  "shown",
  "numbers",
  "notices",
  "forecast",
  "colours",
  "states",
  "state-styles",
  "reading",
  "traffic",
  "weather",
];

test("the display knows nothing of streams, requests and panels, and reads only the picture", () => {
  const allowed = [
    ...STORE.map((name) => `../store/${name}`),
    "../geometry",
    "../units",
    "../wire",
  ];
  for (const { file, path } of importsOf("nd")) expect(allowed, file).toContain(path);
});

test("panels work nothing out of the facts of a flight", () => {
  for (const { file, path } of importsOf("panels").filter(({ path }) => path.includes("store/")))
    expect(
      [...STORE, "types"].map((name) => `../store/${name}`),
      file,
    ).toContain(path);
});

test("the time of the view is handed in: nothing that draws asks a clock", () => {
  for (const folder of ["nd", "store", "panels"])
    for (const file of readdirSync(join(SOURCE, folder)).filter((name) => !name.endsWith(".css"))) {
      const text = readFileSync(join(SOURCE, folder, file), "utf8");
      expect(text.match(/performance\.now\(\)|Date\.now\(\)|new Date\(/g), file).toBeNull();
    }
});

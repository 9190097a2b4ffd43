import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { AGES, GUIDANCES, SEPARATIONS } from "../../src/nd/states";
import { AGE, GUIDANCE, LINES, SEPARATION } from "../../src/nd/style";

const SOURCE = join(import.meta.dirname, "../../src");
const tokens = readFileSync(join(SOURCE, "styles/tokens.css"), "utf8");

test("every state has a look for every element", () => {
  for (const [states, table] of [
    [GUIDANCES, GUIDANCE],
    [AGES, AGE],
    [SEPARATIONS, SEPARATION],
  ] as const) {
    expect(Object.keys(table).sort()).toEqual([...states].sort());
    const columns = Object.values(table).map((look) => Object.keys(look).sort().join());
    expect(new Set(columns).size).toBe(1);
  }
});

test("without colour, what is flown, was flown, is declared and is guessed still differ", () => {
  const apart = ["active", "superseded", "final", "declared", "extrapolated", "circle"] as const;
  const patterns = apart.map((name) => LINES[name].dash);
  expect(new Set(patterns).size).toBe(apart.length);
  expect(LINES.active.dash).toBe("");
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
  for (const look of Object.values(AGE)) used.add(look.colour);
  for (const look of Object.values(GUIDANCE)) used.add(look.slotColour);
  for (const look of Object.values(SEPARATION)) used.add(look.colour);
  for (const colour of used) expect(tokens).toContain(`--${colour}:`);
});

test("the display knows nothing of streams, requests and panels", () => {
  for (const file of readdirSync(join(SOURCE, "nd"))) {
    const text = readFileSync(join(SOURCE, "nd", file), "utf8");
    const imports = [...text.matchAll(/from "(\.\.\/[^"]+)"/g)].map(([, path]) => path);
    for (const path of imports)
      expect(
        ["../committed", "../flight", "../geometry", "../motion", "../pair", "../units", "../wire"],
        file,
      ).toContain(path);
  }
});

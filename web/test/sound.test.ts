import { expect, test } from "vitest";
import { kindOf, urgentNotice } from "../src/sound";

test("the most urgent notice is heard, and advice is not", () => {
  const advice = { level: "advice", text: "JOINED" } as const;
  const prompt = { level: "prompt", text: "CONV PROPOSED – CONFIRM" } as const;
  const caution = { level: "caution", text: "SEP IN 45 S" } as const;
  const warning = { level: "warning", text: "SEPARATION" } as const;
  expect(urgentNotice([warning, caution, advice])).toBe(warning);
  expect(urgentNotice([caution, prompt])).toBe(caution);
  expect(urgentNotice([prompt, advice])).toBeNull();
});

test("a caution that counts down does not chime each second", () => {
  expect(kindOf("SEP IN 45 S")).toBe(kindOf("SEP IN 44 S"));
  expect(kindOf("SEP IN 45 S")).not.toBe(kindOf("LDR DATA 6 S"));
});

import { describe, expect, test } from "vitest";
import { attitudeOf } from "../../src/pfd/attitude";
import { attitudeWords, barWords, createSpeaker } from "../../src/pfd/words";
import { aircraft, pairAt } from "../samples";

const LEVEL = { roll_deg: 0, pitch_deg: 0, commanded_bank_deg: 0, commanded_climb_mps: 0 };

describe("how to follow the bars", () => {
  test.each([
    [{}, "On the bars."],
    [{ roll_deg: 12, commanded_bank_deg: 12 }, "Fly right, 12° of bank."],
    [{ roll_deg: -30, commanded_bank_deg: -25 }, "Fly left, 25° of bank."],
    // less bank to the right than is flown is still bank to the right
    [{ roll_deg: -10, commanded_bank_deg: 15 }, "Fly right, 15° of bank."],
    [{ roll_deg: 20, commanded_bank_deg: 0.4 }, "Wings level."],
    [{ roll_deg: 2, commanded_bank_deg: 25 }, "On the bars."],
    [{ pitch_deg: 1.2 }, "Pull up."],
    [{ roll_deg: 9, commanded_bank_deg: 9, pitch_deg: -2 }, "Fly right, 9° of bank. Push down."],
  ])("%o: %s", (changes, said) => {
    expect(barWords({ ...LEVEL, ...changes })).toBe(said);
  });
});

test("no two things are said within four seconds", () => {
  const speak = createSpeaker();
  const said = Array.from({ length: 200 }, (_, k) => speak(`${Math.floor(k / 3)}`, 100 * k));
  const changes = said.flatMap((each, k) => (k > 0 && each !== said[k - 1] ? [100 * k] : []));
  expect(changes.length).toBeGreaterThan(3);
  changes.slice(1).forEach((at, k) => {
    expect(at - (changes[k] ?? 0)).toBeGreaterThanOrEqual(4000);
  });
});

test("the instrument in words has all that it shows, with units", () => {
  const sample = pairAt(0, { pursuer: aircraft({ bank_deg: -24.6, heading_deg: 7 }) });
  expect(attitudeWords(attitudeOf(sample, 0))).toBe(
    "Primary flight display: bank 25 left, pitch 3 degrees, 467 knots, FL350, heading 007.",
  );
  expect(attitudeWords(attitudeOf(pairAt(0), 0))).toContain("bank level,");
});

import { describe, expect, test } from "vitest";
import {
  FT,
  formatBank,
  formatClock,
  formatHeading,
  formatKnots,
  formatLevel,
  formatMiles,
  formatSignedKnots,
  inPageUnits,
  KT,
  NM,
  wrap180,
  wrap360,
} from "../src/units";

describe("units", () => {
  test("angles wrap to one turn, from both sides", () => {
    expect([-90, 0, 360, 725].map(wrap360)).toEqual([270, 0, 0, 5]);
    expect([-181, 180, 90, 359].map(wrap180)).toEqual([179, -180, 90, -1]);
  });

  test("headings have three digits and north is 360", () => {
    expect([0, 5, 90.4, 359.6, -10].map(formatHeading)).toEqual([
      "360",
      "005",
      "090",
      "360",
      "350",
    ]);
  });

  test("speeds and distances", () => {
    expect(formatKnots(240)).toBe("467");
    expect(formatKnots(-0.1)).toBe("0");
    expect([35 * KT, -35 * KT, 0.1].map(formatSignedKnots)).toEqual(["+35", "−35", "0"]);
    expect(formatMiles(5 * NM)).toBe("5.0");
    expect(formatMiles(-0.4 * NM)).toBe("−0.4");
    expect(formatMiles(-1)).toBe("0.0");
    expect(formatLevel(35000 * FT)).toBe("FL350");
  });

  test("times carry seconds into minutes, and minutes into hours", () => {
    expect([0, 59.6, 61, 3599.4, 3599.6, 3725, 26443, -5, -0.2].map(formatClock)).toEqual([
      "00:00",
      "01:00",
      "01:01",
      "59:59",
      "1:00:00",
      "1:02:05",
      "7:20:43",
      "−00:05",
      "00:00",
    ]);
  });

  test("bank names its side", () => {
    expect([24.6, -25, 0.2].map(formatBank)).toEqual(["25 R", "25 L", "0"]);
  });
});

test("a refusal speaks the units of the page", () => {
  expect(inPageUnits("tas_mps: must lie in 30 … 400 m/s, not 513.936 m/s.")).toBe(
    "The true airspeed must lie in 58 … 778 kt, not 999 kt.",
  );
  expect(inPageUnits("The flight has ended.")).toBe("The flight has ended.");
  expect(
    inPageUnits(
      "They are 7,636 m (4.12 NM) apart, closer than 9,260 m; 12 m matter not, 2 m/s² do.",
    ),
  ).toBe("They are 4.12 NM apart, closer than 5.00 NM; 12 m matter not, 2 m/s² do.");
});

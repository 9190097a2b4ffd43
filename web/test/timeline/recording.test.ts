import { describe, expect, test } from "vitest";
import { parseRecording } from "../../src/timeline/recording";
import { modeChanged, planChanged, STARTED, sample } from "../samples";

const HEADER = '{"format":"relguide-flight","version":3}';
const line = (document: object) => JSON.stringify(document);
const whole = [HEADER, ...[STARTED, modeChanged(0), planChanged(0), sample(0)].map(line)];

function sentence(lines: readonly string[]): string {
  const read = parseRecording(lines.join("\n"));
  return read.kind === "refused" ? read.sentence : "";
}

describe("a recording", () => {
  test("is read as it was written", () => {
    const read = parseRecording(`${whole.join("\n")}\n`);
    expect(read.kind === "read" && read.documents.map(({ kind }) => kind)).toEqual([
      "flight_started",
      "mode_changed",
      "plan_changed",
      "sample",
    ]);
  });

  test.each([
    ["is no recording at all", ["hello"], "line 1: a recording begins with"],
    ["is of another form", ['{"format":"relguide-flight","version":2}'], "its form is 2"],
    ["is cut short", [...whole.slice(0, 4), line(sample(1)).slice(0, 90)], "line 5: it is no JSON"],
    [
      "has a document of another kind",
      [...whole, line({ kind: "hello", t_s: 1 })],
      'line 6: no document is called "hello"',
    ],
    [
      "has no time",
      [...whole, line({ ...modeChanged(0), t_s: undefined })],
      "line 6: mode_changed has no t_s",
    ],
    [
      "lacks a path",
      [...whole, line({ ...planChanged(1), plan: { word: "RS" } })],
      "line 6: its plan has no segments",
    ],
    [
      "has words for numbers",
      [...whole, line({ ...sample(1), aircraft: [{ ...sample(1).aircraft[0], x_m: "far" }] })],
      "line 6: sample.aircraft.x_m is no number",
    ],
    [
      "lacks an aircraft's place",
      [...whole, line({ ...sample(1), aircraft: [{ ident: "A" }] })],
      "line 6: one of aircraft has no x_m",
    ],
    [
      "says no words",
      [...whole, line({ ...modeChanged(1), message: 7 })],
      "line 6: mode_changed.message is no text",
    ],
    [
      "has no slot",
      [...whole, line({ ...sample(1), guidance: [{ ...sample(1).guidance[0], slot: null }] })],
      "line 6: sample.guidance.slot has no members",
    ],
    [
      "lasts for ever",
      [...whole, line(sample(1e12))],
      "line 6: its t_s is 1000000000000, and no flight is longer than 1000000 s",
    ],
    ["begins in the middle", [HEADER, line(sample(0))], "a flight begins with flight_started"],
    ["holds nothing to show", whole.slice(0, 4), "holds no sample"],
  ])("that %s is refused with its line", (_, lines, said) => {
    expect(sentence(lines)).toContain(said);
  });
});

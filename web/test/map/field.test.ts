/** What is typed is taken, or refused in a sentence that says what was found, what is right and what stays. */

import { expect, test } from "vitest";
import { type FieldProps, faultOf } from "../../src/map/field";

const HEADING: FieldProps = {
  label: "Own ship: heading",
  short: "HDG",
  unit: "°",
  value: 90,
  bounds: [0, 360],
  change: () => undefined,
};
const MIN: FieldProps = {
  ...HEADING,
  unit: "NM",
  value: 5,
  decimals: 1,
  bounds: [0, 8],
  limit: "MIN is no more than D",
};

test.each(["0", "360", " 90.5 ", "7,5"])("taken: %s", (text) => {
  expect(faultOf(text, HEADING)).toBe("");
});

test.each([
  ["400", "400° is refused: 0 to 360° is right. 90° stays."],
  ["-1", "-1° is refused: 0 to 360° is right. 90° stays."],
  ["abc", '"abc" is no number: 0 to 360° is right. 90° stays.'],
  ["", "A number is missing: 0 to 360° is right. 90° stays."],
])("refused: %s", (text, sentence) => {
  expect(faultOf(text, HEADING)).toBe(sentence);
});

test("a bound that another number sets says which", () => {
  expect(faultOf("9", MIN)).toBe(
    "9 NM is refused: 0 to 8 NM is right, since MIN is no more than D. 5.0 NM stays.",
  );
});

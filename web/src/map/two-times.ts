/** When a plan joins as it is flown and as it is ideal, and why these are two times. */

import { formatClock, inPageUnits } from "../units";
import type { Answered } from "./what-if";

interface TwoTimes {
  /** What the time is that stands large. */
  readonly label?: string;
  /** The other one, beside it. */
  readonly note?: string;
  /** Why they differ, beneath. */
  readonly remark?: string;
}

/** Empty where there is no plan. */
export function twoTimes(answered: Answered | null): TwoTimes {
  const answer = answered?.answer;
  if (answer?.status !== "planned" || answer.flown === undefined) return {};
  const { flown, word } = answer;
  const ideal = formatClock(answer.time_to_converge_s);
  if (flown.status === "not_flown")
    return { label: "Ideal", note: "not flown", remark: `Not flown: ${inPageUnits(flown.reason)}` };
  const [label, note] = ["Flown", `ideal ${ideal}`];
  if (flown.reason === "") return { label, note };
  return { label, note, remark: `Ideal ${ideal} by ${word}. ${inPageUnits(flown.reason)}` };
}

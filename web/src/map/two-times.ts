/** When a plan joins as it is flown and as it is ideal, and why these are two times. */

import { formatClock, inPageUnits } from "../units";
import type { Answered } from "./what-if";

/** Beside the flown time, and beneath it; nothing where there is no plan. */
export function twoTimes(answered: Answered | null): { note?: string; remark?: string } {
  const answer = answered?.answer;
  if (answer?.status !== "planned" || answer.flown === undefined) return {};
  const { flown, word } = answer;
  const ideal = formatClock(answer.time_to_converge_s);
  if (flown.status === "not_flown")
    return { note: "ideal, not flown", remark: `Not flown: ${inPageUnits(flown.reason)}` };
  if (flown.reason === "") return { note: `flown; ideal ${ideal}` };
  const why = inPageUnits(flown.reason);
  return { note: `flown; ideal ${ideal}`, remark: `Ideal ${ideal} by ${word}. ${why}` };
}

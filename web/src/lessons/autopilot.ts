/** When the autopilot joins in a lesson: the service flies it once to its end, for all who ask. */

import { readCompared } from "../compare/opening";
import { flownOf } from "../debrief/seconds";

const asked = new Map<string, Promise<number | null>>();

/** Flight time [s]; null if the service does not say. */
export function autopilotJoins(scenario: string): Promise<number | null> {
  const before = asked.get(scenario);
  if (before !== undefined) return before;
  const answer = readCompared(`scenario:${scenario}`).then((read) => {
    if (read.kind === "read") return flownOf(read.compared.history)?.joined ?? null;
    asked.delete(scenario); // it may answer next time
    return null;
  });
  asked.set(scenario, answer);
  return answer;
}

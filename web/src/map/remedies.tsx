/** What would help where others leave no path: each was tried by the planner, and a button applies it. */

import { Panel } from "../parts";
import { inPageUnits } from "../units";
import type { NoPlanCard } from "../wire";
import { edit } from "./editing";
import type { Editor } from "./editor";
import type { Situation } from "./situation";

export type Remedy = NonNullable<NoPlanCard["remedies"]>[number];

/** The situation with a remedy applied. */
function applyRemedy(remedy: Remedy): (situation: Situation) => Situation {
  switch (remedy.kind) {
    case "slot_distance":
      return (now) => ({ ...now, slot_distance_m: remedy.slot_distance_m });
    case "level":
      return (now) => ({ ...now, pursuer: { ...now.pursuer, altitude_m: remedy.altitude_m } });
  }
}

export function Remedies({ map }: { map: Editor }) {
  const answer = map.reading.answered.value?.answer;
  if (answer?.status !== "no_plan" || answer.remedies === undefined) return null;
  return (
    <Panel name="remedies" title="What would help">
      <ul>
        {answer.remedies.map((remedy) => {
          const change = applyRemedy(remedy);
          const text = inPageUnits(remedy.message);
          return (
            <li key={remedy.kind}>
              <button type="button" onClick={() => edit(map, change)}>
                {text}
              </button>
            </li>
          );
        })}
      </ul>
    </Panel>
  );
}

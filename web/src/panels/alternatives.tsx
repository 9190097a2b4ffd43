/** The other paths to the slot that were considered, and why each is not flown. */

import { Panel } from "../parts";
import type { Session } from "../session";
import { alternativeSentence, alternativeTime, wordTitle } from "../store/reading";
import type { Guidance } from "../store/states";
import { formatClock } from "../units";
import type { Alternative } from "../wire";

const IDEAL = "as planned, with turns and braking at once: flown, each takes some seconds more";

/** What becomes of the path that is shown, where it is not flown. */
const STATE: Partial<Record<Guidance, string>> = { proposed: "proposed", armed: "accepted" };

export function Alternatives(props: {
  session: Pick<Session, "shown">;
  /** Shows what other planners would fly in its place. */
  compare?: () => void;
}) {
  const { shown } = props.session;
  const { plan: shownPlan, state } = shown.numbers.value;
  const plan = shownPlan?.ideal ?? shownPlan?.plan;
  return (
    <Panel
      name="alternatives"
      title="Alternatives"
      aside={
        <span class="hint row" title={IDEAL}>
          ideal times
          {props.compare !== undefined && (
            <button type="button" class="link" onClick={props.compare}>
              Planners
            </button>
          )}
        </span>
      }
      scrolls
    >
      {plan === undefined ? (
        <p class="hint">No path is proposed or flown now.</p>
      ) : (
        <table class="list">
          <caption class="visually-hidden">Paths considered, fastest first</caption>
          <thead class="visually-hidden">
            <tr>
              <th scope="col">Path</th>
              <th scope="col">Time</th>
              <th scope="col">Why not</th>
            </tr>
          </thead>
          <tbody>
            <tr class={STATE[state] ?? "flown"}>
              <th scope="row" title={wordTitle(plan.word)}>
                {plan.word}
              </th>
              <td>{formatClock(plan.time_to_converge_s)}</td>
              <td>{shownPlan?.ideal !== undefined ? "ideal" : (STATE[state] ?? "flown")}</td>
            </tr>
            {(plan.alternatives ?? []).map((alternative) => (
              <tr key={alternativeKey(alternative)}>
                <th scope="row" title={wordTitle(alternative.word)}>
                  {alternative.word}
                </th>
                <td>{alternativeTime(alternative)}</td>
                <td class={alternative.rejected}>{alternativeSentence(alternative, plan)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </Panel>
  );
}

/** One word may have several paths: no two have the same time. */
function alternativeKey(alternative: Alternative): string {
  const time = alternative.rejected === "no_root" ? "" : alternative.time_to_converge_s;
  return `${alternative.word} ${alternative.rejected} ${time}`;
}

/** The other ways to the slot that were looked at, and why each is not flown. */

import { Panel } from "../parts";
import { alternativeSentence } from "../reading";
import type { Session } from "../session";
import { formatClock } from "../units";

export function Alternatives(props: { session: Session }) {
  const plan = props.session.flight.plan.value?.plan;
  return (
    <Panel name="alternatives" title="Alternatives">
      {plan === undefined ? (
        <p class="hint">They come with the first plan.</p>
      ) : (
        <table class="list">
          <caption class="visually-hidden">Paths looked at, fastest first</caption>
          <thead class="visually-hidden">
            <tr>
              <th scope="col">Path</th>
              <th scope="col">Time</th>
              <th scope="col">Why not</th>
            </tr>
          </thead>
          <tbody>
            <tr class="flown">
              <th scope="row">{plan.word}</th>
              <td>{formatClock(plan.time_to_converge_s)}</td>
              <td>flown</td>
            </tr>
            {plan.alternatives.map((alternative) => (
              <tr key={`${alternative.word} ${alternative.time_to_converge_s}`}>
                <th scope="row">{alternative.word}</th>
                <td>{formatClock(alternative.time_to_converge_s)}</td>
                <td class={alternative.rejected}>{alternativeSentence(alternative, plan)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </Panel>
  );
}
